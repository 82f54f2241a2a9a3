#!/bin/sh
# standard.sh: src and test/lab keep to what is the same everywhere:
#   1. it calls no function of libm that every library rounds in its own way, which would give pictures other bytes on
#      another machine: base/maths.h has them. What IEEE 754 or C99 defines to the last bit (sqrt, fabs, floor, ceil,
#      fmin, fmax, fmod, frexp, ldexp, nextafter) may be called;
#   2. it includes no header that C99 does not have, except in base/os.c and os_thread.c, nor asks there for what
#      headers may show;
#   3. it prints messages by say_line() alone (base/error.h), which lets no control character of a file through.
# Prints what is wrong; exit status 0 only if nothing is. Run from the top.
export LC_ALL=C
awk -f test/tree/pieces.awk $(find src test/lab -name '*.[ch]' | sort) | awk -F '\t' '
    BEGIN {
        n = split("sin cos tan asin acos atan atan2 sinh cosh tanh asinh acosh atanh exp exp2 exp10 expm1 log log2 " \
                  "log10 log1p pow sincos hypot cbrt erf erfc lgamma tgamma fma j0 j1 jn y0 y1 yn", name, " ")
        for (i = 1; i <= n; i++) rough[name[i]] = rough[name[i] "f"] = rough[name[i] "l"] = 1
        n = split("assert complex ctype errno fenv float inttypes iso646 limits locale math setjmp signal stdarg " \
                  "stdbool stddef stdint stdio stdlib string tgmath time wchar wctype", name, " ")
        for (i = 1; i <= n; i++) standard[name[i] ".h"] = 1
    }
    $3 != "code" { next }
    $1 !~ /base\/os(_thread)?\.c$/ && $4 ~ /^ *# *(include *<|define _)/ {
        header = $4
        gsub(/^[^<]*<|>.*/, "", header)
        if (!(header in standard)) { print $1 ":" $2 ": " $4 " belongs in base/os.c"; bad = 1 }
    }
    $1 !~ /base\/(error|mem|progress)\.c$/ && $4 ~ /(printf|puts|putc|fwrite).*stderr/ {
        print $1 ":" $2 ": messages are printed by say_line()"
        bad = 1
    }
    {
        while (match($4, /[A-Za-z_][A-Za-z_0-9]*/)) {
            word = substr($4, RSTART, RLENGTH)
            $4 = substr($4, RSTART + RLENGTH)
            if (word in rough && $4 ~ /^ *[(]/) {
                print $1 ":" $2 ": " word "() differs from machine to machine; see base/maths.h"
                bad = 1
            }
        }
    }
    END { exit bad || NR == 0 }'
