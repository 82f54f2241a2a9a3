/* csv.c: see csv.h. */
#include "lab/csv.h"

#include <stdbool.h>
#include <string.h>

void csv_text(FILE *f, const char *text)
{
    bool quoted = strpbrk(text, ",\"\r\n") != NULL;
    fputs(quoted ? "\"" : "", f);
    for (; *text != '\0'; text++)
        fputs(*text == '"' ? "\"\"" : (const char[]){*text, '\0'}, f);
    fputs(quoted ? "\"" : "", f);
}
