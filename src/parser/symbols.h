/* names.h: a table from names to numbers, with scopes: what was added after a mark can be forgotten again.
 *
 * AttributeEnd forgets the textures and materials named since its AttributeBegin. A later name hides an earlier
 * equal one. Hash chains are kept newest first, so that forgetting is popping.
 *
 * Used by: parse_*, parser.
 */
#ifndef ASBDPT_NAMES_H
#define ASBDPT_NAMES_H

#include <stddef.h>

enum { NAME_CHAINS = 1024 };

struct name_entry {
    char *name; /* owned */
    int value;
    int older; /* next entry of the chain, -1 at its end */
};

struct names {
    struct name_entry *entry; /* [n], in the order they were added, owned */
    int n;
    size_t capacity;
    int newest[NAME_CHAINS]; /* first entry of each chain plus 1; 0: empty. So all zeros is an empty table. */
};

void names_add(struct names *t, const char *name, int value);

/* names_find: the value of the newest entry of this name, or -1. Values must not be negative. */
int names_find(const struct names *t, const char *name);

/* names_forget: remove all entries but the first n. */
void names_forget(struct names *t, int n);

/* names_near: the known name nearest to an unknown one, or NULL. */
const char *names_near(const struct names *t, const char *name);
void names_free(struct names *t);

#endif
