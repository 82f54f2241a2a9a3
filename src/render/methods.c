/* methods.c: the table of all methods; see methods.h. A new method is a new line here. */
#include "render/methods.h"

#include <string.h>

extern const struct method method_pt, method_lt, method_bdpt, method_bins, method_pool, method_vertices,
    method_subspaces, method_lvc, method_cbdpt, method_mbdpt, method_pcbdpt, method_ris, method_ris2,
    method_restir, method_pssmlt, method_mmlt, method_mlt;

static const struct method *const METHODS[] = {&method_pt,       &method_lt,   &method_bdpt,
                                               &method_subspaces, &method_bins, &method_pool,
                                               &method_vertices, &method_lvc,  &method_cbdpt,
                                               &method_mbdpt,    &method_pcbdpt, &method_ris,
                                               &method_ris2,     &method_restir, &method_pssmlt,
                                               &method_mmlt,     &method_mlt,    NULL};

const struct method *const *method_list(void) { return METHODS; }

/* The rows of a name, which stand side by side: the first, and how many. */
static const struct method *const *rows_of(const char *name, int *n)
{
    const struct method *const *first = METHODS;
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
