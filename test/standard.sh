#!/bin/sh
# standard.sh [TOP]: TOP's src and test/lab keep to what is the same everywhere:
#   1. it calls no function of libm that every library rounds in its own way, which would give pictures other bytes on
#      another machine: base/maths.h has them. What IEEE 754 or C99 defines to the last bit (sqrt, fabs, floor, ceil,
#      fmin, fmax, fmod, frexp, ldexp, nextafter) may be called;
#   2. it includes no header that C99 does not have, except in base/os.c and os_thread.c, nor asks there for what
#      headers may show.
# Prints what is wrong; exit status 0 only if nothing is.
top=${1:-.}
LC_ALL=C awk '
    BEGIN {
        n = split("sin cos tan asin acos atan atan2 sinh cosh tanh asinh acosh atanh exp exp2 exp10 expm1 log log2 " \
                  "log10 log1p pow sincos hypot cbrt erf erfc lgamma tgamma fma j0 j1 jn y0 y1 yn", name, " ")
        for (i = 1; i <= n; i++) rough[name[i]] = rough[name[i] "f"] = rough[name[i] "l"] = 1
        n = split("assert complex ctype errno fenv float inttypes iso646 limits locale math setjmp signal stdarg " \
                  "stdbool stddef stdint stdio stdlib string tgmath time wchar wctype", name, " ")
        for (i = 1; i <= n; i++) standard[name[i] ".h"] = 1
    }
    FILENAME !~ /base\/os(_thread)?\.c$/ && /^[ \t]*#[ \t]*(include[ \t]*<|define _)/ {
        header = $0
        gsub(/^[^<]*<|>.*/, "", header)
        if (!(header in standard)) { print FILENAME ":" FNR ": " $0 " belongs in base/os.c"; bad = 1 }
    }
    FNR == 1 { comment = 0 }
    {
        line = $0
        gsub(/\\./, "", line)
        gsub(/"[^"]*"/, "\"\"", line)
        if (comment && !sub(/^.*\*\//, "", line)) next
        gsub(/\/\*([^*]|\*+[^*\/])*\*+\//, " ", line)
        comment = sub(/\/\*.*/, "", line)
        while (match(line, /[A-Za-z_][A-Za-z_0-9]*/)) {
            word = substr(line, RSTART, RLENGTH)
            line = substr(line, RSTART + RLENGTH)
            if (word in rough && line ~ /^ *[(]/) {
                print FILENAME ":" FNR ": " word "() differs from machine to machine; see base/maths.h"
                bad = 1
            }
        }
    }
    END { exit bad || NR == 0 }' $(find "$top/src" "$top/test/lab" -name '*.[ch]' 2>/dev/null | sort)
