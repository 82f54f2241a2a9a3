# parts.awk: what each part of the method buys, from tune.md of test/lab/tune.sh: variants that leave out pieces of a
# part are put together.
BEGIN {
    FS = " *\\| *"
    n = split("what light vertices are worth:no-worth|of that, to whom:no-eye-regions|" \
        "regions on four levels; by direction; by sides; shifted:no-levels,no-faces,no-sides,no-shift|" \
        "grids that lie where vertices are:no-extent|credits of what comes straight:no-credit|" \
        "emission:no-emission|lights that a region sees:no-guide|" \
        "the first question (error; CPU time):no-question", part, "|")
}
NF > 10 { error[$2] = $4; cpu[$2] = $8; worst[$2] = $10; gsub(/\*/, "", error[$2]) }
END {
    print "== parts\n| part | without it | worst |\n|---|---:|---|"
    for (i = 1; i <= n; i++) {
        text = part[i]; sub(/:[^:]*$/, "", text); sub(/.*:/, "", part[i])
        m = split(part[i], variant, ","); said = ""; most = 0
        for (j = 1; j <= m; j++) {
            v = variant[j]
            if (!(v in error)) continue
            said = said (said == "" ? "" : "; ") error[v] (v == "no-question" ? "; " cpu[v] : "")
            if (v == "no-question") where = "-"
            else if (worst[v] + 0 > most) { most = worst[v] + 0; where = worst[v] }
        }
        if (said != "") printf "| %s | %s | %s |\n", text, said, where
    }
}
