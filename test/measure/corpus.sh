#!/bin/sh
# corpus.sh: scenes of pbrt-v3 by others, as corpus.md beside it says. Brings the repositories of corpus.txt into DIR,
# renders every main file small, and writes what is left, with tabs between fields:
#   DIR/list.txt      number, repository, file, tune or report
#   DIR/left_out.txt  repository, file, reason, the program's message
# A repository that lies in DIR/OWNER+NAME stays as it is, so without any network those that are there are taken.
#   sh test/measure/corpus.sh DIR [PROGRAM]
set -eu
[ $# -ge 1 ] || { echo "usage: sh test/measure/corpus.sh DIR [PROGRAM]" >&2; exit 2; }
repositories=${REPOSITORIES:-$(dirname "$0")/corpus.txt}
program=${2:-./asbdpt}
case $program in /*) ;; *) program=$(pwd)/$program ;; esac
mkdir -p "$1"
directory=$(cd "$1" && pwd)
most=16 # scenes of a repository
tab=$(printf '\t')
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# bring REPOSITORY COMMIT: its files below 4 MiB
bring() {
    to=$directory/$(echo "$1" | tr / +)
    [ ! -d "$to" ] || return 0
    rm -rf "$to.new"
    git init -q "$to.new" && git -C "$to.new" fetch -q --depth 1 "https://github.com/$1.git" "$2" </dev/null &&
        git -C "$to.new" -c advice.detachedHead=false checkout -q FETCH_HEAD || { rm -rf "$to.new"; return 1; }
    rm -rf "$to.new/.git"
    find "$to.new" -type f -size +8191 -exec rm {} +
    mv "$to.new" "$to"
}

# reason MESSAGE: why the program has refused, in a few words
reason() {
    case $1 in
    "") echo "too long" ;; # ended by the limit
    *memory*) echo "too large" ;;
    *"be opened"* | *"cannot open"*) echo "a file is missing" ;;
    *"unknown directive"* | *pbrt-v4*) echo "not of pbrt-v3" ;;
    *"not supported"* | *"not known"*) echo "what the program has not" ;;
    *) echo "damaged" ;;
    esac
}

leave() { printf '%s\t%s\t%s\t%s\n' "$1" "$2" "$3" "$4" >>"$work/left"; }

# render FILE: one small picture by path tracing, whatever the scene's film, filter and depth are
render() {
    (ulimit -t 120 && exec "$program" "$1" --integrator pt --res 16x16 --filter box --maxdepth 5 --spp 4 --seed 1 -j 1 \
        --max-memory 2 --quiet -o "$work/picture.pfm") >"$work/said" 2>&1 </dev/null
}

# try REPOSITORY FILE SET: on the list, or left out
try() {
    rm -f "$work/picture.pfm"
    if ! render "$directory/$(echo "$1" | tr / +)/$2"; then
        message=$(grep -v ': warning: ' "$work/said" | sed -n 1p | tr '\t' ' ')
        leave "$1" "$2" "$(reason "$message")" "$message"
        return
    fi
    sum=$(cksum <"$work/picture.pfm" | tr ' ' -)
    if [ "$(tail -c 3072 "$work/picture.pfm" | tr -d '\000' | wc -c)" -eq 0 ]; then
        leave "$1" "$2" "black" ""
    elif twin=$(grep "^$sum$tab" "$work/pictures"); then
        leave "$1" "$2" "duplicate" "$(echo "$twin" | cut -f 2-)"
    else
        number=$((number + 1))
        taken=$((taken + 1))
        printf '%s\t%s/%s\n' "$sum" "$1" "$2" >>"$work/pictures"
        printf '%d\t%s\t%s\t%s\n' "$number" "$1" "$2" "$3" >>"$work/list"
    fi
}

number=0
: >"$work/list"
: >"$work/left"
: >"$work/pictures"
grep -v '^#' "$repositories" | while read -r repository commit note; do
    if [ "$commit" = - ] || ! bring "$repository" "$commit" 2>"$work/said"; then
        leave "$repository" "" "not fetched" "${note:-$(sed -n 1p "$work/said")}"
        continue
    fi
    taken=0
    case $(printf %s "$repository" | cksum | cut -d ' ' -f 1) in *[02468]) set=tune ;; *) set=report ;; esac
    (cd "$directory/$(echo "$repository" | tr / +)" && find . -name '*.pbrt' -type f -exec grep -l WorldBegin {} +) |
        sed 's,^\./,,' | while read -r file; do
            printf '%s\t%s\n' "$(printf %s "$file" | cksum | cut -d ' ' -f 1)" "$file"
        done | sort -n | cut -f 2- >"$work/files"
    while read -r file; do
        if [ "$taken" -lt "$most" ]; then
            try "$repository" "$file" "$set"
        else
            leave "$repository" "$file" "more than $most of a repository" ""
        fi
    done <"$work/files"
    echo "$repository: $taken of $(wc -l <"$work/files" | tr -d ' ')" >&2
    cp "$work/list" "$directory/list.txt"
    cp "$work/left" "$directory/left_out.txt"
done
cp "$work/list" "$directory/list.txt"
cp "$work/left" "$directory/left_out.txt"
