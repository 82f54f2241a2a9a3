# suites.awk: prints build/suites.h, the table of suites, from test/unit/*.c: `void test_NAME(struct test *t)` is the
# suite NAME, which `make test` runs; one whose name ends in -long runs only with --slow or by its name. What it tests
# is the first sentence of a comment "NAME: ..." above it, or else of its file.
BEGIN { print "/* suites.h: made by test/unit/suites.awk. */\n#include \"test.h\"\n" }
FNR == 1 { what = "" }
/^\/\*/ { inside = 1; said = "" }
inside {
    line = $0
    if (sub(/ *\*\/.*/, "", line)) inside = 0
    sub(/^\/\* */, "", line); sub(/^ \* ?/, "", line); sub(/^[a-z_]+\.c: /, "", line)
    said = said (said == "" ? "" : " ") line
    if (inside) next
    if (match(said, /[.?]( |$)/)) said = substr(said, 1, RSTART - 1)
    gsub(/["\\]/, "", said)
    if (what == "") what = said
    if (match(said, /^[a-z-]+: /)) of[substr(said, 1, RLENGTH - 2)] = substr(said, RLENGTH + 1)
}
/^void test_[a-z_]*\(struct test \*t\)/ && !/;$/ {
    name = $2
    sub(/\(.*/, "", name)
    print "void " name "(struct test *t);"
    suite = name
    sub("test_", "", suite); gsub("_", "-", suite)
    long = sub(/-long$/, "", suite)
    rows = rows " \\\n    {\"" suite (long ? "-long" : "") "\", " name ", " (long ? "true" : "false") ", \"" (suite in of ? of[suite] : what) "\"},"
}
END { print "\n#define SUITES" rows }
