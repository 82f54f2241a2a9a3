# unknown.awk: section unknown of doc/measured from family.md or equal-time.md: lines "SCENE METHOD MEASURE
# [FOLDER, of several]" of squared errors that have no number: the noise of the reference is unknown or larger, or
# there is no time for a sample.
FNR == 1 { n = split(FILENAME, folder, "/"); part = folder[n - 1] }
/^(mse8|relmse|8x8): squared/ { measure = $1; sub(/:/, "", measure) }
/^\| method \|/ { n = split($0, scene, / *\| */); for (i in scene) sub(/,.*/, "", scene[i]) }
/^\| method \| price/ { measure = "" } # a table of all scenes
/^\| [a-z]/ && measure != "" {
    split($0, cell, / *\| */)
    for (i = 3; i < n; i++) if (cell[i] == "-" && scene[i] != "") {
        if (!found++) print "== unknown"
        print scene[i], cell[2], measure (ARGC > 2 ? " " part : "")
    }
}
