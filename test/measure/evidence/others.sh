#!/bin/sh
# others.sh: clones from GitHub the scenes that others.txt beside it lists. DIR/NAME is a copy of the folder of each
# scene, so that relative paths hold, with a scene.pbrt that includes the scene unless that is its name. A scene
# that is there stays as it is.
#   sh test/measure/evidence/others.sh DIR
set -eu
[ $# -eq 1 ] || { echo "usage: sh test/measure/evidence/others.sh DIR" >&2; exit 2; }
list=$(cd "$(dirname "$0")" && pwd)/others.txt
mkdir -p "$1"
clones=$(mktemp -d)
trap 'rm -rf "$clones"' EXIT
grep -v '^#' "$list" | while read -r name kind repository path commit; do
    [ ! -f "$1/$name/scene.pbrt" ] || continue
    clone=$clones/$repository
    [ -d "$clone" ] || git clone -q "https://github.com/$repository.git" "$clone" </dev/null
    mkdir -p "$1/$name"
    git -C "$clone" archive -o "$clone.tar" "$commit:./$(dirname "$path")"
    tar -x -f "$clone.tar" -C "$1/$name"
    scene=$(basename "$path")
    [ "$scene" = scene.pbrt ] || echo "Include \"$scene\"" >"$1/$name/scene.pbrt"
    echo "$name: $kind, $repository/$path"
done
