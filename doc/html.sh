#!/bin/sh
# html.sh OUT: all documents as static HTML in OUT, with the sources they link to; `make doc` calls it. Needs sh and awk.
# It ends where one of its commands fails, so no command whose status counts begins a pipeline.
set -eu
export LC_ALL=C
out=$1
rm -rf "$out"
mkdir -p "$out"
cat >"$out/style.css" <<'STYLE'
:root { color-scheme: light dark; }
body { max-width: 46em; margin: 0 auto; padding: 0 1em 4em; font: 1rem/1.55 Georgia, "Times New Roman", serif; }
nav { padding: 0.6em 0; border-bottom: 1px solid #8884; font-family: sans-serif; font-size: 0.9rem; }
nav a { margin-right: 1.2em; display: inline-block; }
h1, h2, h3 { font-family: sans-serif; line-height: 1.25; }
h2 { margin-top: 1.8em; }
a { color: #0b62b8; text-decoration: none; overflow-wrap: anywhere; }
a:hover { text-decoration: underline; }
pre, code { font-family: "DejaVu Sans Mono", Menlo, Consolas, monospace; font-size: 0.86em; }
code { white-space: nowrap; }
wbr { display: none; }
code.long { white-space: normal; overflow-wrap: anywhere; }
pre { overflow-x: auto; padding: 0.7em 1em; border-radius: 4px; line-height: 1.4; }
.math { border-left: 3px solid #0b62b8; }
.math td { border: none; padding: 0.3em 1.2em; vertical-align: middle; font-size: 1em; }
math { font-size: 1.08em; margin: 0; }
.wide { overflow-x: auto; }
pre, .wide { /* a shadow at the side to which it scrolls; what moves with the content covers it at the end */
    --paper: Canvas;
    background: linear-gradient(90deg, var(--paper) 40%, transparent) left / 2em 100% no-repeat local,
        linear-gradient(-90deg, var(--paper) 40%, transparent) right / 2em 100% no-repeat local,
        linear-gradient(90deg, #8889, transparent) left / 0.7em 100% no-repeat,
        linear-gradient(-90deg, #8889, transparent) right / 0.7em 100% no-repeat, var(--paper);
}
pre { --paper: color-mix(in srgb, Canvas, #888 7%); }
.wide td, .wide th { font-size: 0.92em; }
.wide:has(td > img) table { table-layout: fixed; width: 100%; }
.wide:has(td > img) code { white-space: normal; }
pre i { color: #487; font-style: normal; }
pre b { color: #a26; font-weight: normal; }
aside { display: none; }
@media screen and (min-width: 78em) {
    aside { display: block; position: fixed; top: 5em; left: 1em; width: calc(50vw - 26em); max-width: 15em;
        font: 0.85rem/1.4 sans-serif; }
    aside a { display: block; padding: 0.25em 0; }
}
@media screen and (min-width: 60em) {
    pre, .many { width: max-content; box-sizing: border-box; min-width: 100%; max-width: max(100%, 50vw + 21rem); }
}
table { border-collapse: collapse; margin: 1em 0; }
td, th { padding: 0.25em 0.7em; border-bottom: 1px solid #8884; text-align: left; vertical-align: top; }
td a { overflow-wrap: normal; }
.right { text-align: right; }
td.right { white-space: nowrap; }
img { max-width: 100%; height: auto; vertical-align: middle; }
img[src$=".svg"] { background: white; }
img[src*="figures/"][src$=".png"] { min-width: min(14em, 48%); }
sub, sup { font-size: 0.72em; line-height: 0; }
.source { max-width: 68rem; }
.source pre, .source .wide { width: auto; margin: 0; padding: 0; overflow: visible; background: none; }
.source h2 { margin: 1.6em 0 0.2em; font-size: 1.2em; }
.source > p:empty { margin: 0; height: 0.7em; }
.source pre a { color: inherit; overflow-wrap: normal; }
.source pre i { font: italic 1.1em/1.1 Georgia, "Times New Roman", serif; }
.source .n, .source .n:hover { display: inline-block; width: 2.6em; margin-right: 1.4em; text-align: right; color: #8889; user-select: none; }
.l { display: block; }
.c { margin: 1em 0 0.5em; padding-left: 0.9em; border-left: 3px solid #4878; }
.c p { max-width: 44em; margin: 0.5em 0; }
.c pre { margin: 0.4em 0; white-space: pre; overflow-x: auto; }
.f { display: flow-root; margin: 0.3em 0 0.1em 3.4em; padding: 0.2em 0.8em; border-left: 3px solid #0b62b8; font: 0.85rem sans-serif; background: #0b62b811; }
.f > a { float: right; margin-left: 1em; }
.f .math { margin: 0; border: none; }
.c .math { margin: 0; border: none; }
.f .math td { padding: 0.15em 1em 0.15em 0; }
.n { color: #888; }
:target { background: #fd08; }
@media screen and (max-width: 45em) {
    wbr { display: inline; }
    td code { font-size: 0.8em; }
    .drawing { max-width: none; width: 38em; }
    .source pre .l { white-space: pre-wrap; overflow-wrap: anywhere; padding-left: 2.8em; text-indent: -2.8em; font-size: 0.92em; }
    .source .n, .source .n:hover { width: 2.2em; margin-right: 0.6em; text-indent: 0; }
    .f { margin-left: 0; }
    .wide td, .wide th { padding: 0.25em 0.35em; font-size: 0.85em; }
    .math td { display: inline-block; padding: 0.2em 0.8em; font-size: 1em; }
}
@media screen and (max-width: 38em) {
    .wide:has(.drawing)::before { content: "wider than the screen: scroll \2192"; position: sticky; left: 0; display: block;
        width: max-content; font: 0.8rem sans-serif; color: #777; }
}
.slides { max-width: none; padding: 0; font: 3.8vmin/1.4 sans-serif; counter-reset: slide; }
.slides section { box-sizing: border-box; min-height: 100vh; padding: 3vh 8vw; counter-increment: slide; position: relative; }
.slides section::after { content: counter(slide); position: absolute; right: 2vw; bottom: 2vh; color: #888; }
.slides h3 { font-size: 1.4em; }
.slides h2 { font-size: 2em; padding-top: 12vh; }
.slides aside { display: none; }
.slides .wide { background: none; }
.slides :is(h2, h3, p, ul, ol, table) { margin: 0 0 0.6em; }
.slides img { display: block; margin: auto; width: 84vw; height: 60vh; object-fit: contain; }
@media screen { html:has(.slides) { scroll-snap-type: y proximity; } .slides section { scroll-snap-align: start; } }
@media (prefers-color-scheme: dark) { a { color: #7db8f2; } pre i { color: #7b9; } pre b { color: #e8a; } }
@page slides { size: A4 landscape; margin: 1.5cm 2cm; }
@media print {
    body { max-width: none; font-size: 10.5pt; }
    nav { display: none; }
    a { color: inherit; }
    pre { white-space: pre-wrap; font-size: 7pt; padding: 0.5em; }
    .wide { overflow: visible; background: none; }
    .many td, .many th { font-size: 7.5pt; padding: 0.2em 0.4em; }
    .many code { white-space: normal; }
    pre, tr, img { break-inside: avoid; }
    h2 { break-after: avoid; }
    .slides { font-size: 20pt; page: slides; }
    .slides pre { font-size: 0.8em; }
    .slides .many :is(td, th) { font-size: 0.8em; padding: 0.25em 0.5em; }
    .slides section { min-height: 0; padding: 0; break-after: page; position: static; }
    .slides section::after { display: none; }
    .slides img { width: 24cm; height: 11cm; }
    .sheet { padding: 0; }
    .sheet h2 ~ h2 { break-before: page; }
    .sheet h2::after { content: "Name: ........................................"; float: right; font: 10.5pt sans-serif; }
    .sheet h2 ~ p { padding-bottom: 1.8cm; break-inside: avoid; }
}
STYLE

# page FILE: one page of the tree.
page() {
    root=. rest=$1
    while [ "${rest#*/}" != "$rest" ]; do
        root=$root/.. rest=${rest#*/}
    done
    [ "$root" = . ] || root=${root#./}
    [ -d "$out/${1%"$rest"}" ] || mkdir -p "$out/${1%"$rest"}"
    case $1 in
    *.md) class= math=0
        case $1 in */slides*) class=slides ;; */quiz.md) class=sheet ;; esac
        case $1 in
        README.md) math=2 ;;
        doc/tour/* | doc/course/* | doc/method.md | doc/dissertation.md | doc/design-notes.md | doc/add-a-method.md) math=1 ;;
        esac
        awk -v root="$root" -v math=$math -v class=$class -v title="$(sed -n '/^# /{s///p;q;}' "$1")" -v marks="$work/marks" -f doc/math.awk -f doc/frame.awk -f doc/html.awk "$1" \
            >"$out/${1%.md}.html" ;;
    *.png | *.svg) cp "$1" "$out/$1" ;;
    *.html) sed 's/\(href="[^"]*\)\.md"/\1.html"/' "$1" >"$out/$1" ;;
    *.[ch]) echo "$1" >>"$work/sources" ;;
    *) awk -v root="$root" -v title="$1" -v source=1 -v class=source -f doc/math.awk -f doc/frame.awk -f doc/html.awk "$1" >"$out/$1.html" ;;
    esac
}

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
documents=$(find . \( -name 'build*' -o -name out -o -name .git \) -prune -o -name '*.md' -print | sed 's/^\.\///' | sort)
# What they link to, as paths from the top.
awk '
        { folder = index(FILENAME, "/") ? FILENAME : "."; sub(/\/[^\/]*$/, "", folder) }
        { while (match($0, /\]\([^() ]+\)/)) {
            url = substr($0, RSTART + 2, RLENGTH - 3)
            $0 = substr($0, RSTART + RLENGTH)
            sub(/#.*/, "", url)
            if (url ~ /^(https?:|mailto:|$)/ || url ~ /\.md$/) continue
            n = split(folder "/" url, part, "/")
            depth = 0
            for (i = 1; i <= n; i++)
                if (part[i] == "..") depth--
                else if (part[i] != ".") kept[++depth] = part[i]
            path = kept[1]
            for (i = 2; i <= depth; i++) path = path "/" kept[i]
            print path
        } }' $documents >"$work/linked"
LC_ALL=C awk -f doc/marks.awk doc/tour/*.md >"$work/marks"
for file in $documents $({ cat "$work/linked" && ls src/*/*.[ch]; } | sort -u); do
    if [ -f "$file" ]; then page "$file"; fi
done
LC_ALL=C awk -v out="$out" -v marks="$work/marks" -f doc/math.awk -f doc/frame.awk -f doc/source.awk $(cat "$work/sources")

# The first page: images, all pages, the small programs, and the headings of all pages to search in.
{
    echo '# asbdpt'
    echo '[What it is](README.md). All pages work without a network.'
    printf '\n## Gallery\n\n[The command and time of each image](doc/gallery.md)\n\n| | |\n|---|---|\n'
    awk '/^!\[/ && n < 6 { sub(/\]\(/, "](doc/"); row = row "| " $0 " "; if (++n % 2 == 0) { print row "|"; row = "" } }' doc/gallery.md
    printf '\n## Pages\n\n'
    sed -n '/^|/{s,](,](doc/,g;s,](doc/\.\./,](,g;p;}' doc/README.md
    printf '\n## Eight programs, from a ray to the whole method\n\n[How to read them](doc/mini/README.md)\n\n| program | what is new | image |\n|---|---|---|\n'
    sed -n 's,^| \([1-8]\) | \(\[.*\]\)(\(.*\)) | \(.*\) | [0-9]* |$,| \2(doc/mini/\3) | \4 | ![](doc/mini/figures/\1.png) |,p' doc/mini/README.md
} >"$work/index.md"
awk -v root=. -v title=asbdpt -f doc/math.awk -f doc/frame.awk -f doc/html.awk "$work/index.md" >"$work/index.html"
{
    sed '$d' "$work/index.html"
    echo '<h2 id="headings">Headings</h2><p><label>Search <input id="search" type="search"></label></p><ul id="list">'
    for file in $documents; do
        page=${file%.md}.html
        sed -n 's,^<h[12] id="\([^"]*\)">\(.*\)</h[12]>$,\1 \2,p' "$out/$page" >"$work/headings"
        awk -v page="$page" '
            { id = $1; sub(/^[^ ]* /, ""); gsub(/<[^>]*>/, "") }
            NR == 1 { title = $0 }
            { print "<li><a href=\"" page "#" id "\">" title (NR > 1 ? ": " $0 : "") "</a></li>" }' "$work/headings"
    done
    cat <<'END'
</ul>
<script>
document.getElementById('search').oninput = event => {
  for (const item of document.querySelectorAll('#list li'))
    item.hidden = !item.textContent.toLowerCase().includes(event.target.value.toLowerCase());
};
</script>
</body></html>
END
} >"$out/index.html"
echo "wrote $(find "$out" -name '*.html' | wc -l | tr -d ' ') pages; begin with $out/index.html"
