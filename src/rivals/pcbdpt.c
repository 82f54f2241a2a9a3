/* pcbdpt.c: probabilistic connections: light vertices are drawn by what they are worth to records nearby.
 *
 * Each eye vertex draws C of the V light vertices of the tile's K sub-paths from the mean of the PMFs of the three
 * records next to it (records.h), in place and normal, and of the uniform choice, which reaches what none of them
 * sees [Popov 2015]:
 *     P(v) = (PMF_1(v) + PMF_2(v) + PMF_3(v) + 1/V) / 4,    X = (1/C) sum over draws of w F(v) / (K P(v)).
 * Any P that reaches all has BDPT's expectation, so it may depend on the pool and on the eye vertex. The weights may
 * not: they are BDPT's, one sample for every strategy; what the paper does against the variance of shared light
 * sub-paths could not be read. s = 0, s = 1 and t = 1 stay as they are.
 *
 * Without records P is uniform, as in lvc.c.
 *
 * Tests: test_rivals.c.
 */
#include <stddef.h>
#include <stdlib.h>

#include "rivals/records.h"

struct pcbdpt_state {
    struct frozen frozen;
    int connections; /* C */
    double records, normals;
};

struct pcbdpt {
    struct light_pool pool; /* the first, see pooled.h */
    struct candidates found;
    struct records records;
};

static void begin(void *scratch, const void *state, const struct tile_pass *pass, long iteration)
{
    struct pcbdpt *p = scratch;
    const struct pcbdpt_state *s = state;
    candidates_find(&p->found, &p->pool);
    records_place(&p->records, pass, &s->frozen, iteration, s->records);
    records_fill(&p->records, pass->job->scene, &p->found, NULL);
}

/* C draws for one eye vertex, stratified over records and pool. */
static void draw(void *scratch, const void *state, struct pooled_pixel *pixel, const struct vertex *z, int t)
{
    struct pcbdpt *p = scratch;
    const struct pcbdpt_state *s = state;
    int C = s->connections, V = p->found.n, which;
    struct mixture mixture = records_mixture(&p->records, pixel->sample.scene, z, s->normals, false, V);
    for (int c = 0; V > 0 && c < C; c++) {
        int v = mixture_draw(&mixture, (c + sampler_number(&pixel->draws, DRAW_LIGHT_END)) / C, &which);
        double P = mixture_pmf(&mixture, v);
        const struct choice choice = {P, 1 / (C * P * p->pool.n)};
        pooled_join(pixel, &p->found.item[v], z, t, choice);
    }
}

static void free_scratch(void *scratch)
{
    struct pcbdpt *p = scratch;
    light_pool_free(&p->pool);
    free(p->found.item);
    records_free(&p->records);
}

static void prepare(const struct render_job *job, struct preparation *out)
{
    struct frozen *f = out->state;
    (void)job;
    out->size.tile = RECORDS_TILE;
    f->counts.splat /= f->path_pixels;
}

#define AT(member) offsetof(struct pcbdpt_state, member)
static const struct method_parameter PARAMETERS[] = {
    {"connections", PARAMETER_INTEGER, AT(connections), 1, 1, 1024, "light vertices drawn for each eye vertex", NULL},
    {"pathpixels", PARAMETER_INTEGER, AT(frozen.path_pixels), RECORDS_PATH_PIXELS, 1, RECORDS_TILE * RECORDS_TILE,
     "pixels for each light sub-path", NULL},
    {"records", PARAMETER_NUMBER, AT(records), RECORDS_SHARE, 0, 1, "share of pixels whose eye sub-paths are records",
     NULL},
    {"normals", PARAMETER_NUMBER, AT(normals), 0.5, 0, 1e6, "what normals count beside places in looking for records",
     NULL},
    {.name = NULL}};

const struct method method_pcbdpt = {
    .name = "pcbdpt", .help = "probabilistic connections [Popov 2015]: light vertices drawn by records nearby",
    .why = "C draws for each eye vertex from the tile's light vertices, P the mean of the PMFs of the records nearby "
           "and of the uniform choice; scale 1 / (C K P)",
    .parameters = PARAMETERS, .state_size = sizeof(struct pcbdpt_state), .scratch_size = sizeof(struct pcbdpt),
    .rr_threshold = DEFAULT_RR_THRESHOLD, .prepare = prepare, .render = pooled_render, .scratch_free = free_scratch,
    .begin = begin, .draw = draw};
