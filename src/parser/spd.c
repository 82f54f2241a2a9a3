/* spd.c: see spd.h. */
#include "parser/spd.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"

double *spd_numbers(struct messages *m, struct source_file *file, struct source_position *at, size_t *n)
{
    static const char OF_NUMBERS[] = "0123456789.+-eE";
    double *number = NULL;
    const char *line = file->text, *warned = NULL;
    int n_lines = 0;
    *at = (struct source_position){file, 1, 1};
    *n = 0;
    for (const char *c = line; c < file->end; c++) {
        char token[64], *end = token;
        size_t length = *c == 'e' || *c == 'E' ? 0 : strspn(c, OF_NUMBERS);
        struct source_position here = {file, n_lines + 1, (int)(c - line) + 1};
        snprintf(token, sizeof token, "%.*s", length < 63 ? (int)length : 63, c);
        double value = strtod(token, &end);
        if (end > token) {
            number = mem_append(number, *n, sizeof *number);
            number[(*n)++] = value;
            *at = here;
            c += length - 1;
        } else if (*c == '#') {
            c += strcspn(c, "\r\n") - 1;
        } else if (*c == '\n' || (*c == '\r' && c[1] != '\n')) {
            n_lines++;
            line = c + 1;
        } else if (strchr(" \t\r,;:", *c) == NULL && warned != line) {
            source_warn(m, here, "this text of a spectrum file is passed over, as in pbrt-v3: it should hold "
                        "pairs of numbers, wavelength in nm and value");
            warned = line;
        }
    }
    return number;
}
