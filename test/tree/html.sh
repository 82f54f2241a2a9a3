#!/bin/sh
# html.sh: does what the documents name exist, and are they whole as HTML (doc/html.sh)? It checks
#   1. that every local link and picture leads to a file;
#   2. that [`FILE: FUNCTION`](path) leads to a file of that name, and to the line that defines the function there;
#   3. that tags are closed as often as they are opened, and that formulas have indices, lists and tables are there;
#   4. that mutant `NAME` is in test/data/mutants/list.txt, and `build/test NAME` in test/unit.
# Damaged pages must be found. Prints what is wrong, or one line; exit status 0 only if nothing is. Run from the top.
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
bad=0
wrong() { echo "html: $*"; bad=1; }

# whole DIR: prints what is wrong with the pages of DIR.
whole() {
    LC_ALL=C find "$1" -name '*.html' -exec awk '
        function count(text, piece,    n, at) {
            while (at = index(text, piece)) { n++; text = substr(text, at + length(piece)) }
            return n + 0
        }
        function exists(path,    line, found) {
            if (!(path in known)) { found = (getline line < path) >= 0; close(path); known[path] = found }
            return known[path]
        }
        function check(    i, text) {
            if (page == "") return
            for (i = 1; i <= n_tags; i++)
                if (opened[i] != closed[i]) print page ": " opened[i] " times <" tag[i] ">, " closed[i] " times closed"
        }
        BEGIN { n_tags = split("p ul ol li table tr td th pre div section strong em sub sup code a math mrow mfrac msub", tag) }
        FNR == 1 {
            check()
            page = folder = FILENAME
            sub(/[^\/]*$/, "", folder)
            for (i = 1; i <= n_tags; i++) opened[i] = closed[i] = 0
        }
        {
            for (i = 1; i <= n_tags; i++) {
                opened[i] += count($0, "<" tag[i] ">") + count($0, "<" tag[i] " ")
                closed[i] += count($0, "</" tag[i] ">")
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
    sed -n 's/^<li><a href="\([^"#]*\)#\([^"]*\)".*/\1 \2/p' "$1" | while read -r page id; do
        grep -qF " id=\"$id\">" "$dir/html/$page" || echo "$page#$id"
    done
}
[ "$(grep -c '^<li><a href="[^"]*#' "$index")" -gt 200 ] || wrong "index.html lists few headings"
found=$(leads "$index")
[ -z "$found" ] || wrong "index.html leads to no heading: $found"
sed 's/#render"/#rendered"/' "$index" >"$dir/index.html"
[ -n "$(leads "$dir/index.html")" ] || wrong "a heading that is not there is not noticed"
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
