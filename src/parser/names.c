/* names.c: see names.h. */
#include "parser/names.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/bits.h"
#include "base/mem.h"
#include "parser/suggest.h"

/* Which chain a name is in. */
static uint32_t chain(const char *name)
{
    return hash_bytes(name, strlen(name)) % NAME_CHAINS;
}

void names_add(struct names *t, const char *name, int value)
{
    t->entry = mem_grow(t->entry, &t->capacity, (size_t)t->n + 1, sizeof *t->entry);
    int *newest = &t->newest[chain(name)];
    struct name_entry e = {mem_copy_text(name), value, *newest - 1};
    t->entry[t->n++] = e;
    *newest = t->n;
}

int names_find(const struct names *t, const char *name)
{
    for (int i = t->newest[chain(name)] - 1; i >= 0; i = t->entry[i].older)
        if (strcmp(t->entry[i].name, name) == 0)
            return t->entry[i].value;
    return -1;
}

void names_forget(struct names *t, int n)
{
    while (t->n > n) {
        struct name_entry *e = &t->entry[--t->n];
        t->newest[chain(e->name)] = e->older + 1;
        free(e->name);
    }
}

const char *names_near(const struct names *t, const char *name)
{
    struct suggestion s = suggest_start(name);
    for (int i = 0; i < t->n; i++)
        suggest_offer(&s, t->entry[i].name);
    return s.name;
}

void names_free(struct names *t)
{
    names_forget(t, 0);
    free(t->entry);
    memset(t, 0, sizeof *t);
}
