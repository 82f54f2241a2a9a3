/* suggest.h: the nearest known name to one that is not known, for "did you mean".
 *
 * Distance: the fewest insertions, deletions, substitutions and swaps of neighbours, each counted once and
 * letter case ignored [Damerau 1964, "optimal string alignment"].
 *
 * Used by: params, parser.
 */
#ifndef ASBDPT_SUGGEST_H
#define ASBDPT_SUGGEST_H

/* The best candidate so far. Start with suggest_start, offer every known name, then read `name`. */
struct suggestion {
    const char *wanted; /* what the user wrote */
    const char *name;   /* nearest name offered so far; NULL: none is near */
    int distance;       /* its distance; before the first near one: one more than may be called near */
};

/* suggest_start: a name of n letters may be off by about a third of them. */
struct suggestion suggest_start(const char *wanted);

/* suggest_offer: consider one known name; the string must outlive the suggestion. */
void suggest_offer(struct suggestion *s, const char *known);

/* suggest_from: the nearest of a NULL-terminated list, or NULL. */
const char *suggest_from(const char *wanted, const char *const *known);

#endif
