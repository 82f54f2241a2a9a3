#!/bin/sh
# tools.sh [NAME...]: scripts with the shells and awks of other systems, and the program by other makes and compilers.
# `make scripts` and `make doc` must pass with the tools of each row and make the same pages:
#   gawk      bash as sh and gawk, both held to POSIX; as on Fedora, Arch, openSUSE; macOS has such a shell
#   bwk       mksh as sh and the awk of the BSDs and macOS
#   busybox   busybox as sh, awk, sed, grep, sort and the rest; as on Alpine
# Further rows:
#   status    an awk that does its work and then ends with 2: make doc and every check must fail
#   bmake     says which make is needed, first of all
#   tcc       builds by make the program of the same bytes; after an edit of a header it compiles again
# Of every row one line is said: passed, skipped (and why), or FAIL. TOOLS=DIR: where tools are that are not in PATH.
# Run from the top, where make has been run.
#   sh test/run/tools.sh fetch DIR: puts Debian's into DIR for TOOLS=DIR; installs nothing
chosen=" $* "
unset FULL # here the least is enough
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
trap 'exit 1' HUP INT TERM
PATH=$PATH${TOOLS:+:$TOOLS}
failures=0

# fetch DIR: a program of a package that is unpacked but not installed is called with its own libraries.
fetch() {
    cd "$dir" || exit 1
    for package in gawk libsigsegv2 original-awk mksh busybox bmake tcc; do
        apt-get download $package >"$dir/log" 2>&1 && dpkg -x "$dir/$package"_*.deb "$dir/root" ||
            echo "skipped: no package $package"
    done
    mkdir -p "$1" && cp -R "$dir/root" "$1" || exit 1
    libraries=$(dirname "$(find "$1/root/usr/lib" -name 'libsigsegv.so*' | head -n 1)")
    for tool in usr/bin/gawk usr/bin/original-awk bin/mksh bin/busybox usr/bin/bmake usr/bin/tcc; do
        [ -f "$1/root/$tool" ] || continue
        case ${tool##*/} in
        bmake) options="-m $1/root/usr/share/bmake/mk-bmake" ;;
        tcc) options="-B$libraries/tcc" ;;
        *) options= ;;
        esac
        printf '#!/bin/sh\nLD_LIBRARY_PATH=%s exec %s %s "$@"\n' "$libraries" "$1/root/$tool" "$options" >"$1/${tool##*/}"
        chmod +x "$1/${tool##*/}"
    done
}
if [ "${1-}" = fetch ]; then
    case $2 in /*) fetch "$2" ;; *) fetch "$PWD/$2" ;; esac
    exit
fi
say() { printf '%-8s %s\n' "$1" "$2"; }
failed() {
    say "$1" "FAIL: $2"
    grep -v -e '^passed' "$dir/log" | tail -n 12
    failures=$((failures + 1))
}
# wanted NAME TOOL...: is this row asked for, and are its tools there?
wanted() {
    case $chosen in "  " | *" $1 "*) ;; *) return 1 ;; esac
    row=$1
    shift
    for tool; do
        command -v "$tool" >/dev/null || { say "$row" "skipped: no $tool"; return 1; }
    done
    rm -rf "$dir/bin" && mkdir "$dir/bin"
}
# tool NAME COMMAND: with() runs COMMAND for NAME.
tool() {
    rm -f "$dir/bin/$1" && printf '#!/bin/sh\n%s\n' "$2" >"$dir/bin/$1" && chmod +x "$dir/bin/$1"
}
with() { PATH=$dir/bin:$PATH "$@" >"$dir/log" 2>&1; }
scripts() {
    if with awk 'BEGIN { print gen''sub(/a/, "b", 1, "a") }'; then
        failed "$row" "this awk has the functions of gawk"
    elif ! with make -s SHELL="$dir/bin/sh" scripts; then
        failed "$row" "make scripts"
    elif ! with sh doc/html.sh "$dir/html" || ! diff -r "$dir/here" "$dir/html" >"$dir/log"; then
        failed "$row" "make doc"
    else
        say "$row" "passed: make scripts, make doc"
    fi
}

sh doc/html.sh "$dir/here" >"$dir/log" 2>&1 || { failed doc "make doc"; exit 1; }
if wanted gawk bash gawk; then
    tool sh 'exec bash --posix "$@"' && tool awk 'exec gawk --posix "$@"' && scripts
fi
if wanted bwk mksh original-awk; then
    tool sh 'exec mksh "$@"' && tool awk 'exec original-awk "$@"' && scripts
fi
if wanted busybox busybox; then
    for applet in $(busybox --list); do tool "$applet" "exec busybox $applet \"\$@\""; done
    if ! with awk 'BEGIN { exit log(1) }'; then # Debian's
        say busybox "its awk has no log: the awk of this system takes its place"
        tool awk "POSIXLY_CORRECT=1 exec $(command -v awk) \"\$@\"" # which gawk obeys
    fi
    scripts
fi
if wanted status; then
    tool awk "$(command -v awk) \"\$@\"; exit 2"
    passing=
    for check in layers standard references limits links measured faults; do
        ! with make -s -o asbdpt-lab $check || passing="$passing $check"
    done
    ! with sh doc/html.sh "$dir/html" || passing="$passing doc"
    ! with sh test/run/suites.sh build/test || passing="$passing test"
    : >"$dir/log"
    if [ -n "$passing" ]; then failed status "passes without its awk:$passing"; else say status passed; fi
fi
if wanted bmake bmake; then
    with bmake && failed bmake "does not stop"
    if head -n 1 "$dir/log" | grep -q 'needs GNU make (gmake)'; then say bmake passed; else failed bmake "says something else"; fi
fi
if wanted tcc tcc; then
    mkdir "$dir/tree"
    for entry in *; do
        case $entry in asbdpt | asbdpt-lab | build* | out) ;; *) ln -s "$PWD/$entry" "$dir/tree" ;; esac
    done
    if ! with make -C "$dir/tree" CC=tcc asbdpt asbdpt-lab; then
        failed tcc "make"
    elif ! with sh test/run/hashes.sh "$dir/tree/asbdpt"; then
        failed tcc "other bytes"
    elif ! CC=tcc with sh test/run/build.sh ./asbdpt; then
        failed tcc "edits"
    else
        say tcc passed
    fi
fi
exit $((failures > 0))
