# frame.awk: what all pages have in common, for html.awk and source.awk.
function escape(s) { gsub(/&/, "\\&amp;", s); gsub(/</, "\\&lt;", s); gsub(/>/, "\\&gt;", s); return s }

# How a page begins. root: the way from it to the top of the HTML tree; class: that of its body, or "".
function frame(title, root, class) {
    return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n" \
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"><title>" title "</title>\n" \
        "<link rel=\"stylesheet\" href=\"" root "/style.css\"></head><body" (class != "" ? " class=\"" class "\"" : "") ">\n" \
        "<nav><a href=\"" root "/index.html\">asbdpt</a> <a href=\"" root "/doc/tour/README.html\">tour</a> " \
        "<a href=\"" root "/README.html#reading-the-source\">source</a> " \
        "<a href=\"" root "/doc/course/README.html\">course</a> <a href=\"" root "/doc/tour/glossary.html\">glossary</a> " \
        "<a href=\"" root "/doc/README.html\">all pages</a></nav>"
}

function is_keyword(name) {
    return index(" bool break case char const continue default do double else enum extern float for if inline int long" \
        " return short sizeof static struct switch typedef union unsigned void while ", " " name " ")
}
