# sources.awk: the comments and strings of C files, from what pieces.awk prints, as pages.awk prints pages. All are of
# the kind "source"; code in backquotes and names of files become one word.
BEGIN { FS = OFS = "\t" }
$3 == "code" { included = $4 ~ /^#include/; next }
$3 == "string" && (included || $4 ~ /^'/) { next }
{
    gsub(/`[^`]*`|[a-z_0-9-]+\.(c|h|sh|awk|md|pbrt)/, "CODE", $4)
    $3 = "source"
    print
}
