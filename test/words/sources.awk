# sources.awk: the comments and strings of C files, as pages.awk does it for pages. All are of the kind "source"; code
# in backquotes and names of files become one word.
FNR == 1 { comment = 0 }
{
    gsub(/'\\?.'/, "0")
    line = $0
    text = ""
    while (line != "") {
        if (comment) {
            end = index(line, "*/")
            text = text " " (end ? substr(line, 1, end - 1) : line)
            line = end ? substr(line, end + 2) : ""
            comment = !end
        } else if (match(line, /\/\*|"([^"\\]|\\.)*"/)) {
            comment = substr(line, RSTART, 1) == "/"
            if (!comment && $0 !~ /^#include/) text = text " " substr(line, RSTART, RLENGTH)
            line = substr(line, RSTART + RLENGTH)
        } else line = ""
    }
    gsub(/`[^`]*`|[a-z_0-9-]+\.(c|h|sh|awk|md|pbrt)/, "CODE", text)
    gsub(/\t/, " ", text)
    print FILENAME "\t" FNR "\tsource\t" text
}
