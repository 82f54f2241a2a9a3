# results.awk: sections of doc/measured from results.md files of `asbdpt-lab experiment`, of the five scenes. ratios:
# the error of bins over that of bdpt, printed and here, with 32 samples and with most of which both are known, and what
# the mean of bins is off by; equal: squared error over that of bdpt after the same CPU time, with most samples; rows: all
# methods and numbers of samples, of tables 4.1 to 4.4 and of the sweeps of appendix A.
function cell(i) { return part[i + 1] }
/^## / {
    on = $2 ~ /^(cornell-box|cornell-box-modified|veach-ajar|living-room|bathroom)$/
    scene = $2
    if (on) order[++n] = scene
}
!on { next }
{
    gsub(/asbdpt:select=|:lightsamplestrategy=power/, "")
    split($0, part, / *\| */)
}
/^\| [0-9]+ \| [a-z]/ { row[++rows] = "| " scene " " $0 }
/^\| [0-9]+ \| bdpt \|/ { before[cell(1)] = cell(5) }
/^\| [0-9]+ \| bins \|/ {
    if (cell(5) != "-") {
        last[scene] = sprintf("%.3f | %s", cell(5) / before[cell(1)], cell(4))
        if (cell(1) == 32) first[scene] = last[scene]
        most = cell(1)
    }
    off[scene] = cell(8)
}
/^\| [0-9]+ \| (bins|pool|vertices|subspaces) \|/ { equal[scene, cell(2)] = cell(7) }
END {
    print "== ratios"
    print "| | printed, 32 samples | here | printed, " most " | here | mean of `bins` off by, per cent |"
    print "|---|---:|---:|---:|---:|---:|"
    for (i = 1; i <= n; i++) print "| " order[i] " | " first[order[i]] " | " last[order[i]] " | " off[order[i]] " |"
    print "== equal\n| | `bins` | `pool` | `vertices` | `subspaces` |\n|---|---:|---:|---:|---:|"
    for (i = 1; i <= n; i++)
        print "| " order[i] " | " equal[order[i], "bins"] " | " equal[order[i], "pool"] " | " \
            equal[order[i], "vertices"] " | " equal[order[i], "subspaces"] " |"
    print "== rows\n| scene | samples | method | RMSE | over bdpt | printed | seconds | cost over bdpt | mean off by, % | tested |"
    print "|---|---:|---|---:|---:|---:|---:|---:|---:|---:|"
    for (i = 1; i <= rows; i++) print row[i]
}
