/* test_objects.c: objects that instances share (geometry/shape.h): rays meet, and scenes show, what they do with
 * copies.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/number.h"
#include "lab/numbers.h"
#include "helpers.h"
#include "kd_parts.h"
#include "render/render.h"
#include "suites.h"

/* Anywhere, turned, stretched, every other one mirrored. */
static struct transform some_place(struct rng *r, int i)
{
    vec3 s = in_cube(r), at = in_cube(r), axis_of = on_sphere(r);
    struct transform scale = transform_scale((i % 2 == 0 ? -1 : 1) * exp(s.x), exp(s.y), exp(s.z));
    struct transform turn = transform_rotate(360 * rng_uniform(r), axis_of);
    return transform_compose(transform_translate(mul(at, 3)), transform_compose(turn, scale));
}

static void add_random(struct test *t, struct geometry *geo, struct rng *r, int n, int alpha)
{
    struct mesh s = {0};
    struct transform id = transform_identity();
    struct shape_group g = group_of(0, -1);
    struct error err;
    g.alpha = alpha;
    make_random(&s, r, n, 0.5, vec(0, 0, 0));
    CHECK(t, shape_add_mesh(geo, &s, &id, g, false, &err) >= 0, "%s", err.text);
    mesh_free(&s);
}

/* --- rays --------------------------------------------------------------------------------------------- */

/* The ray in the world that is this one in an instance. */
static struct ray ray_out(const struct geometry *geo, int instance, struct ray r)
{
    r.o = transform_point(&geo->instance[instance - 1].to_world, r.o);
    r.d = normalize(transform_vector(&geo->instance[instance - 1].to_world, r.d));
    return r;
}

/* Triangles with holes are half there. It counts how often it is asked within an instance. */
static bool half_there(const void *context, const struct geometry *geo, const struct hit *hit)
{
    int *asked = *(int *const *)context;
    *asked += hit->instance > 0;
    return shape_group_of(geo, hit->prim)->alpha < 0 || hit->b1 < 0.5;
}

/* Objects of triangles, quadrics, and triangles with holes, in many places; half of all rays begin, and half of these
 * end, on a primitive, which may be that of an instance. */
static void check_rays(struct test *t, struct rng *r)
{
    enum { OBJECTS = 2, INSTANCES = 24, RAYS = 6000 };
    struct geometry geo = {0};
    struct kdtree kd;
    struct error err;
    int asked = 0, *counter = &asked, wrong = 0, inside = 0, again = 0;
    add_random(t, &geo, r, 40, -1);
    for (int i = 0; i < OBJECTS; i++) {
        int first = geo.n_groups;
        add_random(t, &geo, r, 60, -1);
        add_quadrics(&geo, r, 12);
        add_random(t, &geo, r, 20, 0);
        CHECK(t, shape_make_object(&geo, first) == i, "object %d", i);
    }
    for (int i = 0; i < INSTANCES; i++) {
        struct transform place = some_place(r, i);
        CHECK(t, shape_add_instance(&geo, i % OBJECTS, &place, &err), "%s", err.text);
    }
    geo.opaque = half_there;
    geo.opaque_context = &counter;
    kd_build(&kd, &geo, KD_SURFACES);
    struct ray ray = {.tmin = 0};
    for (int i = 0; i < RAYS; i++) {
        struct hit want = {0}, got = {0};
        if (ray.from == 0)
            ray = ray_out(&geo, 1 + i % INSTANCES, awkward_ray(&geo, r, 2));
        bool met = brute_closest(&geo, false, &ray, &want);
        bool same = kd_closest(&kd, &geo, &ray, &got) == met && kd_occluded(&kd, &geo, &ray, INFINITY) == met &&
                    (!met || (got.t == want.t && got.prim == want.prim && got.instance == want.instance));
        inside += met && want.instance > 0;
        again += met && want.instance > 0 && ray.from >> 32 > 0;
        wrong += !same;
        CHECK(t, same || wrong > 1, "ray %d meets %d in %d at %.17g, not %d in %d at %.17g", i, got.prim, got.instance,
              got.t, want.prim, want.instance, want.t);
        /* The next one is the same, but begins on what this has met; then, ends on it as well; then, another one. */
        uint64_t id = shape_prim_id(want.prim, want.instance);
        bool done = !met || ray.to != 0;
        ray.to = !done && ray.from != 0 ? id : 0;
        ray.from = done ? 0 : ray.from != 0 ? ray.from : id;
    }
    CHECK(t, wrong == 0 && inside > RAYS / 4 && again > RAYS / 20 && asked > RAYS / 20,
          "%d of %d rays wrong, %d meet an instance, %d from one, %d ask for holes", wrong, RAYS, inside, again, asked);
    kd_free(&kd);
    struct transform far = transform_translate(vec(1e12, 0, 0)); /* one end of it is near enough */
    CHECK(t, !shape_add_instance(&geo, 0, &far, &err) && strstr(err.text, "places go up to 1e12") != NULL,
          "an instance at no place");
    geo.n_instances = 1 << 29;
    geo.n_quadrics = 1 << 28;
    CHECK(t, !shape_add_instance(&geo, 0, &far, &err) && strstr(err.text, "2^29 instances") != NULL,
          "too many instances");
    CHECK(t, shape_add_quadric(&geo, geo.quadric[0], group_of(0, -1), false, &err) < 0 &&
             strstr(err.text, "2^28 quadrics") != NULL, "too many quadrics");
    geometry_free(&geo);
}

/* From within a ball in an object no ray gets out. */
static void check_closed(struct test *t, struct rng *r)
{
    struct mesh s = {0};
    struct kdtree kd;
    int escaped = 0;
    make_ball(&s, r, 60, 90, 1, vec(1, 2, 3));
    struct geometry geo = geometry_of(t, &s);
    struct transform place = some_place(r, 0);
    shape_add_instance(&geo, shape_make_object(&geo, 0), &place, NULL);
    kd_build(&kd, &geo, KD_SURFACES);
    for (int i = 0; i < 40000; i++) {
        float v[9];
        shape_vertices(&geo, (int)rng_below(r, (uint32_t)geo.n_triangles), v);
        vec3 a = load3(v, 0), b = load3(v, 1), o = add(vec(1, 2, 3), mul(in_cube(r), 0.5));
        struct ray ray = {o, sub(lerp3(i % 3 * 0.5, a, b), o), 0, INFINITY, 0, 0};
        struct hit hit;
        ray = ray_out(&geo, 1, ray);
        escaped += !kd_closest(&kd, &geo, &ray, &hit) || !kd_occluded(&kd, &geo, &ray, INFINITY);
    }
    CHECK(t, escaped == 0, "%d of 40000 rays got out", escaped);
    kd_free(&kd);
    geometry_free(&geo);
}

/* --- surfaces ----------------------------------------------------------------------------------------- */

static double apart(const struct surface *a, const struct surface *b)
{
    const vec3 *x[] = {&a->p, &a->ng, &a->ns, &a->dpdu, &a->dpdv, &a->dndu, &a->dndv};
    const vec3 *y[] = {&b->p, &b->ng, &b->ns, &b->dpdu, &b->dpdv, &b->dndu, &b->dndv};
    double most = fabs(a->u - b->u) + fabs(a->v - b->v);
    for (int i = 0; i < 7; i++)
        most = fmax(most, length(sub(*x[i], *y[i])) / (1 + length(*y[i])));
    return most;
}

/* A mesh with normals, tangents and texture coordinates, or a quadric, placed by its own transform and an instance's:
 * the surface is that of a copy, whose corners are rounded to float. */
static void check_surfaces(struct test *t, struct rng *r)
{
    for (int i = 0; i < 200; i++) {
        struct geometry shared = {0}, copied = {0};
        struct transform own = some_place(r, i), place = some_place(r, i / 2);
        struct transform both = transform_compose(place, own);
        struct error err = {.text = ""};
        bool reverse = i / 4 % 2 == 1;
        if (i % 5 < 3) {
            vec3 P[3];
            float N[9], S[9], UV[6] = {0, 0, 1, 0, 0.2f, 1};
            uint32_t index[3] = {0, 1, 2};
            for (size_t k = 0; k < 3; k++) {
                P[k] = in_cube(r);
                store3(N, k, add(vec(0, 0, 2), in_cube(r)));
                store3(S, k, add(vec(2, 0, 0), in_cube(r)));
            }
            struct mesh m = {.P = P, .N = i % 5 < 2 ? N : NULL, .UV = UV, .index = index, .n_vertices = 3, .n_triangles = 1,
                             .S = i % 5 < 1 ? S : NULL};
            CHECK(t,
                  shape_add_mesh(&shared, &m, &own, group_of(0, -1), reverse, &err) == 0 &&
                      shape_add_mesh(&copied, &m, &both, group_of(0, -1), reverse, &err) == 0,
                  "%s", err.text);
        } else {
            struct quadric q = {.kind = i % 2 == 0 ? QUADRIC_SPHERE : QUADRIC_DISK, .radius = 1, .phi_max = 5};
            q.zmin = q.kind == QUADRIC_DISK ? 0.3 : -0.9;
            q.zmax = q.kind == QUADRIC_DISK ? 0.3 : 0.8;
            q.to_world = own;
            shape_add_quadric(&shared, q, group_of(0, -1), reverse, &err);
            q.to_world = both;
            shape_add_quadric(&copied, q, group_of(0, -1), reverse, &err);
        }
        CHECK(t, shape_add_instance(&shared, shape_make_object(&shared, 0), &place, &err), "%s", err.text);
        int prim = prim_number(&copied, 0);
        struct surface sample, a, b;
        double pdf;
        shape_sample(&copied, prim, 0.1 + 0.8 * rng_uniform(r), 0.1 + 0.8 * rng_uniform(r), &sample, &pdf);
        struct ray ray = {add(sample.p, mul(sample.ng, 2)), neg(sample.ng), 0, INFINITY, 0, 0};
        struct kdtree kd;
        struct hit hit;
        kd_build(&kd, &shared, KD_SURFACES);
        if (CHECK(t, kd_closest(&kd, &shared, &ray, &hit) && hit.instance == 1, "case %d is missed", i)) {
            shape_surface(&shared, &hit, &ray, &a);
            CHECK(t, shape_intersect(&copied, prim, &ray, &hit), "copy %d is missed", i);
            shape_surface(&copied, &hit, &ray, &b);
            CHECK(t, apart(&a, &b) < 1e-4, "case %d is apart by %g from a copy", i, apart(&a, &b));
        }
        kd_free(&kd);
        geometry_free(&shared);
        geometry_free(&copied);
    }
}

/* The bounds of an instance are those of its object's box, here from 0 to 1. */
static void check_bounds(struct test *t, struct rng *r)
{
    for (int i = 0; i < 40; i++) {
        struct mesh s = {0};
        add_triangle(&s, vec(0, 0, 0), vec(1, 1, 1), vec(1, 0, 0));
        struct geometry geo = geometry_of(t, &s);
        struct transform place = some_place(r, i);
        float lo[3], hi[3];
        shape_add_instance(&geo, shape_make_object(&geo, 0), &place, NULL);
        shape_bounds(&geo, FIRST_INSTANCE, lo, hi);
        for (int k = 0; k < 3; k++) {
            const double *m = place.m[k];
            double least = m[3] + fmin(m[0], 0) + fmin(m[1], 0) + fmin(m[2], 0);
            double most = m[3] + fmax(m[0], 0) + fmax(m[1], 0) + fmax(m[2], 0);
            CHECK(t, fabs((double)lo[k] - least) < 1e-5 && fabs((double)hi[k] - most) < 1e-5,
                  "bounds %g to %g, not %g to %g", (double)lo[k], (double)hi[k], least, most);
        }
        geometry_free(&geo);
    }
}

/* --- scenes ------------------------------------------------------------------------------------------- */

/* Puts 2^18 triangles into a world, in one place that nobody sees: instances after it share what they can. */
static const char FILLER[] =
    "ObjectBegin \"filler\" Shape \"loopsubdiv\" \"integer levels\" 9 \"integer indices\" [ 0 1 2 ] \"point P\" "
    "[ 0 0 0 1 0 0 0 1 0 ] ObjectEnd AttributeBegin Translate 0 -90 0 Scale .01 .01 .01 ObjectInstance \"filler\" "
    "AttributeEnd\n";
/* With lights, a medium's bound and a disk; the first instance is a copy. %s: what comes before; how far the object is
 * from the origin of its space. */
static const char THINGS[] =
    "Film \"image\" \"integer xresolution\" 48 \"integer yresolution\" 32 PixelFilter \"box\"\n"
    "LookAt 0 2 -9  0 1 0  0 1 0 Camera \"perspective\" \"float fov\" 50 Integrator \"bdpt\" \"integer maxdepth\" 2\n"
    "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" \"rgb sigma_s\" [ .3 .2 .1 ] \"rgb sigma_a\" [ .1 .1 .1 ]\n"
    "WorldBegin\n%s"
    "LightSource \"point\" \"point from\" [ 0 7 -6 ] \"rgb I\" [ 60 60 60 ]\n"
    "ObjectBegin \"o\" Translate %s 0 0 Material \"matte\" \"rgb Kd\" [ .2 .5 .8 ]\n"
    "  Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] \"point P\" [ -1 0 1 1 0 1 1 2 1 -1 2 1 ]\n"
    "  Shape \"sphere\" \"float radius\" .6 ReverseOrientation Shape \"disk\" \"float radius\" .8 \"float height\" "
    "-.7\n"
    "  AttributeBegin MediumInterface \"m\" \"\" Material \"none\" Shape \"sphere\" \"float radius\" .9 AttributeEnd\n"
    "  AreaLightSource \"diffuse\" \"rgb L\" [ 4 3 2 ] Translate 0 1.5 0 Shape \"sphere\" \"float radius\" .2\n"
    "ObjectEnd\n"
    "AttributeBegin Translate -3 0 1 Translate -%s 0 0 ObjectInstance \"o\" AttributeEnd\n"
    "AttributeBegin Translate 0 1 0 Scale 1 -.7 1.2 Rotate 30 1 1 0 Translate -%s 0 0 ObjectInstance \"o\" "
    "AttributeEnd\n"
    "AttributeBegin Translate 3 0 1 Rotate 180 0 1 0 Translate -%s 0 0 ObjectInstance \"o\" AttributeEnd\n"
    "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] \"point P\" [ -9 -1 -9 9 -1 -9 9 -1 9 -9 -1 9 ]\n"
    "WorldEnd\n";

static float *picture_of(struct test *t, const char *filler, const char *away, struct scene *scene)
{
    char text[sizeof THINGS + sizeof FILLER];
    snprintf(text, sizeof text, THINGS, filler, away, away, away, away);
    if (!scene_from_text(t, text, scene))
        return NULL;
    float *out = mem_alloc(3 * (size_t)scene->width * (size_t)scene->height, sizeof *out);
    const struct render_job o = {.integrator = method_named("bdpt"), .end = 4, .n_threads = 1, .max_depth = 2};
    render_pixels(t, scene, &o, out);
    return out;
}

static void check_scene(struct test *t, const char *away)
{
    struct scene shared, copied;
    float *a = picture_of(t, FILLER, away, &shared), *b = picture_of(t, "", "0", &copied);
    if (a != NULL && b != NULL) {
        CHECK(t, shared.geo.n_instances == 2 && shared.geo.n_objects == 1 && copied.geo.n_instances == 0,
              "%d instances share %d objects, %d where there are few", shared.geo.n_instances, shared.geo.n_objects,
              copied.geo.n_instances);
        CHECK(t, shared.lights.n == copied.lights.n, "%d lights, not %d", shared.lights.n, copied.lights.n);
        int n = 3 * shared.width * shared.height, differ = 0;
        for (int i = 0; i < n; i++)
            differ += !(fabsf(a[i] - b[i]) <= 1e-3f * (fabsf(b[i]) + 0.1f));
        CHECK(t, differ <= n / 100, "%d of %d values differ from those of copies", differ, n);
    }
    if (a != NULL)
        scene_free(&shared);
    if (b != NULL)
        scene_free(&copied);
    free(a);
    free(b);
}

void test_objects(struct test *t)
{
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 103, 0);
    check_rays(t, &r);
    check_closed(t, &r);
    check_surfaces(t, &r);
    check_bounds(t, &r);
    check_scene(t, "0");
    check_scene(t, "1e8");
}
