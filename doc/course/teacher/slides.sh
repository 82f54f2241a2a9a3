#!/bin/sh
# slides.sh OUT.html: the figures of the tour as slides in one file, with each page's question, its first formula, and the
# answers of the quiz as a note, which the key n shows. Arrow keys, space or a click turn. Run from the top.
out=$1

# side_by_side PARTS WIDTH HEIGHT: a figure that is taller than a slide, cut into equal parts; its address is read.
side_by_side() {
    awk -v n="$1" -v width="$2" -v height="$3" '{
        printf "<div style=\"--f:url(%s)\">", $0
        for (i = 0; i < n; i++)
            printf "<i style=\"aspect-ratio:%g;background-size:100%% %d%%;background-position:0 %g%%\"></i>",
                width / height * n, 100 * n, 100 * i / (n - 1)
        print "</div>"
    }'
}

mkdir -p "$(dirname "$out")" || exit 1
{
    cat <<'HEAD'
<!doctype html><meta charset=utf-8><meta name=viewport content="width=device-width"><title>The tour, in slides</title>
<style>
body { margin: 0; background: #fff; color: #222; font: 3vmin/1.4 system-ui, sans-serif; }
section { display: none; box-sizing: border-box; height: 100vh; padding: 4vmin; flex-direction: column; align-items: center; gap: 2vmin; }
section.on { display: flex; justify-content: center; }
h1 { font-size: 5vmin; margin: 0; } p { margin: 0; text-align: center; }
img { flex: 1; min-height: 0; max-width: 92vw; object-fit: contain; image-rendering: auto; width: 92vw; }
div { flex: 1; display: flex; gap: 2vw; width: 92vw; align-items: center; } i { flex: 1; background-image: var(--f); }
pre { font-size: 2.6vmin; margin: 0; white-space: pre-wrap; overflow-wrap: anywhere; } aside { display: none; font-size: 2.2vmin; } .notes aside { display: block; }
</style>
HEAD
    for page in doc/tour/[01]*.md; do
        title=$(sed -n 's/^# //p;/^# /q' "$page")
        question=$(sed -n 's/^\*\*Question: \(.*\)\*\*$/\1/p' "$page" | head -n 1)
        number=$(basename "$page" | sed 's/^0*\([0-9]*\).*/\1/')
        formula=$(awk '/^    [^ ]/ { on = 1; print substr($0, 5); next } on { exit }' "$page" | sed 's/&/\&amp;/g; s/</\&lt;/g')
        note=$(sed -n "/^\*\*$number\. /,/^\$/p" doc/course/teacher/quiz.md | sed 's/<//g; s/\*//g')
        printf '<section><h1>%s</h1><p>%s</p><pre>%s</pre><aside>%s</aside></section>\n' "$title" "$question" "$formula" \
            "$note"
        grep -o '!\[[^]]*\](figures/[^)]*)' "$page" | sed 's/^!\[\(.*\)\](\(.*\))$/\2|\1/' |
            while IFS='|' read -r file words; do
                case $file in *.svg) type=svg+xml ;; *) type=png ;; esac
                data="data:image/$type;base64,$(base64 <"doc/tour/$file" | tr -d '\n')"
                printf '<section><p>%s</p>' "$words"
                case $file in
                */alias.svg) printf '%s\n' "$data" | side_by_side 3 410 1140 ;;
                */pyramid.png) printf '%s\n' "$data" | side_by_side 2 568 920 ;;
                *) printf '<img alt="" src="%s">\n' "$data" ;;
                esac
                echo '</section>'
            done
    done
    cat <<'TAIL'
<script>
const all = [...document.querySelectorAll('section')];
let at = Math.min(all.length - 1, Number(location.hash.slice(1)) || 0);
function turn(by) {
  all[at].className = '';
  at = Math.max(0, Math.min(all.length - 1, at + by));
  all[at].className = 'on';
  history.replaceState(null, '', '#' + at);
}
addEventListener('keydown', e => e.key === 'n' ? document.body.classList.toggle('notes') : turn(['ArrowRight', 'ArrowDown', ' ', 'PageDown'].includes(e.key) ? 1 :
  ['ArrowLeft', 'ArrowUp', 'PageUp'].includes(e.key) ? -1 : 0));
addEventListener('click', () => turn(1));
turn(0);
</script>
TAIL
} >"$out"
echo "wrote $out, $(grep -c '<section>' "$out") slides"
