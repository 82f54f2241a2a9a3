/* race_table.c: see race_table.h. */
#include "lab/race_table.h"

#include <string.h>

#include "integrators/race.h"

struct race_result race_result(const struct prepared *p)
{
    struct race_result r = {.winner = p->winner};
    memcpy(r.runner, p->runner, sizeof r.runner);
    return r;
}

/* Variance times price, over the winner's. */
static double relative_cost(const struct race_result *r, const struct runner *k)
{
    const struct runner *winner = &r->runner[r->winner];
    return k->variance * k->price / (winner->variance * winner->price);
}

/* "light sub-paths in one of 32 iterations", "a light sub-path for 4 pixels". */
static void print_light(FILE *f, const struct numbers *n)
{
    int every = numbers_every(n);
    if (n->path_pixels == 0)
        fputs("no light sub-paths", f);
    else if (every > 1)
        fprintf(f, "light sub-paths in one of %d iterations", every);
    else if (n->path_pixels > 1)
        fprintf(f, "a light sub-path for %d pixels", n->path_pixels);
    else
        fputs("a light sub-path for each pixel", f);
}

void race_print_winner(FILE *f, const struct race_result *r)
{
    const struct runner *winner = &r->runner[r->winner];
    const char *before = " Variance times price of the others, over its own:\n ";
    if (!(winner->price > 0))
        return;
    fprintf(f, "RACE: the runner %s renders: ", runner_name(r->winner));
    print_light(f, &winner->numbers);
    fputs(".", f);
    for (int i = 0; i < RUNNERS; i++)
        if (i != r->winner && !race_blind(&r->runner[i])) {
            fprintf(f, "%s %s %.3g", before, runner_name(i), relative_cost(r, &r->runner[i]));
            before = ",";
        }
    fputs("\n", f);
}

void race_print_table(FILE *f, const struct race_result *r)
{
    if (!(r->runner[r->winner].price > 0)) {
        fputs("race          none\n", f);
        return;
    }
    fprintf(f, "race          %d runners\n  %-14s %8s %6s %6s %10s %8s %8s  light\n", RUNNERS, "runner", "at first",
            "later", "points", "variance", "price", "product");
    for (int i = 0; i < RUNNERS; i++) {
        const struct runner *k = &r->runner[i];
        const struct numbers *n = &k->numbers;
        double later = (double)n->draws[LATER_HIT] / numbers_every(n);
        fprintf(f, "  %-14s %8.3g %6.2g %6d", runner_name(i), (double)n->draws[FIRST_HIT] / numbers_every(n), later,
                n->light_points);
        if (race_blind(k))
            fprintf(f, " %10s %8.4g %8s", "-", k->price, "-");
        else
            fprintf(f, " %10.4g %8.4g %8.3f", k->variance, k->price, relative_cost(r, k));
        fputs("  ", f);
        print_light(f, n);
        fprintf(f, "%s\n", i == r->winner ? "; chosen" : "");
    }
    fputs("  at first, later: light vertices for an eye vertex, in the mean over iterations; points: light points at a\n"
          "  first hit; variance: of a sample, relative to brightness; product: variance times price, over that of\n"
          "  the chosen one; -: it met next to no light\n",
          f);
}
