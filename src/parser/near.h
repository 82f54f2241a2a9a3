/* near.h: which of several names was probably meant by one that is none of them: the one that becomes it by the fewest
 * letters, case apart. A name of three letters may differ by one, one of six by two; longer ones than NEAR_LONGEST are
 * not compared, so that the time for each is bounded.
 * Tests: test_parser.c. */
#ifndef ASBDPT_NEAR_H
#define ASBDPT_NEAR_H

enum { NEAR_LONGEST = 32, NEAR_TEXT = NEAR_LONGEST + 32 };

struct near {
    const char *wanted, *name; /* the nearest so far, or NULL; borrowed */
    int most;                  /* letters by which a nearer one differs */
    char text[NEAR_TEXT];      /* "; did you mean "NAME"?", or "" */
};

/* near_start: nothing is compared yet. near_try: one of the names that there are. */
struct near near_start(const char *wanted);
void near_try(struct near *n, const char *name);

#endif
