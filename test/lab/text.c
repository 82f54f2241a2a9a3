/* text.c: see text.h. */
#include "lab/text.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

bool text_add(char *text, size_t size, const char *format, ...)
{
    size_t n = strlen(text);
    va_list args;
    va_start(args, format);
    int wanted = vsnprintf(text + n, size - n, format, args);
    va_end(args);
    return wanted >= 0 && (size_t)wanted < size - n;
}
