/* pcbdpt.c: probabilistic connections: light vertices are drawn by what they are worth to records nearby.
 *
 * Each eye vertex draws C of the V light vertices of the tile's K sub-paths from the mean of the PMFs of the three
 * records next to it (records.h), in place and normal, and of the uniform choice, which reaches what none of them
 * sees [Popov 2015]:
 *     P(v) = (PMF_1(v) + PMF_2(v) + PMF_3(v) + 1/V) / 4,    X = (1/C) sum over draws of w F(v) / (K P(v)).
 * Any P that reaches all has BDPT's expectation, so it may depend on the pool and on the eye vertex. The weights may
 * not: they are BDPT's, one sample for every strategy. That is the paper's bound as [Grittmann 2021] compares with it:
 * samples that share sub-paths have at most the variance of one, so any number of them counts as one. The paper's own
 * text could not be read. s = 0, s = 1 and t = 1 stay as they are.
 *
 * Without records P is uniform, as in lvc.c.
 *
 * Tests: test_rivals.c.
 */
#include <stddef.h>

#include "caustics/surfaces.h"
#include "rivals/plain.h"
#include "rivals/ris.h"

struct pcbdpt_state {
    struct ris_state ris; /* weights = counts, one stage */
    int connections;      /* C */
    double normals;
};

/* C draws for one eye vertex, stratified over records and pool. */
static void draw(void *scratch, const void *state, struct pooled_pixel *pixel, const struct vertex *z, int t)
{
    struct ris *r = scratch;
    const struct pcbdpt_state *s = state;
    int V = r->found.n, C = s->ris.frozen.numbers.draws[z->eye_end], which;
    if (V == 0)
        return;
    struct mixture mixture = records_mixture(&r->records, pixel->sample.scene, z, s->normals, false, V);
    for (int c = 0; c < C; c++) {
        int v = mixture_draw(&mixture, (c + sampler_number(&pixel->draws, DRAW_LIGHT_END)) / C, &which);
        double P = mixture_pmf(&mixture, v);
        const struct choice choice = {P, 1 / (C * P * r->K)};
        pooled_join(pixel, &r->found.item[v], z, t, choice);
    }
}

static void prepare(const struct render_job *job, struct preparation *out)
{
    struct pcbdpt_state *s = out->state;
    for (int end = 0; end < EYE_ENDS; end++)
        s->ris.frozen.numbers.draws[end] = s->connections;
    plain_prepare(job, out);
    s->ris.frozen.counts.connect[FIRST_HIT] = s->ris.frozen.counts.connect[LATER_HIT] = 1;
}

#define AT(member) offsetof(struct pcbdpt_state, member)
static const struct field PARAMETERS[] = {
    {"connections", FIELD_INTEGER, AT(connections), 4, 1, 1024, "light vertices drawn for each eye vertex", NULL},
    {"subpaths", FIELD_INTEGER, AT(ris.sub_paths), 200, 1, 1e6, "light sub-paths that are drawn from",
     NULL},
    {"records", FIELD_NUMBER, AT(ris.records), RECORDS_SHARE, 0, 1, "share of pixels that have records", NULL},
    {"normals", FIELD_NUMBER, AT(normals), 0.5, 0, 1e6, "weight of normals relative to places when records are sought",
     NULL},
    SERVICES(false, 1, 1, RECORDS_TILE, 1),
    {.name = NULL}};

const struct method method_pcbdpt = {
    .name = "pcbdpt", .check = surfaces_alone,
    .help = "probabilistic connections [Popov 2015]: light vertices drawn by records nearby",
    .why = "C draws for each eye vertex from the tile's light vertices, P the mean of the PMFs of the records nearby "
           "and of the uniform choice; scale 1 / (C K P)",
    .parameters = PARAMETERS, .state_size = sizeof(struct pcbdpt_state), .scratch_size = sizeof(struct ris),
    .numbers = NUMBERS_OF_BDPT, .rr_threshold = DEFAULT_RR_THRESHOLD, .prepare = prepare, .render = pooled_render,
    .scratch_init = ris_scratch_init, .scratch_free = ris_scratch_free, .begin = ris_begin, .draw = draw};
