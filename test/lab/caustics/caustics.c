/* caustics.c: the method `caustics`: another, with caustic connections (caustic.h) where they are worth their cost.
 *
 * Tests: test_caustic.c.
 */
#include <stddef.h>

#include "caustics/caustic.h"
#include "caustics/surfaces.h"

struct caustics_own {
    struct one_more_own base;
    int longest;
    struct one_more *chains; /* owned */
};

static void prepare(const struct render_job *job, struct prepared *p)
{
    struct caustics_own *own = p->own;
    one_more_prepare(job, p);
    own->chains = caustics_new(job->scene, own->longest);
    if (own->chains != NULL && caustics_pay(own->chains, job, &own->base.method))
        own->base.more = own->chains;
}

static void release(struct prepared *p)
{
    caustics_free(((struct caustics_own *)p->own)->chains);
    one_more_release(p);
}

static const struct field OWN[] = {
    ONE_MORE_WITH(caustics_own),
    {"longest", FIELD_INTEGER, offsetof(struct caustics_own, longest), SPECULAR_LONGEST, 1, SPECULAR_LONGEST,
     "most mirrors or glass surfaces between a first hit and a light that are joined, if it is worth its cost", NULL},
    {.name = NULL}};

const struct method method_caustics = {
    .name = "caustics", .check = surfaces_alone,
    .help = "another method with caustic connections [Hanika 2015], through mirrors and glass",
    .own = OWN, .own_size = sizeof(struct caustics_own), .rr_threshold = DEFAULT_RR_THRESHOLD, .prepare = prepare,
    .release = release, .render = one_more_pass};
