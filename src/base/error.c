/* error.c: see error.h. */
#include "base/error.h"

#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>

bool error_set(struct error *err, const char *format, ...)
{
    if (err != NULL) {
        va_list args;
        va_start(args, format);
        vsnprintf(err->text, sizeof err->text, format, args);
        va_end(args);
        error_clean(err->text);
    }
    return false;
}

/* The bytes of the UTF-8 character of more than one byte that begins at p (RFC 3629); 0 if there is none, or if it is a
 * control character (U+0080 to U+009F). A zero byte ends the text. */
static int utf8_length(const unsigned char *p)
{
    static const uint32_t LEAST[] = {0xa0, 0x800, 0x10000}; /* of 2, 3, 4 bytes */
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
    for (unsigned char *p = (unsigned char *)text; *p != '\0';) {
        int n = *p >= ' ' && *p < 0x7f ? 1 : utf8_length(p);
        if (n == 0)
            *p = '?';
        p += n > 0 ? n : 1;
    }
}
