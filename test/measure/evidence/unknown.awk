# unknown.awk: section unknown of doc/measured from family.md or equal-time.md: lines "SCENE METHOD MEASURE" of squared
# errors that have no number, since the noise of their reference is unknown or larger.
/^(mse8|relmse|8x8): squared/ { measure = $1; sub(/:/, "", measure) }
/^\| method \|/ { n = split($0, scene, / *\| */); for (i in scene) sub(/,.*/, "", scene[i]) }
/^\| method \| price/ { measure = "" } # a table of all scenes
/^\| [a-z]/ && measure != "" {
    split($0, cell, / *\| */)
    for (i = 3; i < n; i++) if (cell[i] == "-" && scene[i] != "") {
        if (!found++) print "== unknown"
        print scene[i], cell[2], measure
    }
}
