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
#include "base/number.h"
#include "caustics/surfaces.h"
#include "rivals/ris.h"

static void prepare(const struct render_job *job, struct prepared *p)
{
    (void)job;
    for (int hit = 0; hit < EYE_HITS; hit++) /* all draws count as one */
        p->draw_worth[hit] = 1.0 / most_of(p->numbers.draws[hit], 1);
}

static const struct field PARAMETERS[] = {
    PARAMETER("connections", FIELD_INTEGER, numbers.draws[FIRST_HIT], 4, 1, 1024,
              "light vertices drawn for each eye vertex", NULL),
    PARAMETER_LATER(-1), PARAMETER_CREDITS(false), PARAMETER_BOUND(false), PARAMETER_POINTS(1),
    PARAMETER_GUIDE(false), PARAMETER_EMISSION(1), PARAMETER_TILES(RECORDS_TILE, 1),
    {.name = NULL}};
static const struct field OWN[] = {
    RIS_SUBPATHS_FIELD(200), RIS_RECORDS_FIELD,
    {"normals", FIELD_NUMBER, offsetof(struct ris, normals), 0.5, 0, 1e6,
     "weight of normals relative to places when records are sought", NULL},
    {.name = NULL}};

const struct method method_pcbdpt = {
    .name = "pcbdpt", .check = surfaces_alone,
    .help = "probabilistic connections [Popov 2015]: light vertices drawn by records nearby",
    .parameters = PARAMETERS, .own = OWN, .own_size = sizeof(struct ris), .numbers = NUMBERS_OF_BDPT,
    .rr_threshold = DEFAULT_RR_THRESHOLD, .prepare = prepare, .build = ris_build, .draw = ris_draw,
    .render = ris_render};
