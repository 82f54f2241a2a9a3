/* caustics.c: the method `caustics`: another, with caustic connections (caustic.h) where they are worth their cost.
 *
 * Tests: test_caustic.c.
 */
#include <stddef.h>

#include "caustics/caustic.h"
#include "caustics/surfaces.h"

struct caustics_state {
    struct one_more_state base;
    int longest;
    struct one_more *chains; /* owned */
};

static void prepare(const struct render_job *job, struct preparation *out)
{
    struct caustics_state *s = out->state;
    one_more_prepare(job, out);
    s->chains = caustics_new(job->scene, s->longest);
    if (s->chains != NULL && caustics_pay(s->chains, job, one_more_counts(&s->base)))
        s->base.more = s->chains;
}

static void release(void *state)
{
    struct caustics_state *s = state;
    caustics_free(s->chains);
    one_more_release(&s->base);
}

static const struct field PARAMETERS[] = {
    ONE_MORE_WITH(caustics_state),
    {"longest", FIELD_INTEGER, offsetof(struct caustics_state, longest), SPECULAR_LONGEST, 1, SPECULAR_LONGEST,
     "most mirrors or glass surfaces between a first hit and a light that are joined, if it is worth its cost", NULL},
    {.name = NULL}};

const struct method method_caustics = {
    .name = "caustics", .check = surfaces_alone,
    .help = "another method with caustic connections [Hanika 2015], through mirrors and glass",
    .parameters = PARAMETERS, .state_size = sizeof(struct caustics_state), .prepare = prepare, .release = release,
    ONE_MORE_ROW};
