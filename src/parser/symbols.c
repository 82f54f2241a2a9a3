/* symbols.c: see symbols.h. */
#include "parser/symbols.h"

#include <stdlib.h>
#include <string.h>

#include "base/bits.h"
#include "base/mem.h"

/* The chain a name is in. */
static uint64_t chain(const char *name) { return hash_content(name, strlen(name)) % SYMBOL_CHAINS; }

void symbols_add(struct symbols *t, const char *name, int value)
{
    int *newest = &t->newest[chain(name)];
    struct symbol e = {mem_copy_text(name), value, *newest - 1};
    t->entry = mem_append(t->entry, (size_t)t->n, sizeof *t->entry);
    t->entry[t->n++] = e;
    *newest = t->n;
}

int symbols_find(const struct symbols *t, const char *name)
{
    for (int i = t->newest[chain(name)] - 1; i >= 0; i = t->entry[i].older)
        if (strcmp(t->entry[i].name, name) == 0)
            return t->entry[i].value;
    return -1;
}

void symbols_forget(struct symbols *t, int n)
{
    while (t->n > n) {
        struct symbol *e = &t->entry[--t->n];
        t->newest[chain(e->name)] = e->older + 1;
        free(e->name);
    }
}

void symbols_free(struct symbols *t)
{
    symbols_forget(t, 0);
    free(t->entry);
    t->entry = NULL;
}
