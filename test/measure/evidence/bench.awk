# bench.awk: the table of doc/performance.md from what `asbdpt-lab bench` prints.
/^[^ ].*\.pbrt$/ { name[++n] = $1; sub(/\.pbrt$/, "", name[n]); sub(/.*\//, "", name[n]) }
/^    / { value[n, $1] = $2 }
END {
    if (!n) exit 1
    print "== table"
    print "| scene | triangles | build, s | closest, any: Mray/s | pt, bdpt, asbdpt: us a path | gain of 2 threads |"
    print "|---|---:|---:|---:|---:|---:|"
    for (i = 1; i <= n; i++)
        printf "| %s | %d | %.2g | %.1f, %.1f | %.2f, %.2f, %.2f | %.2f |\n", name[i], value[i, "triangles"],
            value[i, "build_s"], value[i, "closest"], value[i, "any"], value[i, "pt_us"], value[i, "bdpt_us"],
            value[i, "asbdpt_us"], value[i, "gain"]
}
