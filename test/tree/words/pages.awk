# pages.awk: the text of Markdown pages as lines FILE <tab> LINE <tab> KIND <tab> TEXT for check.awk. KIND is "prose",
# which has sentences, "rest" (headings and tables) or "code"; a line without TEXT ends a paragraph. A piece of code
# within a sentence becomes one word. Measured tables, which evidence.sh fills in, are left out.
function put(kind, text) { print FILENAME "\t" FNR "\t" kind "\t" text }
FNR == 1 { fenced = code = measured = 0; before = "" }
/^<!-- measured:.*-->$/ { measured = 1 }
measured { measured = !/^<!-- end -->$/; next }
/^ *```/ { fenced = !fenced; put("code", ""); next }
{ code = /^    / && (code || before == ""); before = $0 }
fenced || code { put("code", $0); next }
{
    gsub(/<!--[^>]*-->/, "")
    gsub(/`[^`]*`/, "CODE")
    gsub(/!\[[^]]*\]\([^)]*\)/, "")
    gsub(/\]\([^)]*\)/, "")
    gsub(/\t/, " ")
}
/^ *$/ { put("prose", ""); next }
/^[#|]/ { put("rest", ""); put("rest", $0); put("rest", ""); next }
/^ *([-*]|[0-9]+\.) / { put("prose", ""); sub(/[-*]|[0-9]+\./, "") }
{ put("prose", $0) }
