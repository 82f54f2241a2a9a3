/* claims.c: see claims.h. */
#include "lab/claims.h"

#include <math.h>

#include "lab/table.h"

static const struct claim CLAIMS[] = {
    {.method = "cbdpt", .over = "bdpt", .below = 0.1,
     .text = "over ten times faster than BDPT, on CPU and GPU [Pajot 2011]"},
    {.method = "lvc:connections=0", .over = "bdpt", .below = 1 / 1.3,
     .text = "30 to 60 % faster than other BDPT, on a GPU [Davidovic 2014]"},
    {.method = "mbdpt", .over = "bdpt", .below = 0.5, .lacks = "how it sorts could not be read",
     .text = "2 to 3 times faster in complex scenes [Chaitanya 2018]"},
    {.method = "mbdpt:key=throughput", .over = "bdpt", .below = 0.5, .lacks = "as above",
     .text = "the same, sorted by what pairs bring [Chaitanya 2018]"},
    {.method = "ris", .over = "pcbdpt", .below = 1, .alone = true, .lacks = "ours has not the bound",
     .text = "better than probabilistic connections [Nabata 2020a]"},
    {.method = "ris", .over = "ris:weights=counts", .below = 1, .at = AT_EQUAL_SAMPLES, .alone = true,
     .text = "its weights are better than plain ones for the same draws [Nabata 2020a]"},
    {.method = "ris2", .over = "ris", .below = 1, .alone = true,
     .text = "two stages are better than one [Nabata 2020b]"},
    {.method = "restir", .over = "bdpt", .below = 1, .where = "many-lights",
     .text = "much faster in direct light of very many lamps [Bitterli 2020]"},
    {.method = "restirgi", .over = "pt", .below = 1 / 9.0, .at = AT_EQUAL_SAMPLES,
     .text = "squared error of path tracing over 9 to 166, per frame [Ouyang 2021]"},
    {.method = "pathgraph", .over = "pt", .below = 1, .at = AT_EQUAL_SAMPLES,
     .lacks = "of the paper, the abstract was read",
     .text = "better than path tracing of the same paths [Deng 2021]"},
    {.method = "asbdpt:select=bins", .over = "bdpt", .below = 1, .where = "veach-ajar",
     .lacks = "claimed at equal samples, both without roulette: dissertation.md",
     .text = "less error than BDPT in Ajar [Silva 2024]"},
    {.method = "mlt", .over = "pssmlt", .below = 1, .where = "veach-ajar",
     .text = "a door ajar: less error than PSSMLT [Hachisuka 2014]"},
    {.method = "mmlt", .over = "pssmlt", .below = 1, .where = "veach-ajar",
     .text = "a door ajar: less error than PSSMLT [Hachisuka 2014]"},
    {.method = "mmlt", .over = "mlt", .below = 1, .where = "veach-ajar",
     .text = "a door ajar: no more error than MLT [Hachisuka 2014]"},
    {.method = "asbdpt:select=subspaces", .over = "bdpt", .below = 1, .text = "better than BDPT; this tree's"},
    {.method = "asbdpt:select=subspaces", .over = "lvc", .below = 1, .text = "better than LVC; this tree's"},
    {.method = "asbdpt:select=subspaces:connections=1:pathpixels=1", .over = "lvc", .below = 1, .alone = true,
     .text = "better than LVC with as many draws and light sub-paths; this tree's"},
    {.method = "asbdpt:select=subspaces", .over = "lvc:connections=0", .below = 1,
     .text = "better than LVC as in its paper; this tree's"},
    {.method = "asbdpt:select=subspaces", .over = "cbdpt:connections=1", .below = 1,
     .text = "better than BDPT with services; this tree's"},
    {.method = "asbdpt:select=subspaces", .over = "pcbdpt", .below = 1, .lacks = "that one has not its bound",
     .text = "better than PCBDPT; this tree's"},
    {.method = "asbdpt:select=subspaces", .over = "ris", .below = 1, .alone = true,
     .text = "better than RIS; this tree's"},
};

enum verdict_of claim_judge(const struct results *r, const struct claim *c, enum half half,
                            struct interval ratio[N_SQUARES], int *n)
{
    enum half in = c->alone ? HALF_CHOICE : half;
    int method = methods_find_half(&r->plan->methods, c->method, in);
    int over = methods_find_half(&r->plan->methods, c->over, in);
    bool below = true, above = false;
    *n = 0;
    for (int k = 0; method >= 0 && over >= 0 && k < N_SQUARES; k++) {
        ratio[k] = equal_bootstrap(r, method, over, (enum square)k, c->at, c->where, n);
        below = below && ratio[k].high < c->below;
        above = above || ratio[k].low > c->below;
    }
    if (*n == 0)
        return CLAIM_UNMEASURED;
    return c->lacks != NULL ? CLAIM_NOT_JUDGED : below ? CLAIM_FOUND : above ? CLAIM_NOT_FOUND : CLAIM_OPEN;
}

void claims_table(FILE *f, const struct results *r, enum half half)
{
    static const char *const verdicts[] = {"**found**", "**not found**", "cannot tell", "not judged: "};
    struct table t;
    table_begin(&t, "Claims: squared error over that of another method after the same CPU time, or the same samples, "
                    "geometric mean over scenes with its 95 %% interval; found if below the number claimed by all "
                    "three, not found if above by one");
    table_column(&t, "claim");
    table_column(&t, "criterion");
    for (int k = 0; k < N_SQUARES; k++)
        table_column(&t, "%s", EQUAL_NAMES[k]);
    table_column(&t, "scenes");
    table_column(&t, "verdict");
    for (size_t i = 0; i < sizeof CLAIMS / sizeof CLAIMS[0]; i++) {
        const struct claim *c = &CLAIMS[i];
        struct interval ratio[N_SQUARES];
        int n;
        enum verdict_of v = claim_judge(r, c, half, ratio, &n);
        if (v == CLAIM_UNMEASURED)
            continue;
        table_add(&t, NAN, "%s: %s", method_short(c->method), c->text);
        table_add(&t, c->below, "%s / %s < %.2g%s%s", method_short(c->method), method_short(c->over), c->below,
                  c->at == AT_EQUAL_SAMPLES ? ", equal samples" : "", c->alone ? ", the choice alone" : "");
        for (int k = 0; k < N_SQUARES; k++)
            table_add_interval(&t, ratio[k]);
        table_add(&t, n, "%d%s%s", n, c->where != NULL ? ", " : "", c->where != NULL ? c->where : "");
        table_add(&t, v, "%s%s", verdicts[v], c->lacks != NULL ? c->lacks : "");
    }
    table_markdown(f, &t);
    table_free(&t);
}
