/* claims.c: see claims.h. */
#include "lab/claims.h"

#include "lab/text.h"

static const struct claim CLAIMS[] = {
    {.method = "cbdpt", .over = "bdpt", .below = 0.1, .lacks = "the paper's runs on CPU and GPU together",
     .text = "over ten times faster than BDPT, on CPU and GPU [Pajot 2011]"},
    {.method = "lvc:connections=0", .over = "bdpt", .below = 1 / 1.3,
     .lacks = "the paper's runs on a GPU", .text = "30 to 60 % faster than other BDPT, on a GPU [Davidovic 2014]"},
    {.method = "mbdpt", .over = "bdpt", .below = 0.5, .lacks = "how it sorts could not be read",
     .text = "2 to 3 times faster in complex scenes [Chaitanya 2018]"},
    {.method = "mbdpt:key=throughput", .over = "bdpt", .below = 0.5, .lacks = "as above",
     .text = "the same, sorted by what pairs contribute [Chaitanya 2018]"},
    {.method = "ris", .over = "pcbdpt", .below = 1, .alone = true,
     .lacks = "the bound of pcbdpt is known at second hand",
     .text = "better than probabilistic connections [Nabata 2020a]"},
    {.method = "ris", .over = "ris:weights=counts", .below = 1, .at = AT_EQUAL_SAMPLES, .alone = true,
     .text = "its weights are better than plain ones for the same draws [Nabata 2020a]"},
    {.method = "ris2", .over = "ris", .below = 1, .alone = true,
     .lacks = "the paper's has very many sub-paths, ours 256", .text = "two stages are better than one [Nabata 2020b]"},
    {.method = "spcbpt", .over = "ris", .below = 1, .alone = true,
     .lacks = "the paper's text could not be read",
     .text = "less noise than the state of the art [Su 2022]"},
    {.method = "restir", .over = "bdpt", .below = 1, .where = "many-lights",
     .lacks = "200 lights here, and no reuse over frames",
     .text = "much faster in direct light of very many lights [Bitterli 2020]"},
    {.method = "restirgi", .over = "pt", .below = 1 / 9.0, .at = AT_EQUAL_SAMPLES,
     .lacks = "the paper's reuses over frames",
     .text = "squared error of path tracing over 9 to 166, per frame [Ouyang 2021]"},
    {.method = "pathgraph", .over = "pt", .below = 1, .at = AT_EQUAL_SAMPLES,
     .lacks = "of the paper only the abstract was read",
     .text = "better than path tracing of the same paths [Deng 2021]"},
    {.method = "asbdpt:select=bins", .over = "bdpt", .below = 1, .where = "veach-ajar",
     .lacks = "claimed at equal samples, both without roulette: dissertation.md",
     .text = "less error than BDPT in Ajar [Silva 2024]"},
    {.method = "mlt", .over = "pssmlt", .below = 1, .where = "veach-ajar",
     .lacks = "the scene is a model of the paper's", .text = "a door ajar: less error than PSSMLT [Hachisuka 2014]"},
    {.method = "mmlt", .over = "pssmlt", .below = 1, .where = "veach-ajar",
     .lacks = "the scene is a model of the paper's", .text = "a door ajar: less error than PSSMLT [Hachisuka 2014]"},
    {.method = "mmlt", .over = "mlt", .below = 1, .where = "veach-ajar",
     .lacks = "the scene is a model of the paper's", .text = "a door ajar: no more error than MLT [Hachisuka 2014]"},
    {.method = "asbdpt:select=subspaces", .over = "bdpt", .below = 1, .text = "better than BDPT; ours"},
    {.method = "asbdpt:select=subspaces", .over = "lvc", .below = 1, .text = "better than LVC; ours"},
    {.method = "asbdpt:select=subspaces:connections=1:pathpixels=1", .over = "lvc:connections=1", .below = 1,
     .alone = true, .text = "better than LVC with as many draws and light sub-paths; ours"},
    {.method = "asbdpt:select=subspaces", .over = "lvc:connections=0", .below = 1,
     .lacks = "the paper's has one cache for the image, and none of the techniques",
     .text = "better than LVC with the connections of its paper; ours"},
    {.method = "asbdpt:select=subspaces", .over = "cbdpt:connections=1", .below = 1,
     .text = "better than BDPT with the shared techniques; ours"},
    {.method = "asbdpt:select=subspaces", .over = "pcbdpt", .below = 1,
     .lacks = "the bound of pcbdpt is known at second hand", .text = "better than PCBDPT; ours"},
    {.method = "asbdpt:select=subspaces", .over = "ris", .below = 1, .alone = true,
     .text = "better than RIS; ours"},
    {.method = "asbdpt:select=subspaces", .over = "spcbpt", .below = 1, .lacks = "its paper could not be read",
     .text = "better than SPCBPT; ours"},
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
        ratio[k] = equal_mean(r, method, over, (enum square)k, c->at, c->where, n);
        below = below && ratio[k].high < c->below;
        above = above || ratio[k].low > c->below;
    }
    if (*n == 0)
        return CLAIM_UNMEASURED;
    return c->lacks != NULL ? CLAIM_NOT_JUDGED : below ? CLAIM_FOUND : above ? CLAIM_NOT_FOUND : CLAIM_OPEN;
}

static void claim_row(struct md_table *t, const struct claim *c, enum verdict_of v,
                      const struct interval ratio[N_SQUARES], int n)
{
    static const char *const verdicts[] = {"**found**", "**not found**", "cannot tell", "not judged: "};
    md_add(t, "%s: %s", method_short(c->method), c->text);
    md_add(t, "%s / %s < %.2g%s%s", method_short(c->method), method_short(c->over), c->below,
              c->at == AT_EQUAL_SAMPLES ? ", equal samples" : "", c->alone ? ", the choice alone" : "");
    for (int k = 0; k < N_SQUARES; k++)
        md_add_interval(t, ratio[k], "");
    md_add(t, "%d%s%s", n, c->where != NULL ? ", " : "", c->where != NULL ? c->where : "");
    md_add(t, "%s%s", verdicts[v], c->lacks != NULL ? c->lacks : "");
}

void claims_table(FILE *f, const struct results *r, enum half half)
{
    enum { N = sizeof CLAIMS / sizeof CLAIMS[0] };
    struct interval ratio[N][N_SQUARES];
    enum verdict_of v[N];
    int n[N], judged = 0;
    for (int i = 0; i < N; i++) {
        v[i] = claim_judge(r, &CLAIMS[i], half, ratio[i], &n[i]);
        judged += v[i] < CLAIM_NOT_JUDGED;
    }
    struct md_table t =
        md_begin(f, "Claims: squared error over that of another method after the same CPU time, or the same "
                    "samples, geometric mean over scenes with its 95 %% interval; found if below the number claimed by "
                    "all three, not found if above by one. By chance at most one in forty is found that is only as "
                    "good as the number: %.1f of the %d judged here", judged / 40.0, judged);
    md_column(&t, "claim");
    md_column(&t, "criterion");
    for (int k = 0; k < N_SQUARES; k++)
        md_column(&t, "%s", EQUAL_NAMES[k]);
    md_column(&t, "scenes");
    md_column(&t, "verdict");
    for (int i = 0; i < N; i++)
        if (v[i] != CLAIM_UNMEASURED)
            claim_row(&t, &CLAIMS[i], v[i], ratio[i], n[i]);
    md_end(&t);
}
