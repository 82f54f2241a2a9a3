# grade_all.sh: many copies, one table. Read by course.sh.

# grade_all DIR: DIR/STUDENT/N/ holds the files of assignment N that the student wrote, by their names alone. Each set
# is put into a fresh copy and graded there, so that the tests are ours; DIR/grades.csv gets a line, DIR/STUDENT/N.txt
# the words, DIR/STUDENT/N.report/ the pictures. What is graded runs with limits of time (course.sh) and of files, and
# without a network where unshare can take it away; as another user if GRADER names one and we may become it.
grade_all() {
    original
    top=$(cd "$1" && pwd) || exit
    echo "student,assignment,passed,builds,tests passed,test failed,mean,noise,steps to think of" >"$top/grades.csv"
    for folder in "$top"/*/*/; do
        folder=${folder%/}
        case $folder in *.report) continue ;; esac # of an earlier run
        student=$(basename "$(dirname "$folder")") n=$(names assignment | grep "^$(basename "$folder")-")
        [ -n "$n" ] || { say "$folder is of no assignment"; continue; }
        tree=$work/grade-all
        rm -rf "$tree" && cp -Rp $work/original "$tree" || exit
        missing=
        for file in $(get "$n" hole | sed 's/ .*//' | sort -u); do
            cp "$folder/$(basename "$file")" "$tree/$file" 2>/dev/null || missing="$missing ${file##*/}"
            touch "$tree/$file"
        done
        result=no
        (ulimit -f 200000; [ -z "$missing" ] && grade "$n" "$tree") \
            >"$folder.txt" 2>&1 && result=yes
        [ -z "$missing" ] || echo "not handed in:$missing" >"$folder.txt"
        rm -rf "$folder.report" && mkdir "$folder.report" || exit
        cp "$tree"/report/*.html "$tree"/report/*.png "$folder.report/" 2>/dev/null # none, if nothing was drawn
        sed "s|^Pictures and words: .*|Pictures and words: $folder.report/index.html|" "$folder.txt" >"$folder.words" &&
            mv "$folder.words" "$folder.txt"
        row "$student" "$n" $result "$folder.txt" | tee -a "$top/grades.csv"
    done
}

# row STUDENT NAME PASSED WORDS: a line of the table.
row() {
    awk -v student="$1" -v name="$2" -v passed="$3" '
        /does not compile|not handed in/ { builds = "no" }
        /^Test .* passed$/ { tests++ }
        /^Test .*FAILED/ { failed = $2 }
        /^Mean: / { mean = $2 }
        /^Noise: / { noise = $2 }
        /^- Step / { sub(/:.*/, ""); if (!named[$3]++) steps = steps (steps != "" ? " " : "") $3 }
        END { printf "%s,%s,%s,%s,%d,%s,%s,%s,%s\n", student, name, passed, builds == "" ? "yes" : builds, tests,
            failed, mean, noise, steps }' "$4"
}
