# check.sh: is the course whole? Read by course.sh, which calls one of these.

# check: every hole applies and compiles, every exercise of the tour has an answer and every answer a mutant.
check() {
    dir=$(mktemp -d) && trap 'rm -rf "$dir"' EXIT && cp -R src "$dir/" || exit 2
    bad=0
    wrong() { say "course: $*"; bad=1; }
    hollow src/base/alias.c no_such_function "" "" >/dev/null && wrong "a missing function is not noticed"
    for n in $(names assignment); do
        [ -f "doc/course/$n.md" ] || wrong "there is no doc/course/$n.md"
        dig "$n" "$dir"
        for file in $(get "$n" hole | sed 's/ .*//' | sort -u); do
            case $file in *.h) file=src/transport/connect.c ;; esac
            ${CC:-cc} -std=c99 -I"$dir/src" -c -o "$dir/object.o" "$dir/$file" || wrong "$file has no body left"
        done
    done
    for name in $(names exercise); do
        grep -q "^$name " test/mutants/list.txt || wrong "there is no mutant $name"
    done
    for name in $(asked); do
        [ -n "$(get "$name" answer)" ] || wrong "the exercise with the mutant $name has no answer"
    done
    for word in . '[0-9]*' 1-a ''; do # no assignment's name
        sh test/course.sh start "$word" "$dir/none" >/dev/null 2>&1 || continue
        wrong "'$word' is taken for the name of an assignment"
    done
    [ $bad -eq 0 ] && say "course: $(names assignment | grep -c .) assignments, $(asked | grep -c .) exercises"
    return $bad
}

# asked: the mutants of the tour's exercises.
asked() {
    awk 'FNR == 1 { here = 0 }
        /^## Exercise/ { here = 1 }
        here { n = split($0, part, "mutant `"); for (i = 2; i <= n; i++) { sub(/`.*/, "", part[i]); print part[i] } }' \
        doc/tour/[01]*.md
}

# prove: every assignment fails with its hole, and passes with the original in it.
prove() {
    bad=0
    for n in $(names assignment); do
        tree=$work/prove-$n
        rm -rf "$tree"
        (start "$n" "$tree") >/dev/null
        (grade "$n" "$tree") >"$tree/hole.txt" 2>&1 && say "course: $n passes with its hole" && bad=1
        for file in $(get "$n" hole | sed 's/ .*//' | sort -u); do cat "$file" >"$tree/$file"; done
        (grade "$n" "$tree") >"$tree/solution.txt" 2>&1 && continue
        say "course: $n fails with the original: $tree/solution.txt"
        bad=1
    done
    [ $bad -eq 0 ] && say "course: every assignment fails with its hole and passes without"
    return $bad
}
