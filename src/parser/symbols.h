/* symbols.h: the names of a scene file: a table from names to numbers with scopes.
 *
 * AttributeEnd forgets the textures and materials named since its AttributeBegin: what was added after a mark can be
 * forgotten again. A later name hides an earlier equal one. Hash chains are kept newest first, so that forgetting is
 * popping.
 * Tests: test_parser.c. */
#ifndef ASBDPT_SYMBOLS_H
#define ASBDPT_SYMBOLS_H

#include <stddef.h>
#include <stdint.h>

/* One name. */
struct symbol {
    char *name; /* owned */
    int value;
    int older; /* next entry of the chain, -1 at its end */
};

enum { SYMBOL_CHAINS = 1 << 16 }; /* of a million names each has some 16 */

struct symbols {
    struct symbol *entry; /* [n], in the order they were added, owned */
    int n;
    int newest[SYMBOL_CHAINS]; /* first entry of each chain plus 1; 0: empty. All zeros is an empty table. */
};

/* symbols_add: append a name, which is copied, with its value, >= 0. symbols_find: the value of the newest entry of
 * this name, or -1. symbols_forget: remove all entries but the first n. */
void symbols_add(struct symbols *t, const char *name, int value);
int symbols_find(const struct symbols *t, const char *name);
void symbols_forget(struct symbols *t, int n);
void symbols_free(struct symbols *t);

#endif
