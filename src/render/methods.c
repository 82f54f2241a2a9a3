/* methods.c: see methods.h. */
#include "render/methods.h"

#include <string.h>

/* The rows of a name, which are neighbours: the first, and how many. */
static const struct method *const *rows_of(const char *name, int *n)
{
    const struct method *const *first = method_rows;
    name = strcmp(name, "path") == 0 ? "pt" : name;
    while (*first != NULL && strcmp((*first)->name, name) != 0)
        first++;
    for (*n = 0; first[*n] != NULL && strcmp(first[*n]->name, name) == 0;)
        ++*n;
    return first;
}

bool method_exists(const char *name)
{
    int n;
    rows_of(name, &n);
    return n > 0;
}

const struct method *method_find(const char *name, const struct settings *s, struct error *err)
{
    enum { MOST = 16 };
    const char *words[MOST + 1] = {NULL};
    int n, which = 0;
    const struct method *const *row = rows_of(name, &n);
    if (n == 0) {
        error_set(err, "there is no integrator \"%s\"", name);
        return NULL;
    }
    for (int i = 0; n > 1 && i < n && i < MOST; i++)
        words[i] = row[i]->select;
    return n == 1 || settings_choice(s, "select", 0, words, &which, err) ? row[which] : NULL;
}
