/* test_camera.c: the cameras: projection inverts ray generation, J is the Jacobian of raster over solid angle, and
 * importance integrates to its known value. */
#include <math.h>

#include "scene/camera.h"
#include "base/number.h"
#include "base/rng.h"
#include "helpers.h"
#include "suites.h"

static void test_inverse(struct test *t, const struct camera *c, struct rng *r)
{
    double worst = 0;
    for (int i = 0; i < 1000; i++) {
        double px = c->width * rng_uniform(r), py = c->height * rng_uniform(r), qx, qy;
        struct ray ray = camera_ray(c, px, py, rng_uniform(r), rng_uniform(r));
        double J = camera_project(c, ray.o, ray.d, &qx, &qy);
        CHECK(t, !(ray.tmin > 0) && ray.tmax == INFINITY, "interval: a ray from %g to %g", ray.tmin, ray.tmax);
        CHECK(t, J > 0 && fabs(length(ray.d) - 1) < 1e-12, "J = %g, |d| = %.17g", J, length(ray.d));
        worst = most_of(worst, most_of(fabs(px - qx), fabs(py - qy)));
    }
    CHECK(t, worst < 1e-7, "screen: projection is off by %g pixels", worst);
    double px, py;
    CHECK(t, c->kind == CAMERA_ENVIRONMENT || camera_project(c, c->position, neg(c->forward), &px, &py) == 0,
          "a direction backwards was accepted");
}

/* Solid angle of a small raster square, from the directions of its corners; of parallel rays the area across them, from
 * their origins. */
static void test_jacobian(struct test *t, const struct camera *c, struct rng *r)
{
    const double h = 1e-3;
    for (int i = 0; i < 200; i++) {
        double px = c->width * rng_uniform(r), py = c->height * rng_uniform(r);
        double u1 = rng_uniform(r), u2 = rng_uniform(r), x, y;
        struct ray a = camera_ray(c, px, py, u1, u2), b = camera_ray(c, px + h, py, u1, u2);
        struct ray d = camera_ray(c, px, py + h, u1, u2);
        double solid_angle = length(cross(sub(b.d, a.d), sub(d.d, a.d)));
        if (c->parallel)
            solid_angle = abs_dot(a.d, cross(sub(b.o, a.o), sub(d.o, a.o)));
        double J = camera_project(c, a.o, a.d, &x, &y);
        CHECK(t, fabs(J * solid_angle / (h * h) - 1) < 1e-3, "J %g but raster/solid angle %g", J, h * h / solid_angle);
    }
}

static struct camera camera_of(enum camera_kind kind, double lens_radius, double scale, int width, int height)
{
    struct camera c = camera_default();
    transform_look_at(vec(1, 2, 3), vec(0.5, -1, 0), vec(0, 1, 0.2), &c.world_to_camera);
    c.world_to_camera = transform_compose(transform_scale(scale, scale, scale), c.world_to_camera);
    c.kind = kind;
    c.lens_radius = lens_radius;
    c.focal_distance = 5;
    camera_prepare(&c, width, height);
    return c;
}

/* Rays of an orthographic camera are parallel, and a point on one is joined to the camera where the ray begins. */
static void test_orthographic(struct test *t, struct rng *r)
{
    struct camera c = camera_of(CAMERA_ORTHOGRAPHIC, 0, 2.5, 200, 100);
    for (int i = 0; i < 200; i++) {
        struct ray a = camera_ray(&c, 240 * rng_uniform(r) - 20, 100 * rng_uniform(r), 0, 0);
        vec3 p = add(a.o, mul(a.d, 3 + i));
        CHECK(t, length(sub(a.d, c.forward)) < 1e-12 && fabs(dot(sub(a.o, c.position), a.d)) < 1e-9, "direction");
        CHECK(t, length(sub(camera_sample_lens(&c, p, 0.3, 0.7), a.o)) < 1e-9, "the lens point of a point");
    }
    CHECK(t, camera_falloff(&c, 4) == 1, "parallel rays spread");
    /* With a lens, as pbrt-v3 has it: from the lens through the plane of focus, where the screen lies as it is. */
    c = camera_of(CAMERA_ORTHOGRAPHIC, 0.3, 1, 200, 100);
    struct ray a = camera_ray(&c, 200, 0, 0.2, 0.8);
    vec3 o = transform_point(&c.world_to_camera, a.o), d = transform_vector(&c.world_to_camera, a.d);
    vec3 focus = add(o, mul(d, 5 / d.z));
    CHECK(t, fabs(focus.x - 2) < 1e-9 && fabs(focus.y - 1) < 1e-9 && fabs(o.z) < 1e-12 && length(o) <= 0.3,
          "the corner is seen at %g %g", focus.x, focus.y);
}

/* The images of a raster point are the same ray, different, and all that a filter reaches. */
static void test_environment(struct test *t, struct rng *r)
{
    struct camera c = camera_of(CAMERA_ENVIRONMENT, 0, 1, 10, 5);
    struct ray pole = camera_ray(&c, 3, 0, 0, 0), side = camera_ray(&c, 2.5, 2.5, 0, 0);
    vec3 up = transform_vector(&c.world_to_camera, pole.d), z = transform_vector(&c.world_to_camera, side.d);
    CHECK(t, length(sub(up, vec(0, 1, 0))) < 1e-9 && length(sub(z, vec(0, 0, 1))) < 1e-9, "pole and front");
    const double radius[2] = {3, 7};
    for (int i = 0; i < 300; i++) {
        double px = 16 * rng_uniform(r) - 3, py = 19 * rng_uniform(r) - 7, qx, qy;
        struct ray ray = camera_ray(&c, px, py, 0, 0);
        camera_project(&c, ray.o, ray.d, &qx, &qy);
        int found = 0;
        for (int k = 0; k < camera_images(&c, radius); k++) {
            double x = qx, y = qy;
            camera_image(&c, radius, k, &x, &y);
            found += fabs(x - px) < 1e-6 && fabs(y - py) < 1e-6;
            CHECK(t, length(sub(camera_ray(&c, x, y, 0, 0).d, ray.d)) < 1e-9, "image %d is another ray", k);
        }
        CHECK(t, found == 1, "(%g, %g) is among the images of (%g, %g) %d times", px, py, qx, qy, found);
    }
}

/* Rays begin all over the lens: of points on a disk of radius r the mean squared distance from its middle is r^2/2. */
static void test_lens(struct test *t)
{
    enum { N = 64 };
    struct camera c = camera_of(CAMERA_PERSPECTIVE, 0.3, 1, 200, 100);
    double mean = 0;
    for (int i = 0; i < N * N; i++)
        mean += length2(sub(camera_ray(&c, 70, 20, (i % N + 0.5) / N, (i / N + 0.5) / N).o, c.position)) / (N * N);
    CHECK(t, fabs(mean / (0.5 * 0.3 * 0.3) - 1) < 0.01, "lens: the mean squared distance of its points from its middle "
          "is %g, not %g", mean, 0.5 * 0.3 * 0.3);
}

/* Any camera under any transform: before the view, as in "Scale 3 1 1 LookAt ...", and after it. Where it has a screen
 * window pixels are no squares. */
static void test_transformed(struct test *t, struct rng *r)
{
    for (int i = 0; i < 100; i++) {
        struct camera c = camera_of((enum camera_kind)(i % 3), i % 2 * 0.3, 1, 50 + i % 5 * 50, 100);
        c.world_to_camera = transform_compose(random_affine(r), transform_compose(c.world_to_camera, random_affine(r)));
        c.has_screen_window = i % 4 == 1;
        c.screen_window[0] = c.screen_window[2] = -1;
        c.screen_window[1] = 2;
        c.screen_window[3] = 0.5;
        camera_prepare(&c, c.width, 100);
        CHECK(t, camera_is_usable(&c), "camera %d is not usable", i);
        test_inverse(t, &c, r);
        test_jacobian(t, &c, r);
    }
}

void test_camera(struct test *t)
{
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 1, 0);
    test_orthographic(t, &r);
    test_environment(t, &r);
    test_lens(t);
    test_transformed(t, &r);
    /* The field of view is along the shorter side. */
    struct camera c = camera_default();
    c.fov = 60;
    camera_prepare(&c, 200, 100);
    struct ray top = camera_ray(&c, 100, 0, 0, 0), right = camera_ray(&c, 200, 50, 0, 0);
    double edge = atan2(top.d.y, top.d.z);
    CHECK(t, fabs(edge - PI / 6) < 1e-12, "upper edge at %g degrees", edge * 180 / PI);
    CHECK(t, fabs(right.d.x / right.d.z - 2 * tan(PI / 6)) < 1e-12, "right edge at slope %g", right.d.x / right.d.z);
}
