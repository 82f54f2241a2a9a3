/* csv.c: see csv.h. */
#include "lab/csv.h"

#include <string.h>

void csv_text(FILE *f, const char *text)
{
    const char *quote = strpbrk(text, ",\"\r\n") != NULL ? "\"" : "";
    fputs(quote, f);
    for (; *text != '\0'; text++)
        fputs(*text == '"' ? "\"\"" : (const char[]){*text, '\0'}, f);
    fputs(quote, f);
}
