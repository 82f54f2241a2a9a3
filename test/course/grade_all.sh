# grade_all.sh: many copies, one table. Read by course.sh.

# What no assignment needs, as a regular expression: whatever ends, starts or reads another program, and other files.
OUTSIDE='constructor|destructor|_?exit|abort|atexit|exec[a-z]*|system|popen|fork|syscall|asm|dlopen|fopen|getenv'

# grade_all DIR JOBS: DIR/STUDENT/N/ holds the files of assignment N that the student wrote, by their names alone. Each
# set is put into a fresh copy and graded there, so that the tests are ours; DIR/grades.csv gets a line,
# DIR/STUDENT/N.txt the words, DIR/STUDENT/N.report/ the pictures. What is graded runs with limits of time (course.sh)
# and of files, and without a network where unshare can take it away; as another user if GRADER names one and we may
# become it.
grade_all() {
    original
    top=$(cd "$1" && pwd) && began=$(date +%s) && rm -f "$top"/*/*.row || exit
    jobs=0 sets=0
    for folder in "$top"/*/*/; do
        folder=${folder%/}
        case $folder in *.report) continue ;; esac # of an earlier run
        n=$(names assignment | grep "^$(basename "$folder")-") || { say "$folder is of no assignment"; continue; }
        (one "$folder" "$n") &
        sets=$((sets + 1)) jobs=$((jobs + 1))
        [ $jobs -lt "$2" ] || { wait; jobs=0; }
    done
    wait
    echo "student,assignment,passed,builds,tests passed,test failed,mean,noise,steps to think of,to be looked at" |
        cat - "$top"/*/*.row >"$top/grades.csv"
    rm -f "$top"/*/*.row
    cat "$top/grades.csv"
    say "$sets sets in $((($(date +%s) - began + 59) / 60)) minutes: $top/grades.csv"
}

# one FOLDER NAME: grade what is in it, and make its row.
one() {
    tree=$(mktemp -d "${TMPDIR:-/tmp}/XXXXXXXXXX") && cp -Rp "$original/." "$tree" || exit
    missing= result=no
    for file in $(get "$2" hole | sed 's/ .*//' | sort -u); do
        cp "$1/$(basename "$file")" "$tree/$file" 2>/dev/null || missing="$missing ${file##*/}"
        touch "$tree/$file"
    done
    (ulimit -f 200000; [ -z "$missing" ] && grade "$2" "$tree") >"$1.txt" 2>&1 && result=yes
    [ -z "$missing" ] || echo "not handed in:$missing" >"$1.txt"
    rm -rf "$1.report" && mkdir "$1.report" || exit
    cp "$tree"/report/*.html "$tree"/report/*.png "$1.report/" 2>/dev/null # none, if nothing was drawn
    sed "s|^Pictures and words: .*|Pictures and words: $1.report/index.html|" "$1.txt" >"$1.words" &&
        mv "$1.words" "$1.txt"
    row "$(basename "$(dirname "$1")")" "$2" $result "$1.txt" "$(outside "$2" "$tree")" >"$1.row"
    rm -rf "$tree"
}

# outside NAME TREE: the words of OUTSIDE and the includes that the student's files have and ours have not.
outside() {
    for file in $(get "$1" hole | sed 's/ .*//' | sort -u); do
        words "$original/$file" >"$2/ours"
        words "$2/$file" | comm -23 - "$2/ours" | tr ',"\n' '   '
    done
}
words() { { grep -owE "$OUTSIDE" "$1"; grep '^ *# *include' "$1"; } | sort -u; }

# row STUDENT NAME PASSED WORDS OUTSIDE: a line of the table.
row() {
    awk -v student="$1" -v name="$2" -v passed="$3" -v outside="$5" '
        /does not compile|not handed in/ { builds = "no" }
        /^Test .* passed$/ { tests++ }
        /^Test .*FAILED/ { failed = $2 }
        /^Mean: / { mean = $2 }
        /^Noise: / { noise = $2 }
        /^- Step / { sub(/:.*/, ""); if (!named[$3]++) steps = steps (steps != "" ? " " : "") $3 }
        END { printf "%s,%s,%s,%s,%d,%s,%s,%s,%s,%s\n", student, name, passed, builds == "" ? "yes" : builds, tests,
            failed, mean, noise, steps, outside }' "$4"
}
