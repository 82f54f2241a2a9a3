# family.awk: sections of doc/measured from family.md of `asbdpt-lab family`. Of each half, choice and services:
# HALF, the table of means; HALF-rmse8, HALF-relmse, HALF-8x8, of all scenes; HALF-claims. bring: what services bring.
function begin(name) { section = name; open = 0 }
/^## The choice alone/ { half = "choice" }
/^## With all services/ { half = "services" }
/^Squared error over that of/ { begin(half) }
/^(rmse8|relmse|8x8): squared error over/ { measure = $1; sub(/:/, "", measure); begin(half "-" measure) }
/^Claims:/ { begin(half "-claims") }
/^What services bring/ { begin("bring") }
/^\|/ && section != "" {
    if (!open++) print "== " section
    print
    n++
}
END { exit !n }
