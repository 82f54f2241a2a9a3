#!/bin/sh
# suites_test.sh: does suites.sh count what fails, say why in the last lines, and of what passes one line? Do tests run
# in paths with blanks and with files of their own?
. test/run/expect.sh
cat >pass <<'END'
#!/bin/sh
[ "$1" != -l ] || { printf 'one\ntwo\nthree (slow)\n'; exit; }
echo noise
echo "skipped: this, which is not installed"
END
cat >fail <<'END'
echo "FAIL: the reason"
for warning in 1 2 3 4 5 6 7 8 9; do echo "noise $warning" >&2; done
exit 1
END
cat >where <<'END'
case $PWD in *' '*) ;; *) exit 1 ;; esac
case $TMPDIR in *"$(printf ' w\303\266rds')") ;; *) exit 1 ;; esac
case $(umask) in 077 | 0077) [ -f Makefile ] ;; *) exit 1 ;; esac
END
chmod +x pass && PATH=$dir:$PATH
suites() {
    (cd "$top" && sh test/run/suites.sh "$@") >said.txt 2>&1
    status=$?
}
suites "sh '$dir/fail' x" pass "sh '$dir/where'" "sh '$dir/pass'"
check [ $status = 1 ]
tail -n 2 said.txt >last.txt
printf 'FAIL: the reason\n4 passed, 1 failed\n' | cmp -s - last.txt || fault "the last lines are $(cat last.txt)"
check [ "$(grep -c '^passed, [0-9]* s: ' said.txt)" = 4 ]
check [ "$(grep -c '^passed, .*: pass [a-z]*; skipped: this, which is not installed' said.txt)" = 2 ]
check [ "$(wc -l <said.txt)" = 17 ] # five, the failed one's name, its nine messages, and the last two
suites pass
check [ $status = 0 ]
suites
check [ $status = 1 ]
[ $failures -eq 0 ] && echo "suites.sh: all as expected"
exit $((failures > 0))
