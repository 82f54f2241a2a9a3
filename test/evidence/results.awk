# results.awk: sections of doc/measured from results.md files of `asbdpt-lab experiment`: of each of the five scenes
# all tables; ratios: the error of bins over that of bdpt, printed and here, with 32 samples and with most, and what the
# mean of bins is off by; equal: squared error over that of bdpt after the same CPU time, with most samples.
function cell(i) { return part[i + 1] }
/^## / {
    on = $2 ~ /^(cornell-box|cornell-box-modified|veach-ajar|living-room|bathroom)$/
    scene = $2
    if (on) { print "== " scene; order[++n] = scene }
    blank = 1
    next
}
!on || /^!\[/ || /^Bars:/ || /\| - \|/ || (/^$/ && blank) { next } # pictures are not stored
{
    gsub(/asbdpt:select=/, "")
    blank = /^$/
    print
    split($0, part, / *\| */)
}
/^RMSE beside/ { table = "printed" }
/^Seconds of CPU/ { table = "equal" }
/^Signed error/ { table = "signed" }
/^\| [0-9]+ \|/ && table == "printed" {
    if (cell(1) == 32) first[scene] = cell(7) " | " cell(4)
    last[scene] = cell(7) " | " cell(4)
    most = cell(1)
}
/^\| [0-9]+ \|/ && table == "equal" { equal[scene] = cell(7) " | " cell(8) " | " cell(9) " | " cell(10) }
/^\| method \|/ && table == "signed" { for (last_spp = 1; cell(last_spp + 1) ~ /spp$/; last_spp++) ; }
/^\| bins \|/ && table == "signed" { off[scene] = cell(last_spp) }
/^RMSE on the/ { table = "" }
END {
    print "== ratios"
    print "| | printed, 32 samples | here | printed, " most " | here | mean of `bins` off by, per cent |"
    print "|---|---:|---:|---:|---:|---:|"
    for (i = 1; i <= n; i++) print "| " order[i] " | " first[order[i]] " | " last[order[i]] " | " off[order[i]] " |"
    print "== equal\n| | `bins` | `pool` | `vertices` | `subspaces` |\n|---|---:|---:|---:|---:|"
    for (i = 1; i <= n; i++) print "| " order[i] " | " equal[order[i]] " |"
}
