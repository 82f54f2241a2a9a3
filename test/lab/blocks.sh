#!/bin/sh
# blocks.sh FILE REFERENCE WIDTHxHEIGHT: the mean of (a - b)^2 / (b^2 + 0.01) over blocks of 8x8 pixels of two PFM
# files.
for file in "$1" "$2"; do
    od -An -v -tf4 -j "$(head -n 3 "$file" | wc -c | tr -d ' ')" "$file" | tr -s ' ' '\n' | grep . | paste -d ' ' - - -
done | awk -v res="$3" '
    BEGIN { split(res, size, "x") }
    {
        n = (NR - 1) % (size[1] * size[2])
        sum[NR > size[1] * size[2], int(n / size[1] / 8), int(n % size[1] / 8)] += ($1 + $2 + $3) / 192
    }
    END {
        if (NR != 2 * size[1] * size[2]) exit 1
        for (y = 0; y < int(size[2] / 8); y++)
            for (x = 0; x < int(size[1] / 8); x++) {
                total += (sum[0, y, x] - sum[1, y, x]) ^ 2 / (sum[1, y, x] ^ 2 + 0.01)
                count++
            }
        print total / count
    }'
