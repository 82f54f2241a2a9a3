# marks.awk: the lines of the sources that pages point at, each found by what stands in it. Run from the top:
#   awk -f doc/marks.awk doc/tour/PAGE.md... >FILE
# A page points at one by [`FILE: FUNCTION`](PATH) at `TEXT`, behind the formula that it computes. TEXT is in one line of
# the function. Writes a row for each, of what tabs separate: page, file, number of the line, the name that the place in
# the page has, its title, and the formula, its lines joined by \003. In a page without a number in front these are
# examples: then the formula is what stands in the first two cells of the row of a table, and the title has the heading,
# too. Exit status 1 if a line is not there, or there are two.
function find(path, name, text,    line, n, inside, found, times) {
    while ((getline line < path) > 0) {
        n++
        if (!inside && line ~ ("^[a-z].*[ *]" name "\\(") && line !~ /;$/) inside = 1
        if (inside && index(line, text)) { found = n; times++ }
        if (inside && (line ~ /^}/ || line ~ /^[a-z].*}$/)) inside = 0
    }
    close(path)
    if (times == 1) return found
    print FILENAME ":" FNR ": " path ": " name " has " times + 0 " lines with " text >"/dev/stderr"
    bad = 1
}
FNR == 1 { block = heading = ""; number = 0; title = substr($0, 3); formulas = FILENAME ~ /\/[0-9]/ }
/^## / && !formulas { heading = ": " substr($0, 4) }
!formulas { split($0, cell, / *\| */); block = /^\|/ ? cell[2] ": " cell[3] : "" }
formulas && /^    / { block = (before ~ /^    / ? block "\003" : "") substr($0, 5) }
{
    before = $0
    while (match($0, /\[`[^`]*: [a-z_0-9]+`\]\([^)]*\) at `[^`]*`/)) {
        split(substr($0, RSTART, RLENGTH), part, "`")
        name = part[2]
        sub(/.*: /, "", name)
        path = part[3]
        gsub(/^\]\((\.\.\/)*|\) at $/, "", path)
        print FILENAME "\t" path "\t" find(path, name, part[4]) "\tcomputed-" ++number "\t" title heading "\t" block
        $0 = substr($0, RSTART + RLENGTH)
    }
}
END { exit bad }
