/* claims.c: see claims.h. */
#include "lab/claims.h"

#include <math.h>

#include "lab/equal.h"
#include "lab/table.h"

static const struct claim CLAIMS[] = {
    {"cbdpt", "bdpt", 0.1, NULL, "over ten times faster than BDPT, on CPU and GPU [Pajot 2011]"},
    {"lvc:connections=0", "bdpt", 1 / 1.3, NULL, "30 to 60 % faster than other BDPT, on a GPU [Davidovic 2014]"},
    {"mbdpt", "bdpt", 0.5, NULL, "2 to 3 times faster in complex scenes [Chaitanya 2018]"},
    {"mbdpt:key=throughput", "bdpt", 0.5, NULL, "the same, sorted by what pairs bring [Chaitanya 2018]"},
    {"ris", "pcbdpt", 1, NULL, "better than probabilistic connections, of which ours lacks the bound [Nabata 2020a]"},
    {"ris", "ris:weights=counts", 1, NULL, "its weights are better than plain ones for the same draws [Nabata 2020a]"},
    {"ris2", "ris", 1, NULL, "two stages are better than one [Nabata 2020b]"},
    {"restir", "bdpt", 1, NULL, "much faster in direct light of very many lamps [Bitterli 2020]"},
    {"restirgi", "pt", 1 / 9.0, NULL, "squared error of path tracing over 9 to 166, per frame [Ouyang 2021]"},
    {"pathgraph", "pt", 1, NULL, "better than path tracing of the same paths [Deng 2021]"},
    {"asbdpt:select=bins", "bdpt", 1, "veach-ajar", "less error than BDPT in Ajar [Silva 2024]"},
    {"mlt", "pssmlt", 1, "veach-ajar", "a door ajar: less error than PSSMLT [Hachisuka 2014]"},
    {"mmlt", "pssmlt", 1, "veach-ajar", "a door ajar: less error than PSSMLT [Hachisuka 2014]"},
    {"mmlt", "mlt", 1, "veach-ajar", "a door ajar: no more error than MLT [Hachisuka 2014]"},
    {"asbdpt:select=subspaces", "bdpt", 1, NULL, "better than BDPT; this tree's"},
    {"asbdpt:select=subspaces", "lvc", 1, NULL, "better than LVC; this tree's"},
    {"asbdpt:select=subspaces", "lvc:connections=0", 1, NULL, "better than LVC as in its paper; this tree's"},
    {"asbdpt:select=subspaces", "cbdpt:connections=1", 1, NULL, "better than BDPT with services; this tree's"},
    {"asbdpt:select=subspaces", "pcbdpt", 1, NULL, "better than PCBDPT, of which ours lacks the bound; this tree's"},
    {"asbdpt:select=subspaces", "ris", 1, NULL, "better than RIS; this tree's"},
};

enum verdict_of claim_judge(const struct results *r, const struct claim *c, enum half half,
                            struct interval ratio[N_SQUARES], int *n)
{
    int method = methods_find_half(&r->plan->methods, c->method, half);
    int over = methods_find_half(&r->plan->methods, c->over, half);
    bool below = true, above = false;
    *n = 0;
    for (int k = 0; method >= 0 && over >= 0 && k < N_SQUARES; k++) {
        ratio[k] = equal_bootstrap(r, method, over, (enum square)k, c->where, n);
        below = below && ratio[k].high < c->below;
        above = above || ratio[k].low > c->below;
    }
    return *n == 0 ? CLAIM_UNMEASURED : below ? CLAIM_FOUND : above ? CLAIM_NOT_FOUND : CLAIM_OPEN;
}

void claims_table(FILE *f, const struct results *r, enum half half)
{
    static const char *const verdicts[] = {"**found**", "**not found**", "cannot tell"};
    struct table t;
    table_begin(&t, "Claims: squared error over that of another method after the same CPU time, geometric mean over "
                    "scenes with its 95 %% interval; found if below the number claimed by all three, not found if "
                    "above by one");
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
        table_add(&t, c->below, "%s / %s < %.2g", method_short(c->method), method_short(c->over), c->below);
        for (int k = 0; k < N_SQUARES; k++)
            table_add_interval(&t, ratio[k]);
        table_add(&t, n, "%d%s%s", n, c->where != NULL ? ", " : "", c->where != NULL ? c->where : "");
        table_add(&t, v, "%s", verdicts[v]);
    }
    table_markdown(f, &t);
    table_free(&t);
}
