#!/bin/sh
# html.sh: does what the documents name exist, and are they whole as HTML (doc/html.sh)? It checks
#   1. that every local link and picture leads to a file;
#   2. that [`FILE: FUNCTION`](path) leads to a file of that name, and to the line that defines the function there;
#   3. that tags are closed as often as they are opened, and that formulas have indices, lists and tables are there;
#   4. that every name in a source leads to a line that has it, that lines and the formulas that they compute lead to
#      each other, and that a mark (doc/marks.awk) follows its line, and fails without it;
#   5. that mutant `NAME` is in test/data/mutants/list.txt, and `build/test NAME` in test/unit.
# Damaged pages must be found. Prints what is wrong, or one line; exit status 0 only if nothing is. Run from the top.
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
bad=0
wrong() { echo "html: $*"; bad=1; }

# whole DIR: prints what is wrong with the pages of DIR.
whole() {
    LC_ALL=C find "$1" -name '*.html' -exec awk '
        function exists(path,    line, found) {
            if (!(path in known)) { found = (getline line < path) >= 0; close(path); known[path] = found }
            return known[path]
        }
        function check(    i, name) {
            if (page == "") return
            for (i = 1; i <= n_tags; i++)
                if (seen[tag[i]] + 0 != seen["/" tag[i]] + 0)
                    print page ": " seen[tag[i]] + 0 " times <" tag[i] ">, " seen["/" tag[i]] + 0 " times closed"
            for (name in seen) delete seen[name]
        }
        BEGIN { n_tags = split("p ul ol li table tr td th pre div section strong em sub sup code a math mrow mfrac msub", tag) }
        FNR == 1 {
            check()
            page = folder = FILENAME
            sub(/[^\/]*$/, "", folder)
        }
        {
            n = split($0, piece, "<")
            for (i = 2; i <= n; i++) {
                name = piece[i]
                sub(/[ >].*/, "", name)
                seen[name]++
            }
            gsub(/<wbr>/, "")
            line = $0
            while (match(line, /(href|src)="[^"]*"/)) {
                url = substr(line, RSTART, RLENGTH)
                line = substr(line, RSTART + RLENGTH)
                gsub(/^[a-z]*="|"$/, "", url)
                if (url ~ /^(https?:|mailto:)/) continue
                sub(/#.*/, "", url)
                if (url != "" && !exists(folder url)) print page ": there is no " url
            }
            line = $0
            while (match(line, /<a href="[^"]*"><code[^>]*>[A-Za-z0-9_.]+: [A-Za-z0-9_]+</)) {
                url = label = substr(line, RSTART, RLENGTH - 1)
                line = substr(line, RSTART + RLENGTH)
                gsub(/^<a href="|".*/, "", url)
                sub(/.*>/, "", label)
                if (index("/" url, "/" substr(label, 1, index(label, ":") - 1) ".html#L") == 0)
                    print page ": " url " does not define " label
            }
        }
        END { check() }' {} +
}

sh doc/html.sh "$dir/html" >/dev/null || exit 1
found=$(whole "$dir/html")
[ -z "$found" ] || wrong "$found"
tour="$dir/html/doc/tour"
for text in '<msub><mi>p</mi><mrow><mi>s</mi></mrow></msub>' '<mo>&#x2211;</mo><mrow><mi>i</mi></mrow></munder>' \
    '<mrow><mi>light</mi></mrow></msub><mo>+</mo>' '</mrow></mfrac></math>' '<aside><a href="#the-formula">' \
    '<li><a href="../../src/transport/mis.h.html#L' '<td>6.25</td>' '<img src="figures/' '<h2 id="mirrors">'; do
    grep -qF "$text" "$tour/06-connections.html" "$tour/07-weights.html" "$tour/07b-constant-time.html" ||
        wrong "no $text"
done
# The first page: six images, eight programs, and headings that lead to where they are.
index="$dir/html/index.html"
for count in '6 <img src="doc/gallery/' '8 <img src="doc/mini/'; do
    [ "$(grep -o "${count#* }" "$index" | wc -l | tr -d ' ')" = "${count%% *}" ] || wrong "index.html has not $count"
done
leads() { # prints the headings of a list that are not where it says
    awk -v html="$dir/html" '
        function ids(page,    line) {
            while ((getline line < (html "/" page)) > 0)
                while (match(line, / id="[^"]*">/)) {
                    is[page "#" substr(line, RSTART + 5, RLENGTH - 7)] = 1
                    line = substr(line, RSTART + RLENGTH)
                }
            close(html "/" page)
            known[page] = 1
        }
        /^<li><a href="[^"#]*#/ {
            split($0, part, "\"")
            page = part[2]
            sub(/#.*/, "", page)
            if (!(page in known)) ids(page)
            if (!(part[2] in is)) print part[2]
        }' "$1"
}
[ "$(grep -c '^<li><a href="[^"]*#' "$index")" -gt 200 ] || wrong "index.html lists few headings"
found=$(leads "$index")
[ -z "$found" ] || wrong "index.html leads to no heading: $found"
sed -n 's/#render"/#rendered"/p' "$index" >"$dir/index.html"
[ -n "$(leads "$dir/index.html")" ] || wrong "a heading that is not there is not noticed"

# named DIR [FILE]: the links of its sources, or of this one, whose line has not their name, and how many links there are.
named() {
    LC_ALL=C find src -name '*.[ch]' -exec awk -v html="$1" -v only="$2" '
        { text[FILENAME, FNR] = $0; if (FNR == 1) file[++n] = FILENAME }
        END {
            for (i = 1; i <= n; i++)
                while ((only == "" || only == file[i]) && (getline line < (html "/" file[i] ".html")) > 0)
                    while (match(line, /<a href="[^"]*#L[0-9]+">[A-Za-z_0-9]+</)) {
                        split(substr(line, RSTART, RLENGTH), part, /[">#<]+/)
                        line = substr(line, RSTART + RLENGTH)
                        to = part[3] ~ /^L/ ? file[i] : part[3]
                        name = part[3] ~ /^L/ ? part[4] : part[5]
                        at = substr(part[3] ~ /^L/ ? part[3] : part[4], 2)
                        sub(/^(\.\.\/)*/, "", to)
                        sub(/\.html$/, "", to)
                        links++
                        if (" " text[to, at] " " !~ ("[^A-Za-z0-9_]" name "[^A-Za-z0-9_]"))
                            print file[i] ": " name " is not in line " at " of " to
                    }
            print links + 0
        }' {} +
}
found=$(named "$dir/html")
[ "$(echo "$found" | sed '$d')" = "" ] || wrong "$(echo "$found" | sed -n 1,5p)"
[ "$(echo "$found" | tail -n 1)" -gt 20000 ] || wrong "only $found names of the sources lead anywhere"
grep -q '<munderover><mo>&#x220F;</mo>' "$dir/html/src/transport/mis.h.html" || wrong "mis.h has no product"
grep -q '^<p>Next: <a href="../../src/transport/vertex.h.html">' "$dir/html/src/transport/mis.h.html" ||
    wrong "nothing leads from mis.h to the next file that the README names"
[ "$(cat "$dir"/html/src/*/*.html | grep -c '^<p>Next: ')" -gt 40 ] || wrong "the order of reading ends too soon"
# Formulas: pages 3 to 11b have marks, and where a line has a formula its page leads back to the line.
LC_ALL=C awk -f doc/marks.awk doc/tour/*.md >"$dir/marks" || bad=1
for page in 03 04 05 06 07 07b 08 09 10 11 11b; do
    grep -q "^doc/tour/$page-" "$dir/marks" || wrong "page $page of the tour marks no line"
done
TAB=$(printf '\t')
while IFS=$TAB read -r page file line id rest; do
    page=${page%.md}.html
    grep -q "<div class=\"f\"><a href=\"[./]*/$page#$id\">" "$dir/html/$file.html" ||
        wrong "$file has no formula of $page"
    grep -q "<a id=\"$id\" href=\"[./]*/$file.html#L$line\">" "$dir/html/$page" ||
        wrong "$page does not lead to $file"
    grep -q "id=\"L$line\"" "$dir/html/$file.html" || wrong "$file has no line $line"
done <"$dir/marks"
mkdir -p "$dir/moved/doc/tour" "$dir/moved/src/transport"
cp doc/marks.awk doc/tour/07b-constant-time.md "$dir/moved/doc/tour"
{ echo && cat src/transport/path.c; } >"$dir/moved/src/transport/path.c"
marked() { (cd "$dir/moved" && awk -f doc/tour/marks.awk doc/tour/07b*.md 2>"$dir/said" | cut -f 1-3); }
{ echo && echo && cat src/transport/mis.h; } >"$dir/moved/src/transport/mis.h"
expected=$(awk -F '\t' -v OFS='\t' '$1 ~ /07b/ { print $1, $2, $3 + ($2 ~ /path/ ? 1 : 2) }' "$dir/marks")
[ "$(marked)" = "$expected" ] || wrong "a mark does not follow its line"
sed 's|    return|    give|' src/transport/mis.h >"$dir/moved/src/transport/mis.h"
marked >/dev/null
grep -q 'mis.h: mis_side has 0 lines with return' "$dir/said" || wrong "a line that is gone is not noticed"
of=src/transport/connect.c
mkdir -p "$dir/wrong/src/transport"
sed 's/\(vertex.h.html#L\)[0-9]*">beta</\11">beta</' "$dir/html/$of.html" >"$dir/wrong/$of.html"
named "$dir/wrong" $of | grep -q 'connect.c: beta is not in line 1 of src/transport/vertex.h' ||
    wrong "a name that leads elsewhere is not noticed"

mkdir "$dir/damaged"
while IFS= read -r damage; do
    echo "$damage" >"$dir/damaged/damaged.html"
    [ -n "$(whole "$dir/damaged")" ] || wrong "not noticed: $damage"
done <<'END'
<a href="nothing.html">x</a>
<a href="damaged.html"><code>damaged: missing</code></a>
<a href="damaged.html#L1"><code>other: function</code></a>
<p>x
END

# unknown PATTERN FILE BEFORE AFTER: the names that documents have within PATTERN for which FILE has no text BEFORE NAME
# AFTER.
unknown() {
    find . \( -name 'build*' -o -name out -o -name .git \) -prune -o -name '*.md' -exec grep -ohE "$1" {} + |
        sed 's/`$//; s/.*[` ]//' | sort -u | while read -r name; do
        grep -q "$3$name$4" "$2" || echo "$name"
    done
}
for name in $(unknown 'mutant `[a-zA-Z0-9-]+`' test/data/mutants/list.txt '^' ' '); do wrong "there is no mutant $name"; done
awk -f test/unit/suites.awk test/unit/*.c >"$dir/suites.h"
for name in $(unknown '`build/test [a-z0-9-]+`' "$dir/suites.h" '{"' '"'); do wrong "there is no test $name"; done
[ -n "$(unknown '`build/test [a-z0-9-]+`' /dev/null '' '')" ] || wrong "a test that does not exist is not noticed"
[ $bad -ne 0 ] ||
    echo "html: $(find "$dir/html" -name '*.html' | wc -l | tr -d ' ') pages are whole, and what they name exists"
exit $bad
