#!/bin/sh
# power.sh: how small a fault does a suite find? Plants those of power.txt, in some sizes, in a copy of the tree.
# The table goes into doc/evidence.md, section Power. `power.sh check`: does every fault still apply?
# The list may name slow suites, too. All must pass without any fault: one that does not would seem to find them all.
# A suite that checks facts finds a size or does not. One that tests hypotheses finds an error e if its p is below 1e-4,
# which is |z| > 3.89; z is normal about e / sigma. So one planted error that is found, though not by far, tells sigma,
# and with probability 0.95 what is found is (3.89 + 1.64) sigma. z is the median over SEEDS.
set -u
list=${LIST:-test/measure/power.txt}
work=build-power
page=doc/evidence.md
SEEDS=${SEEDS:-1 2 3}
SIZES="0.01 0.002 0.1" # the second is tried where the first is found by far, the third where it is not found

# faults: their numbers. field N K: the K-th word of fault N; words N: what is wrong.
faults() { awk '/^[^-+# \t]/ { print ++n }' $list; }
field() { awk -v n="$1" -v k="$2" '/^[^-+# \t]/ && ++i == n { print $k }' $list; }
words() {
    awk -v n="$1" '/^[^-+# \t]/ && ++i == n { for (k = 4; k <= NF; k++) printf "%s ", $k }' $list | sed 's/ $//'
}

# numbered: the list with its lines numbered as names, for apply.sh. plant N: one of them.
numbered() { awk '/^[^-+# \t]/ { n++; $1 = "fault" n } { print }' $list; }
plant() {
    numbered >$work/list.txt
    sh test/data/mutants/apply.sh $work/list.txt "fault$1" $work/tree >&2
}

# judge SUITE: with what z it finds what is planted; "exact" if a fact fails, 0 if nothing does; the median of SEEDS.
judge() {
    for seed in $SEEDS; do judge_by "$1" "$seed"; done | sed 's/exact/1e9/' | sort -g |
        awk '{ z[NR] = $1 } END { m = z[int((NR + 1) / 2)]; print (m == 1e9 ? "exact" : m) }'
}

# judge_by SUITE SEED
judge_by() {
    (cd $work/tree && build/test --slow --once --seed "$2" "$1") >$work/output.txt 2>&1 && echo 0 && return
    awk '/p = .*, must be >=/ {
             sub(/,/, "", $3)
             if (!($3 > 0)) { most = 0; exit } # too small for a number: as good as a fact
             y = -2 * log($3 / 2)
             z = y
             for (i = 0; i < 9; i++)
                 z = y - log(6.2832) - log(z)
             most = sqrt(z) > most ? sqrt(z) : most
         }
         END { print (most > 0 ? most : "exact") }' $work/output.txt
}

# build N SIZE: the suite with that fault of that size.
build() {
    touch "$work/tree/$(field "$1" 2)"
    make -s -C $work/tree ${CC:+"CC=$CC"} LTO= CFLAGS="-DFAULT=$2" -o build/flags build/test >$work/output.txt 2>&1
}

# wanted SUITE SIZE: is this size to be tried after those before? By how far those are found.
wanted() {
    [ "$2" = 0.01 ] || awk -v suite="$1" -v size="$2" '
        $1 == suite { by_far = ($3 == "exact" || $3 > 12); none = ($3 == "0") }
        END { exit !(size == 0.002 ? by_far : none) }' $work/seen.txt
}

# row N: of the table. Each suite sees the same trees.
row() {
    file=$(field "$1" 2)
    cp "$work/tree/$file" $work/saved
    plant "$1" || exit 1
    rm -f $work/seen.txt
    for size in $SIZES; do
        for suite in $(field "$1" 3 | tr , ' '); do
            wanted "$suite" "$size" || continue
            build "$1" "$size" || { echo "fault $1 does not compile" >&2; continue; }
            echo "$suite $size $(judge "$suite")" >>$work/seen.txt
        done
    done
    cp $work/saved "$work/tree/$file"
    for suite in $(field "$1" 3 | tr , ' '); do
        awk -v suite="$suite" -v what="$(words "$1")" -v class="$(field "$1" 1)" '
            $1 == suite && $3 == "exact" && (least == "" || $2 < least) { least = $2 }
            $1 == suite && $3 + 0 > 3.8 { e = $2 * (3.89 + 1.64) / $3; found = found == "" || e < found ? e : found }
            END {
                text = "above 10"
                if (found != "")
                    text = sprintf("%.2g", 100 * found)
                if (least != "" && (found == "" || least < found))
                    text = "at most " 100 * least
                printf "| %s | %s | %s | %s |\n", class, what, suite, text
            }' $work/seen.txt
    done
}

if [ "${1-}" = check ]; then
    work=$(mktemp -d) && numbered >"$work/list.txt" && sh test/data/mutants/apply.sh check "$work/list.txt"
    status=$?
    rm -rf "$work"
    exit $status
fi
mkdir -p $work/tree
cp -Rp Makefile src test scenes ref doc $work/tree/
make -s -j2 -C $work/tree ${CC:+"CC=$CC"} LTO= build/test || exit 1
for suite in $(for n in $(faults); do field "$n" 3; done | tr , '\n' | sort -u); do
    for seed in $SEEDS; do
        (cd $work/tree && build/test --slow --seed "$seed" "$suite") >$work/output.txt 2>&1 ||
            { echo "$suite fails without any fault, seed $seed: $work/output.txt"; exit 1; }
    done
done
{
    printf '| class | what is wrong | suite | finds, per cent |\n|---|---|---|---:|\n'
    for n in $(faults); do
        row "$n"
    done
} >$work/table.md
awk -v table=$work/table.md '
    /^## / { here = /^## Power/ }
    here && /^\|/ { if (!done++) while ((getline line < table) > 0) print line; next }
    { print }' $page >$work/page.md && cp $work/page.md $page
