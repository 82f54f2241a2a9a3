/* error.c: see error.h. */
#include "base/error.h"

#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/mem.h"

bool error_write(struct error *err, bool usage, const char *format, ...)
{
    va_list args;
    if (err == NULL)
        return false;
    va_start(args, format);
    vsnprintf(err->text, sizeof err->text, format, args);
    va_end(args);
    err->usage = usage;
    error_clean(err->text);
    return false;
}

/* [RFC 3629 4]. A zero byte ends the text. */
int printable_length(const char *text)
{
    static const uint32_t LEAST[] = {0xa0, 0x800, 0x10000}; /* of 2, 3, 4 bytes; before U+00A0: control codes */
    const unsigned char *p = (const unsigned char *)text;
    if (p[0] < 0x80)
        return p[0] >= ' ' && p[0] < 0x7f;
    if (p[0] < 0xc2 || p[0] > 0xf4)
        return 0;
    int n = p[0] < 0xe0 ? 2 : p[0] < 0xf0 ? 3 : 4;
    uint32_t code = p[0] & (0xffu >> (n + 1));
    for (int i = 1; i < n; i++) {
        if ((p[i] & 0xc0) != 0x80)
            return 0;
        code = code << 6 | (p[i] & 0x3fu);
    }
    bool surrogate = code >= 0xd800 && code < 0xe000;
    return code >= LEAST[n - 2] && code <= 0x10ffff && !surrogate ? n : 0;
}

void error_clean(char *text)
{
    while (*text != '\0') {
        int n = printable_length(text);
        if (n == 0)
            *text = '?';
        text += n > 0 ? n : 1;
    }
}

void say_line(const char *format, ...)
{
    va_list args, again;
    va_start(args, format);
    va_copy(again, args);
    int length = vsnprintf(NULL, 0, format, args);
    size_t size = length > 0 ? (size_t)length + 1 : 1;
    char *text = mem_alloc(size, 1);
    vsnprintf(text, size, format, again);
    va_end(again);
    va_end(args);
    error_clean(text);
    fprintf(stderr, "%s\n", text);
    free(text);
}
