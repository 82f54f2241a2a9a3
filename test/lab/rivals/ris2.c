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
 * Tests: test_rival_parts.c, test_rivals.c.
 */
#include "base/alias.h"
#include "caustics/surfaces.h"
#include "rivals/ris.h"

void ris2_presample(struct cache *r, const struct tile_pass *pass, struct arena *arena, long iteration)
{
    const struct vertex *const *all = r->found;
    int M2 = r->own->presampled, n = r->V, x, y;
    pixels_get(pass->tile->pixels, 0, &x, &y);
    struct sampler sampler = sample_stream(pass, RNG_SHUFFLE, x, y, (uint64_t)iteration);
    const struct vertex **kept = arena_alloc(arena, (size_t)M2 * sizeof *kept);
    double *before = arena_alloc(arena, (size_t)n * sizeof *before), S = 0;
    r->u = arena_alloc(arena, (size_t)M2 * sizeof *r->u);
    for (int v = 0; v < n; v++) {
        before[v] = S;
        S += rgb_worth(all[v]->beta);
    }
    r->V = 0;
    r->found = kept;
    for (int i = 0; S > 0 && S < INFINITY && i < M2; i++) {
        double at = (i + sampler_number(&sampler, DRAW_ORDER)) / M2;
        const struct vertex *v = all[cumulative_find(before, n, at * S)];
        r->u[r->V] = S / (M2 * rgb_worth(v->beta));
        if (rgb_worth(v->beta) > 0)
            kept[r->V++] = v;
    }
}

static const struct field OWN[] = {
    RIS_WEIGHTS_FIELD,
    {"presampled", FIELD_INTEGER, offsetof(struct ris, presampled), 200, 1, 100000,
     "light vertices left by the first stage", NULL},
    RIS_SUBPATHS_FIELD(10000), RIS_RECORDS_FIELD,
    {.name = NULL}};

const struct method method_ris2 = {
    .name = "ris2", .check = surfaces_alone,
    .help = "two-stage resampling [Nabata 2020b]: by power first, then by a record nearby",
    .parameters = RIS_PARAMETERS, .own = OWN, .own_size = sizeof(struct ris), .numbers = NUMBERS_OF_BDPT,
    .rr_threshold = DEFAULT_RR_THRESHOLD, .vertices = true, .prepare = ris_prepare,
    .build = ris_build, .draw = ris_draw, .render = ris_render};
