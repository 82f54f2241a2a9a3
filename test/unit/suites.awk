# suites.awk: prints build/suites.h, the table of suites, from test/unit/*.c: `void test_NAME(struct test *t)` is the
# suite NAME, which `make test` runs; one whose name ends in -long runs only with --slow or by its name. What it tests
# is the first sentence of its file.
BEGIN { print "/* suites.h: made by test/unit/suites.awk. */\n#include \"test.h\"\n" }
FNR == 1 { head = 1; what = "" }
head {
    line = $0
    sub(/^\/\* */, "", line); sub(/^ \* ?/, "", line); sub(/^[a-z_]+\.c: /, "", line)
    if (sub(/ *\*\/.*/, "", line)) head = 0
    what = what (what == "" ? "" : " ") line
    if (match(what, /[.?]( |$)/)) { what = substr(what, 1, RSTART - 1); head = 0 }
    gsub(/["\\]/, "", what)
}
/^void test_[a-z_]*\(struct test \*t\)/ && !/;$/ {
    name = $2
    sub(/\(.*/, "", name)
    print "void " name "(struct test *t);"
    suite = substr(name, 6)
    gsub("_", "-", suite)
    rows = rows " \\\n    {\"" suite "\", " name ", " (suite ~ /-long$/ ? "true" : "false") ", \"" what "\"},"
}
END { print "\n#define SUITES" rows }
