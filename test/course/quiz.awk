# quiz.awk: an awk program that computes the answers of the quiz.
#   awk -f test/course/quiz.awk doc/course/teacher/quiz.md doc/course/teacher/answers.md >X && awk -f X
# Every question needs one answer, and at least half of the questions a computation. X fails unless each of these,
# rounded to the digits of its answer, is that answer; else it prints how many there are. An awk may lack sqrt and exp: X
# has its own.
function wrong(text) { printf "print \"quiz: %s\"; bad = 1\n", text }

BEGIN {
    FS = " *[|] *"
    print "function sqrt_(x,    r, i) { for (r = 1; i < 99; i++) r = (r + x / r) / 2; return r }"
    print "function exp_(x,    r, i) { r = 1; for (i = 99; i > 0; i--) r = 1 + x / i * r; return r }"
    print "BEGIN { pi = 3.14159265358979"
}
FNR == 1 { file++ }
file == 1 && /^\*\*[0-9]+[a-z]\.\*\*/ {
    name = substr($0, 3, index($0, ".") - 3)
    if (asked[name]++) wrong("two questions " name)
    n++
}
file == 2 && $2 ~ /^[0-9]+[a-z]$/ {
    if (!($2 in asked) || answered[$2]++) wrong("an answer " $2 " too many")
    if ($4 !~ /^`[-0-9a-z.+*\/() ]+`$/) { if ($4 != "") wrong("no computation: " $2); next }
    computed++
    result = $3
    sub(/[: ].*/, "", result)
    digits = index(result, ".") ? length(result) - index(result, ".") : 0
    gsub(/sqrt|exp/, "&_", $4)
    printf "if ((x = sprintf(\"%%.%df\", %s)) != \"%s\" \"\") { print \"quiz: %s is \" x; bad = 1 }\n", digits,
        substr($4, 2, length($4) - 2), result, $2
}
END {
    for (name in asked) if (!answered[name]) wrong("no answer " name)
    if (n == 0 || 2 * computed < n) wrong(computed + 0 " of " n + 0 " questions to compute: fewer than half")
    printf "if (!bad) print \"%d questions, %d to compute\"; exit bad }\n", n, computed
}
