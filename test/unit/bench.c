/* bench.c: see bench.h. */
#include "bench.h"

#include <string.h>

#include "helpers.h"
#include "integrators/prepare.h"
#include "lab/methods.h"

/* A matte floor and wall, a mirror for a side wall, a glossy and a glass ball, a lamp, and a lamp that nobody sees. */
static const char ROOM[] =
    "LookAt 0 1.5 -4  0 1 0  0 1 0 Camera \"perspective\" \"float fov\" 50 %s\n"
    "Film \"image\" \"integer xresolution\" %d \"integer yresolution\" %d PixelFilter \"%s\"\n"
    "Integrator \"bdpt\" \"float rrthreshold\" 0\n"
    "WorldBegin AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [6 5 4]\n"
    QUAD("-1 3 -1  1 3 -1  1 3 1  -1 3 1")
    "AttributeEnd LightSource \"point\" \"rgb I\" [1 2 3] \"point from\" [-1.5 1 -1]\n"
    "Material \"matte\" \"rgb Kd\" [.7 .6 .5] " QUAD("-2 0 -2  2 0 -2  2 0 2  -2 0 2")
    QUAD("-2 0 2  2 0 2  2 3 2  -2 3 2")
    "Material \"mirror\" " QUAD("-2 0 -2  -2 0 2  -2 3 2  -2 3 -2")
    "Material \"metal\" \"float roughness\" .1\n"
    "TransformBegin Translate .8 .6 .5 Shape \"sphere\" \"float radius\" .6 TransformEnd\n"
    "Material \"glass\" TransformBegin Translate -.7 .7 0 Shape \"sphere\" \"float radius\" .5 TransformEnd WorldEnd\n";

const char FOGGY[] =
    "Integrator \"bdpt\" MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [.01 .02 .03]\n"
    "\"rgb sigma_s\" [.1 .1 .08] \"float g\" .5 MakeNamedMedium \"milk\" \"string type\" \"homogeneous\"\n"
    "\"rgb sigma_a\" [.1 .2 .4] \"rgb sigma_s\" [2 2 2] MediumInterface \"fog\"\n"
    "LookAt 0 1.6 -4.5  0 .9 0  0 1 0 Camera \"perspective\" \"float fov\" 42 PixelFilter \"mitchell\"\n"
    "Film \"image\" \"integer xresolution\" 16 \"integer yresolution\" 16 WorldBegin\n"
    "AttributeBegin MediumInterface \"\" LightSource \"infinite\" \"rgb L\" [.3 .4 .5] AttributeEnd\n"
    "LightSource \"point\" \"rgb I\" [3 2 1] \"point from\" [-1 2 0] \"string group\" \"warm\"\n"
    "AttributeBegin MediumInterface \"fog\" \"\" Material \"\" Shape \"sphere\" \"float radius\" 7 AttributeEnd\n"
    "Material \"matte\" \"rgb Kd\" [.8 .7 .6] Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3]\n"
    "  \"point P\" [-1.5 0 -1.5  1.5 0 -1.5  1.5 0 1.5  -1.5 0 1.5]\n"
    "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [5 5 5] \"bool twosided\" \"true\"\n"
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" [-2 4 -2  2 4 -2  2 4 2  -2 4 2]\n"
    "AttributeEnd MediumInterface \"milk\" \"fog\" Material \"glass\"\n"
    "Translate 0 .7 0 Shape \"sphere\" \"float radius\" .6 WorldEnd\n";

bool chain_room(struct test *t, int width, int height, const char *lens, const char *filter, struct scene *out)
{
    return scene_from_format(t, out, ROOM, lens, width, height, filter);
}

bool bench_new(struct test *t, const struct scene *scene, const char *integrator, int max_depth, uint64_t seed,
               struct bench *out)
{
    struct render_job o = {.integrator = method_of(scene, integrator), .seed = test_seed(t) + seed,
                               .max_depth = max_depth, .n_threads = 1};
    struct error err = {.text = ""};
    memset(out, 0, sizeof *out);
    out->scene = scene;
    if (!CHECK(t, render_prepare(scene, &o, render_crop(scene), &out->job, &out->prepared, &err), "%s", err.text))
        return false;
    out->work = workspaces_new(1, out->job.max_depth);
    if (method_is_chain(out->prepared.method)) {
        out->chain = chain_new(&out->prepared, &out->job, out->work);
        out->chain->rng = rng_stream(o.seed, RNG_TEST, 1, 0);
        if (out->chain->all->b > 0)
            chain_start(out->chain, 0);
    }
    return true;
}

void bench_free(struct bench *b)
{
    if (b->chain != NULL)
        chain_free(b->chain);
    tile_free(&b->tile);
    workspaces_free(b->work, 1);
    method_release(&b->prepared);
}

struct tile_pass bench_pass(struct bench *b, long first, long end)
{
    struct tile_pass pass = {.job = &b->job, .counts = &b->prepared.counts, .first = first, .end = end,
                             .tile = &b->tile, .work = b->work, .ends_at = CANCEL_NOW};
    tile_start(&b->tile, pixels_all(b->job.film_rect), b->job.film_rect, &b->scene->filter);
    return pass;
}
