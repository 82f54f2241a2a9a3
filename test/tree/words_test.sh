#!/bin/sh
# words_test.sh: does words.sh find what is wrong in pages and sources, and nothing else?
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
mkdir -p "$dir/lists" "$dir/src" "$dir/doc" "$dir/test/lab"
printf '150 doc/short.md doc/more.md\n- doc/*.md\n175 all\n' >"$dir/lists/limits.txt"
printf '# comment\nbut for = except\nlamps? = light\nwhoever needs = anyone who needs\n' >"$dir/lists/phrases.txt"
printf 'doc/good.md | lamps | an exception\n' >"$dir/lists/exceptions.txt"
words() { sh test/tree/words.sh "$dir" "$dir/lists" >"$dir/told"; }
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
printf 'doc/short.md | lamps | an exception that nobody needs\n' >>"$dir/lists/exceptions.txt"
words
cat >"$dir/expected" <<'END'
doc/mean.md:1: long sentences -> 18.0 words in the mean
doc/short.md:1: lamp -> light
doc/short.md:3: but for -> except
doc/short.md:6: long sentence -> 36 words
exceptions.txt:2: an exception without use -> lamps
limits.txt:1: too many words -> 164 of 150 in doc/short.md doc/more.md
other.md:1: a page in no row of limits.txt
src/bad.c:2: whoever needs -> anyone who needs
src/bad.c:3: lamps -> light
END
grep '^[a-z/]*\.[a-z]*:' "$dir/told" | sort | diff "$dir/expected" -
