/* symbols.c: see symbols.h. */
#include "parser/symbols.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/bits.h"
#include "base/mem.h"

/* --- the nearest known name --------------------------------------------------------------------------- */

enum { LONGEST = 48 }; /* longer names are not compared */

static int smaller(int a, int b) { return a < b ? a : b; }
static int lower(const char *text, int i) { return tolower((unsigned char)text[i]); }

/* Three rows of the dynamic-programming table suffice: a swap looks two rows back. */
static int distance(const char *a, const char *b)
{
    int row[3][LONGEST + 1];
    int m = (int)strlen(a), n = (int)strlen(b);
    for (int j = 0; j <= n; j++)
        row[0][j] = j;
    for (int i = 1; i <= m; i++) {
        int *now = row[i % 3];
        const int *above = row[(i + 2) % 3], *above2 = row[(i + 1) % 3];
        now[0] = i;
        for (int j = 1; j <= n; j++) {
            int differ = lower(a, i - 1) != lower(b, j - 1);
            now[j] = smaller(smaller(above[j], now[j - 1]) + 1, above[j - 1] + differ);
            if (i > 1 && j > 1 && lower(a, i - 1) == lower(b, j - 2) && lower(a, i - 2) == lower(b, j - 1))
                now[j] = smaller(now[j], above2[j - 2] + 1);
        }
    }
    return row[m % 3][n];
}

struct suggestion suggest_start(const char *wanted)
{
    return (struct suggestion){wanted, NULL, (smaller((int)strlen(wanted), LONGEST) + 5) / 3};
}

void suggest_offer(struct suggestion *s, const char *known)
{
    size_t m = strlen(s->wanted), n = strlen(known);
    if (m > LONGEST || n > LONGEST || abs((int)m - (int)n) >= s->distance)
        return;
    int d = distance(s->wanted, known);
    if (d < s->distance && (size_t)d < n) {
        s->distance = d;
        s->name = known;
    }
}

const char *suggestion_text(const struct suggestion *s, char text[SUGGESTION_SIZE])
{
    text[0] = '\0';
    if (s->name != NULL)
        snprintf(text, SUGGESTION_SIZE, "; did you mean \"%s\"?", s->name);
    return text;
}

/* --- the table ---------------------------------------------------------------------------------------- */

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
