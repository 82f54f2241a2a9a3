#!/bin/sh
# tree_stats.sh: for every room of src: files, lines of code, comment share, and its five longest functions.
# A line of code holds something beside comment; a function begins at a line that is not indented and ends with "}".
for room in $(cat src/LAYERS) total; do
    files=$(if [ "$room" = total ]; then ls src/*/*.[ch]; else ls src/"$room"/*.[ch]; fi)
    awk -v room="$room" '
        FNR == 1 { n_files++; inside = 0 }
        {
            line = $0
            comment = inside
            while (1) {
                if (inside) {
                    if (!(at = index(line, "*/"))) { line = ""; break }
                    line = substr(line, at + 2); inside = 0
                } else {
                    if (!(at = index(line, "/*"))) break
                    comment = inside = 1
                    before = substr(line, 1, at - 1); line = substr(line, at + 2)
                    if (before ~ /[^ \t]/) kept = 1
                }
            }
            if (line ~ /[^ \t]/ || kept) code++; else if (comment) comments++
            kept = 0
        }
        /^[a-z].*\)$/ && !/;/ { start = FNR; name = $0; sub(/\(.*/, "", name); sub(/.*[ *]/, "", name) }
        /^[a-z].*[,(]$/ && !/;/ { start = FNR; name = $0; sub(/\(.*/, "", name); sub(/.*[ *]/, "", name) }
        /^}$/ && start { length_of[name] = FNR - start + 1; start = 0 }
        /^};?$|;$/ && /^[a-z]/ { start = 0 }
        END {
            printf "%-12s %4d files %6d lines of code %3d %% comment  ",
                room, n_files, code, 100 * comments / (code + comments)
            for (k = 0; k < 5; k++) {
                best = ""
                for (f in length_of) if (best == "" || length_of[f] > length_of[best]) best = f
                if (best == "") break
                printf " %s %d", best, length_of[best]
                delete length_of[best]
            }
            print ""
        }' $files
done
