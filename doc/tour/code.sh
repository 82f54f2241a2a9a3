#!/bin/sh
# code.sh [DIR]: puts the code that the tour's pages show into them, as it stands in the sources now. A page asks for it by
# a line that names a function, with a block of C behind it, which is replaced:
#   [`FILE: FUNCTION`](PATH):                            the whole function
#   [`FILE: FUNCTION`](PATH), N lines from `TEXT`:       of these, the first holds TEXT
# With DIR the pages are written there, and the tour's stay as they are. Run from the top; test/tree/pages.sh tells when to.
for page in doc/tour/[01]*.md; do
    LC_ALL=C awk -v page="$page" '
        function ask(line) {
            split(line, part, "`")
            name = part[2]
            sub(/^.*: /, "", name)
            path = line
            sub(/^[^(]*\(/, "", path)
            sub(/\).*/, "", path)
            from = part[4]
            n = from == "" ? 1000 : line
            if (from != "") { sub(/^.*\), /, "", n); n += 0 }
        }
        # The lines asked for, moved to the left by the blanks of the first.
        function show(    folder, line, inside, here, shown, indent) {
            folder = page
            sub(/[^\/]*$/, "", folder)
            while ((getline line < (folder path)) > 0) {
                if (!inside && line ~ ("^[a-z].*[ *]" name "\\(") && line !~ /;$/) inside = 1
                if (!inside) continue
                if (!here && (from == "" || index(line, from))) { here = 1; match(line, /^ */); indent = RLENGTH }
                if (here && shown < n) { print substr(line, substr(line, 1, indent) ~ /^ *$/ ? indent + 1 : 1); shown++ }
                if (line ~ /^}/ || line ~ /^[a-z].*}$/) break
            }
            close(folder path)
            if (!shown || (from != "" && shown < n)) {
                print page ": " path " has no such lines of " name >"/dev/stderr"
                bad = 1
            }
        }
        BEGIN { n = 0 }
        skip && /^```$/ { skip = 0 }
        skip { next }
        { print }
        /^\[`[^`]*: [a-z_0-9]*`\]\([^)]*\)(, [0-9]+ lines from `[^`]*`)?:$/ { ask($0); wanted = 2; next }
        wanted && /^```c$/ { show(); skip = 1 }
        wanted && NF { wanted = 0 }
        END { exit bad }' "$page" >"${1:-$(dirname "$page")}/.made" || exit 1
    if [ -n "${1-}" ]; then mv "$1/.made" "$1/${page##*/}"; else mv doc/tour/.made "$page"; fi
done
