/* near.h: lists of names, ended by NULL, and which of several names was probably meant by one that is none of them.
 *
 * It is the name into which the unknown one turns by the fewest letters that are changed, left out or put in, case
 * apart (Levenshtein's distance). A name of three letters may differ by one, one of six by two. Names longer than
 * NEAR_LONGEST are not compared, nor read to their end, so that the time for each pair is bounded.
 * Tests: test_parser.c, test_options.c. */
#ifndef ASBDPT_NEAR_H
#define ASBDPT_NEAR_H

/* names_find: the number of a name in a list, or -1. names_list: the whole of it in `text`, which is returned:
 * "a", "b" or "c", with the quotation marks. */
enum { NAMES_TEXT = 256 };
int names_find(const char *const *names, const char *name);
const char *names_list(const char *const *names, char text[NAMES_TEXT]);

enum { NEAR_LONGEST = 32, NEAR_TEXT = NEAR_LONGEST + 32 };

struct near {
    const char *wanted, *name; /* the nearest so far, or NULL; borrowed */
    int length;                /* of `wanted`; it matters up to NEAR_LONGEST */
    int most;                  /* letters by which a nearer one differs */
    char text[NEAR_TEXT];      /* "; did you mean "NAME"?", or "" */
};

/* near_start: nothing is compared yet. near_try: one of the names that there are; NULL: none. Of equally near names the
 * first counts. near_of: the text, after all names of a list that NULL ends. */
struct near near_start(const char *wanted);
void near_try(struct near *n, const char *name);
struct near near_of(const char *wanted, const char *const *names);

#endif
