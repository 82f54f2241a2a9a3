#!/bin/sh
# sample.sh PROGRAM: doc/tour/one-sample.md is what doc/tour/sample.sh makes of its sample today, and the pixel that it
# adds up is that of a render of this sample alone, by the page's own commands, to the digits of a float. The page of
# another sample is another, its pixel differs, and a value that is not there is an error.
. test/run/expect.sh
page=$top/doc/tour/one-sample.md
ln -s "$program" asbdpt && ln -s "$lab" asbdpt-lab && ln -s "$top/scenes" scenes && mkdir out
made() { (cd "$top" && sh doc/tour/sample.sh "$lab" "$@"); }

# pixel FILE X Y: the three floats, below 2, of a .pfm of 64x64 pixels, whatever the order of this machine's bytes.
pixel() {
    at=$(($(wc -c <"$1") - 12 * 64 * 64 + 12 * (64 * (63 - $3) + $2)))
    od -An -v -tu1 -j $at -N 12 "$1" | tr -s ' \n' ' ' | awk '{
        for (i = 1; i <= 12; i += 4) {
            x = 1 + ($(i + 2) % 128 * 65536 + $(i + 1) * 256 + $i) / 8388608
            for (power = $(i + 3) % 128 * 2 + int($(i + 2) / 128) - 127; power < 0; power++) x /= 2
            printf "%.9g ", x
        }
    }'
}
same() { # "R G B" "R G B": alike to 7 digits
    echo "$1 $2" | awk '{
        for (i = 1; i <= 3; i++) { d = $i - $(i + 3); far += d * d > 9e-14 * $i * $i }
        exit NF != 6 || far > 0
    }'
}
told() { # WHAT SAMPLE: what the page's command says of a sample
    $(sed -n 's/^    \(\.\/asbdpt-lab trace .*\)/\1/p' "$page") --sample "$2" | sed -n "s/^$1 //p"
}

check made >made.md
cmp -s made.md "$page" || fault "the page is old: sh doc/tour/sample.sh ./asbdpt-lab >doc/tour/one-sample.md"
sed -n 's/^    \(\.\/asbdpt .*\)/\1/p' "$page" >commands
[ "$(wc -l <commands | tr -d ' ')" = 2 ] || fault "the page has not two commands that render"
expect 0 '' sh -e commands
of=$(pixel out/one.pfm 32 32)
check same "$(told pixel 8)" "$of"
# It has light that was joined to the lens. The sum without it, or another sample or pixel, is not that of the render.
for other in "$(told sum 8)" "$(told pixel 9)" "$(pixel out/one.pfm 32 33)"; do
    ! same "$other" "$of" || fault "$other is taken for the pixel $of"
done
check made 9 >other.md
! cmp -s other.md "$page" || fault "the page of sample 9 is that of sample 8"
! made 1 >other.md 2>error.txt || fault "a sample with one eye vertex less makes a page, too"
check grep -q 'there is no value z.2.beta' error.txt
[ $failures -eq 0 ] && echo "sample: the page's sum is the pixel of its render, $of"
exit $((failures > 0))
