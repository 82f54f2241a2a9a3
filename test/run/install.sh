#!/bin/sh
# install.sh: make install puts programs, man pages, library and header where it is told, whatever the path and the umask, and
# make uninstall removes these and nothing else. Run from the top: sh test/run/install.sh ./asbdpt
. test/run/expect.sh
make=${MAKE:-make}
run() { (cd "$top" && umask 077 && "$make" -s -o all -o lib "$1" DESTDIR="$here" PREFIX="$2"); }

for name in plain 'two words' "it's \"quoted\"; exit 3"; do
    here=$dir/$name/root prefix="/usr/$name"
    mkdir -p "$name"
    echo mine >two # what uninstall would take for the path before the blank
    expect 0 '' run install "$prefix"
    cat >wanted.txt <<END
-rw-r--r-- $here$prefix/include/asbdpt.h
-rw-r--r-- $here$prefix/lib/libasbdpt.a
-rw-r--r-- $here$prefix/lib/pkgconfig/asbdpt.pc
-rw-r--r-- $here$prefix/share/man/man1/asbdpt-lab.1
-rw-r--r-- $here$prefix/share/man/man1/asbdpt.1
-rwxr-xr-x $here$prefix/bin/asbdpt
-rwxr-xr-x $here$prefix/bin/asbdpt-lab
-rwxr-xr-x $here$prefix/lib/libasbdpt.so
END
    find "$name" -type f -exec ls -l {} + | sed "s|^\([-rwx]*\).* $name/|\1 $dir/$name/|" | LC_ALL=C sort >found.txt
    cmp -s wanted.txt found.txt || fault "$name: installed are $(cat found.txt)"
    check [ -z "$(find "$name" -mindepth 1 -type d ! -perm 755)" ]
    for made in asbdpt asbdpt-lab; do
        expect 0 '' "$here$prefix/bin/$made" --version
        check grep -q "^.TH $made 1" "$here$prefix/share/man/man1/$made.1"
        check grep -q -e '\\-\\-cropwindow' "$here$prefix/share/man/man1/$made.1"
    done
    echo mine >"$here$prefix/bin/other"
    expect 0 '' run uninstall "$prefix"
    check [ "$(find "$name" -type f | wc -l)" -eq 1 ]
    check [ "$(cat two)" = mine ]
done
check [ "$(ls | grep -v txt | wc -l)" -eq 4 ] # nothing beside what was asked for
[ $failures -eq 0 ] && echo "install: all as expected"
exit $((failures > 0))
