# check.sh: is the course whole? Read by course.sh, which calls one of these.

# check: every hole applies and compiles, every exercise of the tour has an answer and every answer a mutant, a copy is
# graded from within, and the answers of the quiz are what their computations give.
check() {
    dir=$(mktemp -d) && trap 'rm -rf "$dir"' EXIT && cp -R src "$dir/" || exit 2
    bad=0
    wrong() { say "course: $*"; bad=1; }
    hollow src/base/alias.c no_such_function "" "" >/dev/null && wrong "a missing function is not noticed"
    for n in $(names assignment); do
        [ -f "doc/course/$n.md" ] || wrong "there is no doc/course/$n.md"
        dig "$n" "$dir"
        for object in $(get "$n" early | cut -d ' ' -f 3-); do # what is not there is not built anew, and keeps its fault
            source=${object#build/obj/}
            source=${source%.o}.c
            [ -f "src/$source" ] || [ -f "$source" ] || wrong "$n: $object has no source"
        done
        for file in $(files "$n"); do
            case $file in src/geometry/*.h) file=src/geometry/shape.c ;; *.h) file=src/transport/connect.c ;; esac
            ${CC:-cc} -std=c99 -I"$dir/src" -fsyntax-only "$dir/$file" || wrong "$file has no body left"
        done
    done
    for n in $(names assignment); do
        for call in $(calls "$n"); do
            grep -qw "$call" "doc/course/$n.md" doc/course/README.md ||
                wrong "doc/course/$n.md says nothing of $call, which the solution calls"
        done
    done
    for name in $(names exercise); do
        grep -q "^$name " test/data/mutants/list.txt || wrong "there is no mutant $name"
    done
    for name in $(asked); do
        [ -n "$(get "$name" answer)" ] || wrong "the exercise with the mutant $name has no answer"
    done
    for n in $(names assignment); do
        for step in $(steps "$n"); do
            grep -q "^${n%%-*}-[^ ]* [^ ]* $step " $plants || wrong "no plant leaves out step $step of assignment $n"
            get "$n" hint | grep -q "^[^ ]* $step " || wrong "assignment $n has no hint of step $step"
        done
    done
    copies "$dir" || wrong "grade, called in a copy, does not ask the tree to grade that copy"
    quiz <$answers >/dev/null || wrong "the quiz and its answers do not agree"
    for damage in '/^| 2b /s/| 0/| 1/' '/^| 5c /s/| [0-9.]* /| nan /' '/^| 7a /d' '/^| 7c /s/2/0/g' 's/`.*`//'; do
        sed "$damage" $answers | quiz >/dev/null && wrong "the quiz is right with its answers after $damage"
    done
    [ $bad -eq 0 ] && say "course: $(names assignment | grep -c .) assignments, $(planted | grep -c .) steps left out, \
$(asked | grep -c .) exercises, $(quiz <$answers)"
    return $bad
}

# copies DIR: in a copy, in a path with blanks, `grade` calls the tree for this copy, and only for its assignment. What
# stands for the tree prints its place and words.
copies() {
    (
        mkdir -p "$1/a copy" "$1/its tree/test/run" && echo 'echo "$PWD" "$@"' >"$1/its tree/test/run/course.sh" &&
            cp -R "$1/its tree/test" "$1/a copy/" &&
            echo "1-alias $1/its tree" >"$1/a copy/.course" && script=$PWD/test/run/course.sh && cd "$1/a copy" &&
            [ "$(sh "$script" grade)" = "$1/its tree grade 1-alias $1/a copy" ] &&
            [ "$(sh "$script" grade 2 ../other)" = "$1/its tree grade 2 $1/a copy/../other" ] &&
            rm -r "$1/its tree" && ! sh "$script" grade 2>/dev/null
    )
}

# quiz: of the answers on standard input. Every question of the sheet has one row, `| 7b | result | computation |`; each
# result is its computation, rounded as it is written; at least half of the questions have one.
answers=doc/course/teacher/answers.md
quiz() {
    awk -f test/course/quiz.awk doc/course/teacher/quiz.md - >"$dir/quiz.awk" && awk -f "$dir/quiz.awk"
}

plants=test/course/plants.txt
planted() { awk '/^[0-9a-z]+-/ { print $1 }' $plants; }

# calls NAME: the functions, but for C's own, that the solution of an assignment calls.
calls() {
    get "$1" hole | while read -r file function stub; do
        awk -v name="$function" '$0 ~ "^[a-z].*[ *]" name "\\(" && !/;$/ { on = 1 } on; on && /^[}]/ { exit }' "$file" |
            sed '1d; s|/\*.*||' | grep -oE '[a-z_0-9]+[(]' | tr -d '('
    done | sort -u | grep -vxE 'if|while|for|return|sizeof|switch|sqrt|fabs'
}

# steps NAME: the numbered steps of an assignment's page, as hints and plants call them.
steps() {
    awk '/^## / {
            on = /^## Step by step|^## `walk_measure`/
            prefix = /to_leaf/ ? "v" : /walk_leave/ ? "d" : /walk_on/ ? "w" : /walk_measure/ ? "measure-" : ""
        }
        on && /^[1-9]\. / { sub(/\..*/, ""); print prefix $0 }' "doc/course/$1.md"
}

# asked: the mutants of the tour's exercises.
asked() {
    awk 'FNR == 1 { here = 0 }
        /^## Exercise/ { here = 1 }
        here { n = split($0, part, "mutant `"); for (i = 2; i <= n; i++) { sub(/`.*/, "", part[i]); print part[i] } }' \
        doc/tour/[01]*.md
}

# prove [N | PLANT]: every assignment (or assignment N) fails with its hole and passes with the original; every mistake
# that is planted (or PLANT alone) is found, and its step is named.
prove() {
    bad=0
    if ! planted | grep -q "^$1"; then # an assignment by its whole name
        names assignment | grep -qxF "$1" || die "nothing is planted by the name '$1'"
        set -- "${1%%-*}"
    fi
    for n in $(names assignment | grep "^${1%%-*}"); do
        tree=$work/prove-$n
        rm -rf "$tree"
        (start "$n" "$tree") >/dev/null
        case $1 in *-*) ;; *) prove_whole "$n" "$tree" ;; esac
        for plant in $(planted | grep "^${n%%-*}-" | grep "^$1"); do
            filled "$n" "$tree"
            sh test/data/mutants/apply.sh $plants "$plant" "$tree" || exit
            step=$(awk -v plant="$plant" '$1 == plant { print $3 }' $plants)
            if (QUICK=1; grade "$n" "$tree") >"$tree/$plant.txt" 2>&1; then
                say "course: $plant is not found"
            elif grep -q "does not compile" "$tree/$plant.txt"; then
                say "course: $plant does not compile: $tree/$plant.txt"
            elif grep -q "^- Step $step: " "$tree/$plant.txt"; then
                say "course: $plant: step $step is named"
                continue
            else
                say "course: $plant is found, but step $step is not named: $tree/$plant.txt"
            fi
            bad=1
        done
    done
    [ $bad -eq 0 ] && say "course: every mistake handed in is found and named, every original handed in passes"
    return $bad
}

# prove_whole NAME TREE: with its hole, and with the original.
prove_whole() {
    (QUICK=1; grade "$1" "$2") >"$2/hole.txt" 2>&1 && say "course: $1 passes with its hole" && bad=1
    filled "$1" "$2"
    (cd "$2" && sh test/run/course.sh grade) >"$2/solution.txt" 2>&1 && return
    say "course: $1 fails with the original: $2/solution.txt"
    bad=1
}

# filled NAME TREE: with the original's functions; what is the same is not built again.
filled() {
    for file in $(files "$1"); do
        cmp -s "$file" "$2/$file" || cat "$file" >"$2/$file"
    done
}
