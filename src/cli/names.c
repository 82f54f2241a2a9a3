/* names.c: see names.h. */
#include "cli/names.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"

struct name {
    char *label;      /* for messages: who gives it, and as what; owned */
    const char *path; /* the end of that */
    enum option_file use;
};

/* Standard input and standard output share the name -. */
static bool clash(const struct name *a, const struct name *b)
{
    if (strcmp(a->path, b->path) != 0)
        return false;
    return strcmp(a->path, "-") == 0 ? (a->use == FILE_READ) == (b->use == FILE_READ)
                                     : a->use != b->use || a->use == FILE_WRITTEN;
}

bool names_add(struct names *all, enum option_file use, const char *what, const char *path, struct error *err)
{
    size_t size = strlen(what) + strlen(path) + 2;
    struct name n = {.label = mem_alloc(size, 1), .use = use};
    snprintf(n.label, size, "%s %s", what, path);
    n.path = n.label + strlen(what) + 1;
    all->item = mem_append(all->item, (size_t)all->n, sizeof *all->item);
    all->item[all->n++] = n;
    for (int i = 0; i < all->n - 1; i++)
        if (clash(&all->item[i], &n))
            return error_usage(err, "%s and %s are the same file", all->item[i].label, n.label);
    return true;
}

bool names_add_options(struct names *all, const struct option *table, void *target, struct error *err)
{
    bool ok = true;
    for (const struct option *o = table; ok && o != NULL; o = options_next(o)) {
        int n = 0;
        const char *const *text = o->file != FILE_NONE ? options_texts(o, target, &n) : NULL;
        for (int i = 0; ok && i < n; i++)
            ok = names_add(all, o->file, o->name, text[i], err);
    }
    return ok;
}

void names_free(struct names *all)
{
    for (int i = 0; i < all->n; i++)
        free(all->item[i].label);
    free(all->item);
    memset(all, 0, sizeof *all);
}
