/* markup.c: see markup.h. */
#include "lab/markup.h"

#include <stdarg.h>
#include <string.h>

static void xml_text(FILE *f, const char *text)
{
    for (; *text != '\0'; text++)
        switch (*text) {
        case '&': fputs("&amp;", f); break;
        case '<': fputs("&lt;", f); break;
        case '>': fputs("&gt;", f); break;
        case '"': fputs("&quot;", f); break;
        default: fputc(*text, f); /* any other character stands for itself */
        }
}

void xml_print(FILE *f, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    for (const char *p = format; *p != '\0'; p++) {
        char one[32];
        size_t n = *p == '%' ? strcspn(p, "dfgs") + 1 : 0;
        snprintf(one, sizeof one, "%.*s", (int)n, p);
        if (n == 0)
            fputc(*p, f);
        else if (p[n - 1] == 's')
            xml_text(f, va_arg(args, const char *));
        else if (p[n - 1] != 'd')
            fprintf(f, one, va_arg(args, double));
        else if (p[n - 2] == 'l')
            fprintf(f, one, va_arg(args, long));
        else
            fprintf(f, one, va_arg(args, int));
        p += n > 0 ? n - 1 : 0;
    }
    va_end(args);
}
