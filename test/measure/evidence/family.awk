# family.awk: sections of doc/measured from family.md of `asbdpt-lab family`. Of each half, choice and services:
# HALF, the table of means; HALF-mse8, HALF-relmse, HALF-8x8, of all scenes; HALF-claims. bring: of each method that
# can have services, the means of the choice alone and the factor of services, by mse8 and in 8x8. HALF-best: subspaces
# over the best rival. Rows of services that are those of the choice, of methods without services, are left out, but for
# pt, lt and bins.
function begin(name) { section = name; open = 0 }
/^## The choice alone/ { half = "choice" }
/^## With all services/ { half = "services" }
/^Squared error over that of/ { begin(half) }
/^(mse8|relmse|8x8): squared error over/ { measure = $1; sub(/:/, "", measure); begin(half "-" measure) }
/^Claims:/ { begin(half "-claims") }
/^What shared techniques contribute/ { begin("bring") }
/^\|/ && section == "choice" { split($0, cell, / *\| */); alone[cell[2]] = cell[4] " | " cell[6] }
/^\|/ && section == "bring" {
    split($0, cell, / *\| */)
    if (cell[2] == "method") {
        print "== bring\n| method | choice alone, mse8 | 8x8 | techniques, mse8 | 8x8 |"
        print "|---|---:|---:|---:|---:|"
    } else if (cell[2] in alone && cell[2] !~ /^-/)
        print "| " cell[2] " | " alone[cell[2]] " | " cell[3] " | " cell[5] " |"
    next
}
/^\|/ && section == "choice" { row[$0] = 1 }
/^\|/ && section == "services" && $0 in row && $2 !~ /^(method|pt|lt|bins|-)/ && !/^\|-/ { next } # as without services
/^\| (subspaces over )?best rival \| - \| - \| - \| - / { next } # not known
/^\| subspaces over best rival / {
    split($0, cell, / *\| */)
    half_of[++halves] = section; best_of[halves] = cell[4] " | " cell[5] " | " cell[6]
}
/^\|/ && section != "" {
    if (!open++) print "== " section
    print
    n++
}
END {
    for (i = 1; i <= halves; i++) printf "== %s-best\n%s\n", half_of[i], best_of[i]
    exit !n
}
