# leads.awk, after better.awk and runs.awk: the error of subspaces over that of rivals in the runs of `asbdpt-lab
# family`. Section leads: geometric means over scenes with their intervals, of each group of runs, over four rivals or
# -v rivals=. With -v kinds= (see equal.awk), of one group, those in the scenes that nothing was chosen on, and
# without cornell-ri. Then also, by mse8: best, over the best unmarked of the four in each scene, which is found on
# the same seeds, so it flatters rivals; unseen-best, the same in the scenes that nothing was chosen on; best-scenes,
# in how many there is one; data, lines of a figure of the latter scenes, "SCENE MSE8 MSE8 MSE8 MSE8" over two rivals.
# alone: over bdpt, of all scenes, by the choice alone, if it is there.
function leads(g, r, all,    k, text) {
    for (k = 1; k <= 3; k++) text = text " " interval(lead(g, r, k, all), k) " |"
    return text
}
function titled(g) { return g ~ /choice$/ ? "choice alone" : "all techniques" }
END {
    if (!groups) exit 1
    g = group[groups]
    if (kinds == "") {
        for (i = 1; i <= groups; i++) {
            head = head " " (groups > 1 ? titled(group[i]) ": " : "") "mse8 | relmse | 8x8 |"
            line = line "---:|---:|---:|"
        }
        print "== leads\n| rival |" head "\n|---|" line
        for (j = 1; j <= names; j++) {
            text = "| `" rival[j] "` |"
            for (i = 1; i <= groups; i++) text = text leads(group[i], rival[j], 1)
            print text
        }
    } else {
        print "== leads\n| rival | mse8 | relmse | 8x8 | without `cornell-ri`: relmse | 8x8 |"
        print "|---|---:|---:|---:|---:|---:|"
        for (j = 1; j <= names; j++)
            print "| `" rival[j] "` |" leads(g, rival[j], 0) " " \
                interval(lead(g, rival[j], 2, 0, "cornell-ri"), 2) " | " \
                interval(lead(g, rival[j], 3, 0, "cornell-ri"), 3) " |"
        all = lead(g, "best", 1, 1); half = lead(g, "best", 1, 0)
        print "== best\n" interval(all, 1) "\n== unseen-best\n" interval(half, 1) "\n== data"
        for (i = 1; i <= scenes[g]; i++) if ((s = scene[g, i]) in unseen) {
            not_chosen_on++
            v = ratio(g, "subspaces", rival[1], s, 1)
            printf "%s %.3f %.3f %.3f %.3f\n", s, v, v, v, ratio(g, "subspaces", rival[2], s, 1)
        }
        printf "== best-scenes\n%d of %d and %d of %d\n", number[all, 1], scenes[g], number[half, 1], not_chosen_on
    }
    for (i = 1; i <= groups; i++) if ((g = group[i]) ~ /choice$/) {
        for (k = 1; k <= 3; k++) set = lead(g, "bdpt", k, 1)
        printf "== alone\n%s (mse8) and %s (8x8)\n", interval(set, 1), interval(set, 3)
    }
}
