/* symbols.h: the names of a scene file: a table from names to numbers with scopes, and the nearest known name to one
 * that is not known, for "did you mean".
 *
 * AttributeEnd forgets the textures and materials named since its AttributeBegin: what was added after a mark can be
 * forgotten again. A later name hides an earlier equal one. Hash chains are kept newest first, so that forgetting is
 * popping.
 * Tests: test_parser.c. */
#ifndef ASBDPT_SYMBOLS_H
#define ASBDPT_SYMBOLS_H

#include <stddef.h>
#include <stdint.h>

/* --- the nearest known name --------------------------------------------------------------------------- */

/* The best candidate so far, by the fewest insertions, deletions, substitutions and swaps of neighbours, each counted
 * once and letter case ignored ("optimal string alignment") [Damerau 1964]. Start with suggest_start, offer every known
 * name, then read `name`. */
struct suggestion {
    const char *wanted; /* what the user wrote */
    const char *name;   /* nearest name offered so far; NULL: none is near */
    int distance;       /* its distance; before the first near one: one more than may be called near */
};

/* suggest_start: a name of n letters may be off by about a third of them. Nothing is near "".
 * suggest_offer: consider one known name; the string must outlive the suggestion.
 * suggestion_text: the end of a sentence, "; did you mean "NAME"?", or nothing where no name is near. */
enum { SUGGESTION_SIZE = 128 };
struct suggestion suggest_start(const char *wanted);
void suggest_offer(struct suggestion *s, const char *known);
const char *suggestion_text(const struct suggestion *s, char text[SUGGESTION_SIZE]);

/* --- the table ---------------------------------------------------------------------------------------- */

/* One name. */
struct symbol {
    char *name; /* owned */
    int value;
    int older; /* next entry of the chain, -1 at its end */
};

enum { SYMBOL_CHAINS = 1 << 12 }; /* of a million names each has some 250 */

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
