/* symbols.c: see symbols.h. */
#include "parser/symbols.h"

#include <ctype.h>
#include <stdio.h>
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

/* --- names that are none ------------------------------------------------------------------------------ */

static int least(int a, int b) { return a < b ? a : b; }

/* Letters to be changed, left out or put in where a, of n letters, is to become b, of m: row i of the table of all
 * beginnings of both is made of row i - 1. */
static int distance(const char *a, int n, const char *b, int m)
{
    int row[NEAR_LONGEST + 1];
    for (int j = 0; j <= m; j++)
        row[j] = j;
    for (int i = 1; i <= n; i++) {
        int before = row[0]; /* of row i - 1, column j - 1 */
        row[0] = i;
        for (int j = 1; j <= m; j++) {
            int changed = before + (tolower((unsigned char)a[i - 1]) != tolower((unsigned char)b[j - 1]));
            before = row[j];
            row[j] = least(changed, 1 + least(row[j], row[j - 1]));
        }
    }
    return row[m];
}

struct near near_start(const char *wanted)
{
    size_t n = strlen(wanted);
    return (struct near){wanted, NULL, n < 3 ? 0 : n < 6 ? 1 : 2, ""};
}

void near_try(struct near *near, const char *name)
{
    size_t n = strlen(near->wanted), m = strlen(name);
    if (n > NEAR_LONGEST || m > NEAR_LONGEST || abs((int)n - (int)m) > near->most)
        return;
    int d = distance(near->wanted, (int)n, name, (int)m);
    if (d > near->most)
        return;
    near->most = d - 1;
    near->name = name;
    snprintf(near->text, sizeof near->text, "; did you mean \"%s\"?", name);
}
