# bench.awk: the table of doc/performance.md from what `asbdpt-lab bench --json` has written.
BEGIN { FS = "[\":, ]+" }
$2 == "threads" || $3 == "threads" { for (i = 1; i < NF; i++) if ($i == "threads") threads = $(i + 1) }
/"scene": / {
    name[++n] = $0
    sub(/.*"scene": "/, "", name[n]); sub(/\.pbrt".*/, "", name[n]); sub(/.*\//, "", name[n])
}
NF > 2 { value[n, $2] = $3 + 0 }
END {
    if (!n) exit 1
    print "== table"
    print "| scene | triangles | build, s | closest, any: Mray/s | pt, bdpt, asbdpt: us a path | gain of " threads \
        " threads |"
    print "|---|---:|---:|---:|---:|---:|"
    for (i = 1; i <= n; i++)
        printf "| %s | %d | %.2g | %.1f, %.1f | %.2f, %.2f, %.2f | %.2f |\n", name[i], value[i, "triangles"],
            value[i, "build_s"], value[i, "closest_incoherent"], value[i, "any_incoherent"], 1e6 / value[i, "pt_paths"],
            1e6 / value[i, "bdpt_paths"], 1e6 / value[i, "asbdpt_paths"],
            threads * value[i, "cpu_1"] / value[i, "cpu_n"]
}
