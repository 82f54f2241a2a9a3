/* ris2.c: two-stage resampling: of very many light vertices a few are drawn by their power, and resampled by records.
 *
 * The first stage draws M2 of all light vertices of the pool's K sub-paths, v with probability g_v / S, g_v = L_v,
 * S = sum of g, and gives each the factor u = S / (M2 g_v). The second is ris.c with these for light vertices, h_c(v) u
 * for their worth to record c, and [Nabata 2020b]
 *     X = w_{s,c} F(v) u / (K P_c PMF_c(v)),
 *     N_{s,c} = P_c / (1/K + (1 - 1/K) (Q_g / (M2 g_v) + (1 - 1/M2) Q_c / h_c)),
 * Q_g being the expectation of the sum of g over a light sub-path: the second moment over both stages. So records cost
 * M2 shadow rays each however many sub-paths there are. The paper's g could not be read; L_v is our choice.
 *
 * Tests: test_ris.c, test_rivals.c.
 */
#include <stddef.h>

#include "base/alias.h"
#include "caustics/surfaces.h"
#include "rivals/ris.h"

void ris2_presample(struct ris *r, const struct tile_pass *pass, long iteration)
{
    const struct candidates all = r->found;
    int M2 = r->state->presampled;
    int x, y;
    pixels_get(pass->tile->pixels, 0, &x, &y);
    struct sampler sampler = pixel_sampler(pass, RNG_SHUFFLE, x, y, iteration);
    double *before = arena_alloc(&r->arena, (size_t)all.n * sizeof *before), S = 0;
    r->u = arena_alloc(&r->arena, (size_t)M2 * sizeof *r->u);
    for (int v = 0; v < all.n; v++) {
        before[v] = S;
        S += all.item[v].L;
    }
    r->found.n = 0;
    r->found.item = arena_alloc(&r->arena, (size_t)M2 * sizeof *r->found.item);
    for (int i = 0; S > 0 && S < INFINITY && i < M2; i++) {
        double at = (i + sampler_number(&sampler, DRAW_ORDER)) / M2;
        const struct candidate *v = &all.item[cumulative_find(before, all.n, at * S)];
        r->u[r->found.n] = S / (M2 * v->L);
        if (v->L > 0)
            r->found.item[r->found.n++] = *v;
    }
}

#define AT(member) offsetof(struct ris_state, member)
static const struct field PARAMETERS[] = {
    {"weights", FIELD_WORD, AT(nabata), 1, 0, 0, "what draws count for", RIS_WEIGHTS},
    {"presampled", FIELD_INTEGER, AT(presampled), 200, 1, 100000, "light vertices left by the first stage", NULL},
    {"subpaths", FIELD_INTEGER, AT(sub_paths), 10000, 1, 1e6, "light sub-paths that are drawn from", NULL},
    {"records", FIELD_NUMBER, AT(records), RECORDS_SHARE, 0, 1, "share of pixels that have records", NULL},
    RIS_SERVICES,
    {.name = NULL}};

const struct method method_ris2 = {
    .name = "ris2", .check = surfaces_alone,
    .help = "two-stage resampling [Nabata 2020b]: by power first, then by a record nearby",
    .why = "one draw for each eye vertex, by one of the records nearby or uniformly, from light vertices drawn before "
           "in proportion to luminance(beta), which have a factor u for that; scale u / (K P)",
    .parameters = PARAMETERS, .state_size = sizeof(struct ris_state), .scratch_size = sizeof(struct ris),
    .numbers = NUMBERS_OF_BDPT, .rr_threshold = DEFAULT_RR_THRESHOLD, .prepare = ris_prepare, .render = ris_render,
    .scratch_init = ris_scratch_init, .scratch_free = ris_scratch_free, .begin = ris_begin, .draw = ris_draw};
