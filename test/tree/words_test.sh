#!/bin/sh
# words_test.sh: does words.sh find what is wrong in pages and sources, and nothing else?
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
mkdir -p "$dir/src" "$dir/doc" "$dir/test/lab"
cat >"$dir/words.txt" <<'END'
== limits
150 doc/short.md doc/more.md
- doc/*.md
175 all
== phrases
# comment
but for = except
lamps? = light
whoever needs = anyone who needs
== exceptions
doc/good.md | lamps | an exception
END
words() { sh test/tree/words.sh "$dir" "$dir/words.txt" >"$dir/told"; }
# repeat COUNT TEXT
repeat() { awk -v count="$1" -v text="$2" 'BEGIN { while (count-- > 0) printf "%s ", text }'; }

{
    printf '# A heading is no sentence\n%s.\n![A lamp](lamp.png)\n\n' "$(repeat 34 word)word"
    printf 'The command `but for` renders. [The lens](lamp.md) has no lamps.\n\n'
    printf '<!-- measured: lamp -->\n| a lamp |\n<!-- end -->\n| many-lamps.pbrt |\n'
    printf '\n    but for\n\n```\nlamp\n```\n'
} >"$dir/doc/good.md"
printf '#include "lamp.h"\n/* A light, `lamp` of lamp.h. */\nchar *lamp = "\\"good", c = %s, lamp;\n' "'\"'" \
    >"$dir/src/good.c"
words
grep -q ', 0 findings$' "$dir/told" || { echo "words.sh finds something in what is good:"; cat "$dir/told"; exit 1; }

{
    printf '# Lamp\n\nAll can do it but\nfor one.\n\n- '
    repeat 36 word
    printf '\n1. '
    repeat 20 'Six words are in this sentence.'
} >"$dir/doc/short.md"
repeat 3 "Here $(repeat 16 word)word." >"$dir/doc/mean.md"
echo 'A word.' >"$dir/other.md"
printf 'int a; /* a value\n * whoever\n * needs */ char *s = "is %%d lamps";\n' >"$dir/src/bad.c"
printf 'doc/short.md | lamps | an exception that nobody needs\n' >>"$dir/words.txt"
words
cat >"$dir/expected" <<'END'
doc/mean.md:1: long sentences -> 18.0 words in the mean
doc/short.md:1: lamp -> light
doc/short.md:3: but for -> except
doc/short.md:6: long sentence -> 36 words
other.md:1: a page without a limit
src/bad.c:2: whoever needs -> anyone who needs
src/bad.c:3: lamps -> light
words.txt:12: an exception without use -> lamps
words.txt:2: too many words -> 164 of 150 in doc/short.md doc/more.md
END
grep '^[a-z/]*\.[a-z]*:' "$dir/told" | sort | diff "$dir/expected" -
