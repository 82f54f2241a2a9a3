#!/bin/sh
# release.sh DIR: what a release consists of, of the last commit and the programs of this tree, into DIR: the sources,
# the page that renders if it can be built, the man pages, the one file of C, the kit's scenes for other renderers, and
# checksums of all. `make release` calls it. The tag is set by hand: the last line says how. Exit status 1 if the tree has changes that no commit has, CHANGELOG.md has no line for
# the estimator, or doc/asbdpt.html, which is stored anew with a release only, is of older sources.
dir=$1
version=$(sed -n 's/^#define VERSION "asbdpt \(.*\)"$/\1/p' src/base/version.h)
estimator=$(sed -n 's/^#define ESTIMATOR \([0-9]*\)$/\1/p' src/base/version.h)
name=asbdpt-$version
die() { echo "release: $*" >&2; exit 1; }
[ -n "$dir" ] || die "a directory is missing"
[ -z "$(git status --porcelain)" ] || die "there are changes that are not committed"
grep -q "^| $estimator |" CHANGELOG.md || die "CHANGELOG.md has no line for estimator $estimator"
by() { sed -n 's/^<!-- built by \(.*\) -->$/\1/p' "$1"; } # another compiler makes other bytes
sum256() { if command -v sha256sum >/dev/null; then sha256sum; else shasum -a 256; fi; }
umask 022
rm -rf "$dir" && mkdir -p "$dir" || exit
git archive --prefix="$name/" HEAD >"$dir/$name.tar" && gzip -9n "$dir/$name.tar" || exit
make -s install PREFIX=/ DESTDIR="$dir/root" MANDIR=/man >/dev/null && mv "$dir/root/man/"*.1 "$dir" || exit
rm -rf "$dir/root"
sh scenes/generate/conform.sh "$dir/$name-conform" && tar -C "$dir" -cf "$dir/$name-conform.tar" "$name-conform" &&
    gzip -9n "$dir/$name-conform.tar" && rm -r "$dir/$name-conform" || exit
sh doc/embed/amalgamate.sh "$dir/one" && tar -C "$dir/one" -cf "$dir/$name-one-file.tar" asbdpt.c asbdpt.h &&
    gzip -9n "$dir/$name-one-file.tar" && rm -r "$dir/one" || exit
sh doc/web/build.sh "$dir/$name.html" >"$dir/log" 2>&1 || rm -f "$dir/$name.html"
if [ ! -f "$dir/$name.html" ]; then
    echo "release: no page that renders: $(tail -n 1 "$dir/log")"
elif [ "$(by "$dir/$name.html")" = "$(by doc/asbdpt.html)" ] && ! cmp -s "$dir/$name.html" doc/asbdpt.html; then
    die "doc/asbdpt.html is of older sources: cp $dir/$name.html doc/asbdpt.html, commit it, and again"
fi
rm -f "$dir/log"
sums=$(cd "$dir" && for file in *; do echo "$(sum256 <"$file" | cut -d ' ' -f 1)  $file"; done) || exit
echo "$sums" >"$dir/SHA256SUMS"
ls -l "$dir"
echo "then: git tag -a v$version -m '$name' && git push origin v$version"
