# pieces.awk: C files as lines FILE <tab> LINE <tab> KIND <tab> TEXT, one for each piece of a line. A "comment" is
# without its marks, a "string" or a character with them; all else is "code".
function put(kind, text) { if (text != "") print FILENAME "\t" FNR "\t" kind "\t" text }
FNR == 1 { comment = 0 }
{
    gsub(/\t/, " ")
    while ($0 != "")
        if (comment) {
            end = index($0, "*/")
            put("comment", end ? substr($0, 1, end - 1) : $0)
            $0 = end ? substr($0, end + 2) : ""
            comment = !end
        } else if (match($0, /\/\*|"([^"\\]|\\.)*"|'([^'\\]|\\.)+'/)) {
            put("code", substr($0, 1, RSTART - 1))
            comment = substr($0, RSTART, 1) == "/"
            if (!comment) put("string", substr($0, RSTART, RLENGTH))
            $0 = substr($0, RSTART + RLENGTH)
        } else {
            put("code", $0)
            $0 = ""
        }
}
