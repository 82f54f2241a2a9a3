#!/bin/sh
# html.sh: are the documents as HTML whole? (doc/html.sh) Every local link and picture leads to a file; tags are closed
# as often as they are opened; formulas have indices, lists and tables are there. A damaged page must be found out.
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT

# whole DIR: prints what is wrong with the pages of DIR.
whole() {
    find "$1" -name '*.html' | sort | LC_ALL=C xargs awk '
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
        BEGIN { n_tags = split("p ul ol li table tr td th pre div strong em sub sup code a math mrow mfrac msub", tag) }
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
            line = $0
            while (match(line, /(href|src)="[^"]*"/)) {
                url = substr(line, RSTART, RLENGTH)
                line = substr(line, RSTART + RLENGTH)
                gsub(/^[a-z]*="|"$/, "", url)
                if (url ~ /^(https?:|mailto:)/) continue
                sub(/#.*/, "", url)
                if (url != "" && !exists(folder url)) print page ": there is no " url
            }
        }
        END { check() }'
}

sh doc/html.sh "$dir/html" >/dev/null || exit 1
wrong=$(whole "$dir/html")
[ -z "$wrong" ] || { echo "$wrong"; exit 1; }
tour="$dir/html/doc/tour"
for text in '<msub><mi>p</mi><mrow><mi>s</mi></mrow></msub>' '<mo>&#x2211;</mo><mrow><mi>i</mi></mrow></munder>' \
    '<mrow><mi>light</mi></mrow></msub><mo>+</mo>' '</mrow></mfrac></math>' '<aside><a href="#the-formula">' \
    '<li><a href="../../src/transport/mis.h.html#L' '<td>dVCM</td>' '<img src="figures/' '<h2 id="mirrors">'; do
    grep -qF "$text" "$tour/06-connections.html" "$tour/07-weights.html" "$tour/07b-constant-time.html" ||
        { echo "html: no $text"; exit 1; }
done
mkdir "$dir/damaged"
echo '<a href="nothing.html">x</a>' >"$dir/damaged/damaged.html"
[ -n "$(whole "$dir/damaged")" ] || { echo "html: a link that leads nowhere is not noticed"; exit 1; }
echo '<p>x' >"$dir/damaged/damaged.html"
[ -n "$(whole "$dir/damaged")" ] || { echo "html: a tag that is not closed is not noticed"; exit 1; }
echo "html: $(find "$dir/html" -name '*.html' | wc -l | tr -d ' ') pages are whole"
