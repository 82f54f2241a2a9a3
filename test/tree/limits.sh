#!/bin/sh
# limits.sh: does SECURITY.md say what the limits are? Each row of its table ends in a value, as 12, 2^28 or 1e30, and a
# constant, `NAME` in `PATH`, whose definition there must have that value. Run from the top.

# compare: the rows of a page on standard input. Status 0: there are some, and all are right.
compare() {
    sed -n 's/^|.*| *\([0-9e^]*\) *| `\([A-Z_]*\)` in `\([a-z_/.]*\)` |$/\1 \2 \3/p' | rows
}
rows() {
    n=0 bad=0
    while read -r said name path; do
        code=$(sed -n -e 's/([a-z0-9_]*)//' -e "s/.*$name *=* *\([0-9][0-9e]*\( << [0-9]*\)*\).*/\1/p" "$path" |
            head -n 1)
        n=$((n + 1))
        awk -v code="$code" -v said="$said" 'function value(text,    part) {
                if (split(text, part, / << /) == 2) return part[1] * 2 ^ part[2]
                if (split(text, part, /\^/) == 2) return part[1] ^ part[2]
                return text + 0
            }
            BEGIN { exit code != "" && value(code) == value(said) ? 0 : 1 }' || {
            echo "SECURITY.md: $name is $said, $path says \"$code\""
            bad=$((bad + 1))
        }
    done
    echo "limits: $n in SECURITY.md, $bad wrong"
    [ "$n" -gt 10 ] && [ "$bad" -eq 0 ]
}
compare <SECURITY.md || exit
! sed 's/65536/65535/' SECURITY.md | compare >/dev/null || { echo "limits: a wrong one is not noticed"; exit 1; }
