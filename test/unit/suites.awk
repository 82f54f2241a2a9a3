# suites.awk: prints build/suites.h, the table of suites, from test/unit/*.c: `void test_NAME(struct test *t)` is the
# suite NAME, which `make test` runs; one whose name ends in -long runs only with --slow or by its name.
BEGIN { print "/* suites.h: made by test/unit/suites.awk; what each suite tests is said by its file. */\n#include \"test.h\"\n" }
/^void test_[a-z_]*\(struct test \*t\)/ && !/;$/ {
    name = $2
    sub(/\(.*/, "", name)
    print "void " name "(struct test *t);"
    suite = substr(name, 6)
    gsub("_", "-", suite)
    rows = rows " \\\n    {\"" suite "\", " name ", " (suite ~ /-long$/ ? "true" : "false") "},"
}
END { print "\n#define SUITES" rows }
