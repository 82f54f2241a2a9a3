/* race_table.c: see race_table.h. */
#include "lab/race_table.h"

#include <string.h>

struct race_result race_result(const struct prepared *p)
{
    struct race_result r = {.n = p->n_runners, .winner = p->winner};
    memcpy(r.runner, p->runner, sizeof r.runner);
    return r;
}

/* "quarter" of "race_quarter". */
static const char *name(const struct runner *k) { return strchr(k->name, '_') + 1; }

/* Variance times price, over the winner's. */
static double relative_cost(const struct race_result *r, const struct runner *k)
{
    const struct runner *winner = &r->runner[r->winner];
    return k->variance * k->price / (winner->variance * winner->price);
}

void race_print_winner(FILE *f, const struct race_result *r)
{
    const char *before = "\n  That of the others, over its own:";
    if (r->n == 0 || !(r->runner[r->winner].price > 0))
        return;
    fprintf(f, "RACE: the runner %s renders, because it has the least predicted variance times price.",
            name(&r->runner[r->winner]));
    for (int i = 0; i < r->n; i++)
        if (i != r->winner) {
            fprintf(f, "%s %s %.3g", before, name(&r->runner[i]), relative_cost(r, &r->runner[i]));
            before = ",";
        }
    fputs("\n", f);
}

void race_print_table(FILE *f, const struct race_result *r)
{
    fprintf(f, "race          %d runners\n", r->n);
    if (r->n > 0)
        fprintf(f, "  %-14s %8s %6s %6s %12s %10s %8s %8s\n", "runner", "at first", "later", "points", "pixels each",
                "variance", "price", "product");
    for (int i = 0; i < r->n; i++) {
        const struct runner *k = &r->runner[i];
        const struct numbers *n = &k->numbers;
        fprintf(f, "  %-14s %8d %6d %6d", name(k), n->path_pixels > 0 ? n->draws[FIRST_HIT] : 0,
                n->path_pixels > 0 ? n->draws[LATER_HIT] : 0, n->light_points);
        if (n->path_pixels > 0)
            fprintf(f, " %12d", n->path_pixels);
        else
            fprintf(f, " %12s", "no paths");
        if (relative_cost(r, k) >= 0)
            fprintf(f, " %10.4g %8.4g %8.3f", k->variance, k->price, relative_cost(r, k));
        else
            fprintf(f, " %10.4g %8.4g %8s", k->variance, k->price, "-"); /* no sample has met any light */
        fprintf(f, "%s\n", i == r->winner ? "  chosen" : "");
    }
    if (r->n > 0)
        fputs("  at first, later: light vertices for an eye vertex; points: light points at a first hit; pixels each:\n"
              "  for a light sub-path; variance: predicted, relative to brightness, of all samples of the race;\n"
              "  product: variance times price, over that of the chosen one\n",
              f);
}
