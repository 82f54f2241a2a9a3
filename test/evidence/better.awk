# better.awk: what the default makes of the better of bdpt and pt, scene by scene: ratios of family.md of `asbdpt-lab
# family`, with 16 samples and with 64, in rmse8, relmse and means over 8x8 pixels. bdpt is 1 there, and pt
# counts where it has no mark. A line is where learning left no time for two samples.
FNR == 1 { file++; measure = "" }
/^(rmse8|relmse|8x8): squared/ { measure = $1; sub(/:/, "", measure) }
measure == "" { next }
/^\| method \|/ { n = split($0, scene, / *\| */) - 1 }
/^\| (pt|subspaces) \|/ {
    split($0, cell, / *\| */)
    for (i = 3; i <= n; i++) value[file, measure, i, cell[2]] = cell[2] == "pt" && cell[i] ~ /[a-z]/ ? 0 : cell[i] + 0
}
END {
    print "== sizes\n| scene | 16: rmse8 | relmse | 8x8 | 64: rmse8 | relmse | 8x8 |"
    print "|---|---:|---:|---:|---:|---:|---:|"
    split("rmse8 relmse 8x8", name, " ")
    mean = "| **geometric mean** |"
    for (i = 3; i <= n; i++) {
        sub(/,.*/, "", scene[i])
        line = "| " scene[i] " |"
        for (f = 1; f <= 2; f++)
            for (m = 1; m <= 3; m++) {
                pt = value[f, name[m], i, "pt"]
                q = value[f, name[m], i, "subspaces"] / (pt > 0 && pt < 1 ? pt : 1)
                if (q > 0) { sum[f, m] += log(q); count[f, m]++ }
                line = line (q > 0 ? sprintf(q > 1 ? " **%.2f** |" : " %.2f |", q) : " **-** |")
            }
        print line
    }
    for (f = 1; f <= 2; f++) for (m = 1; m <= 3; m++) mean = mean sprintf(" %.2f |", exp(sum[f, m] / count[f, m]))
    print mean
}
