/* parse.c: choosing a kind by its name. See parse.h. */
#include "parser/parse.h"

#include <string.h>

#include "parser/suggest.h"

/* "a, b, c" of a NULL-terminated list, cut at the buffer's end. */
static void join(const char *const *names, char *buffer, size_t size)
{
    buffer[0] = '\0';
    for (int i = 0; names[i] != NULL; i++) {
        if (i > 0)
            strncat(buffer, ", ", size - strlen(buffer) - 1);
        strncat(buffer, names[i], size - strlen(buffer) - 1);
    }
}

int parse_name(struct parser *p, const char *const *known, const char *const *refused)
{
    struct params *q = &p->params;
    char list[256];
    for (int i = 0; known[i] != NULL; i++)
        if (strcmp(known[i], q->type) == 0)
            return i;
    join(known, list, sizeof list);
    for (int i = 0; refused[i] != NULL; i++)
        if (strcmp(refused[i], q->type) == 0) {
            params_fail(q, q->place, "%s \"%s\" of pbrt-v3 is not supported; use one of %s", q->directive, q->type,
                        list);
            return -1;
        }
    const char *near = suggest_from(q->type, known);
    if (near != NULL)
        params_fail(q, q->place, "unknown %s \"%.40s\"; did you mean \"%s\"?", q->directive, q->type, near);
    else
        params_fail(q, q->place, "unknown %s \"%.40s\"; use one of %s", q->directive, q->type, list);
    return -1;
}
