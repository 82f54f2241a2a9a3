#!/bin/sh
# corpus_run.sh: the measurement of corpus.md in the scenes of DIR/list.txt, each in a process of its own. OUT/N.csv
# holds the lines of scene N (test/lab/cmd_corpus.c), each after the number. What is there is not measured again.
# Whatever happens in a scene, the others go on: a method that ends its process is a line, and the rest of them are
# tried again. FORTY=yes: those drawn by lot of `report`, larger. JOBS: scenes at a time; LIST instead of DIR/list.txt;
# METHODS, HALF, WIDTH, SPP, SEEDS, LIMIT.
#   sh test/measure/corpus_run.sh DIR OUT [PROGRAM]
set -u
[ $# -ge 2 ] || { echo "usage: sh test/measure/corpus_run.sh DIR OUT [PROGRAM]" >&2; exit 2; }
directory=$1 out=$2 program=${3:-./asbdpt-lab} jobs=${JOBS:-1} list=${LIST:-$1/list.txt}
methods=${METHODS:-bdpt,pt,asbdpt}
case $program in */*) ;; *) program=./$program ;; esac
if [ "${FORTY:-}" = yes ]; then
    limit=${LIMIT:-100}
    size="--width ${WIDTH:-320} --spp ${SPP:-64} --seeds ${SEEDS:-2}"
else
    limit=${LIMIT:-40}
    size="--width ${WIDTH:-112} --spp ${SPP:-32} --seeds ${SEEDS:-3}"
fi
size="$size${HALF:+ --half $HALF}"
mkdir -p "$out" || exit
work=$(mktemp -d) || exit
trap 'rm -rf "$work"' EXIT
tab=$(printf '\t')

# wanted: the lines of the list that are measured
wanted() {
    [ "${FORTY:-}" = yes ] || { cat "$list"; return; }
    grep "${tab}report\$" "$list" | while IFS=$tab read -r number repository file set; do
        printf '%s\t%s\t%s\t%s\t%s\n' "$(printf '2026 %s/%s' "$repository" "$file" | cksum | cut -d ' ' -f 1)" \
            "$number" "$repository" "$file" "$set"
    done | sort -n | head -n 40 | cut -f 2- | sort -n
}

# without METHOD LIST: the others
without() {
    echo "$2" | tr , '\n' | grep -Fvx -e "$1" | tr '\n' , | sed 's/,$//'
}

# measure NUMBER FILE JOB: the scene's lines, numbered
measure() {
    left=$methods said=$work/said$3 rows=$work/rows$3
    : >"$rows"
    while [ -n "$left" ]; do
        (ulimit -v 2097152 2>"$said" # not every system has it
            ulimit -t $((60 + limit * 5))
            exec "$program" corpus "$2" --methods "$left" $size --limit "$limit") >"$rows.new" 2>"$said" </dev/null &&
            break
        status=$?
        culprit=$(sed -n 's/^begin //p' "$said" | tail -n 1)
        why="status $status: $(grep -Ev '^begin |warning: ' "$said" | sed -n 1p | tr ',\t' '; ')"
        : >"$rows.new"
        echo "failed,${culprit:--},$why" >>"$rows"
        [ -n "$culprit" ] || break
        left=$(without "$culprit" "$left")
    done
    sed "s/^/$1,/" "$rows.new" "$rows" >"$out/$1.csv.new" && mv "$out/$1.csv.new" "$out/$1.csv"
}

wanted >"$work/wanted"
[ -s "$work/wanted" ] || { echo "corpus_run.sh: no scene of $list is wanted" >&2; exit 1; }
job() {
    awk -v job="$1" -v jobs="$jobs" 'NR % jobs == job' "$work/wanted" >"$work/job$1"
    while IFS=$tab read -r number repository file set; do
        [ -f "$out/$number.csv" ] || measure "$number" "$directory/$(echo "$repository" | tr / +)/$file" "$1"
        echo "$number" # for the bar
    done <"$work/job$1"
}
i=0
while [ "$i" -lt "$jobs" ]; do
    job "$i" &
    i=$((i + 1))
done | "$program" progress --parts "$(wc -l <"$work/wanted" | tr -d ' ')"
