/* test_camera.c: the perspective camera: projection inverts ray generation, J is the Jacobian of raster over solid
 * angle, and importance integrates as it must. */
#include <math.h>

#include "scene/camera.h"
#include "base/rng.h"
#include "tests.h"

static struct camera make_camera(double lens_radius, double aspect_width)
{
    struct camera c = camera_default();
    transform_look_at(vec(1, 2, 3), vec(0.5, -1, 0), vec(0, 1, 0.2), &c.world_to_camera);
    c.fov = 40;
    c.lens_radius = lens_radius;
    c.focal_distance = 5;
    camera_prepare(&c, (int)(100 * aspect_width), 100);
    return c;
}

static void test_inverse(struct test *t, const struct camera *c, struct rng *r)
{
    double worst = 0;
    for (int i = 0; i < 1000; i++) {
        double px = c->width * rng_uniform(r), py = c->height * rng_uniform(r), qx, qy;
        struct ray ray = camera_ray(c, px, py, rng_uniform(r), rng_uniform(r));
        double J = camera_project(c, ray.o, ray.d, &qx, &qy);
        CHECK(t, J > 0 && fabs(length(ray.d) - 1) < 1e-12, "J = %g, |d| = %.17g", J, length(ray.d));
        worst = fmax(worst, fmax(fabs(px - qx), fabs(py - qy)));
    }
    CHECK(t, worst < 1e-7, "projection is off by %g pixels", worst);
    double px, py;
    CHECK(t, camera_project(c, c->position, neg(c->forward), &px, &py) == 0, "a direction backwards was accepted");
}

/* Solid angle of a small raster square, from the directions of its corners. */
static void test_jacobian(struct test *t, const struct camera *c, struct rng *r)
{
    const double h = 1e-3;
    for (int i = 0; i < 200; i++) {
        double px = c->width * rng_uniform(r), py = c->height * rng_uniform(r);
        double u1 = rng_uniform(r), u2 = rng_uniform(r), x, y;
        struct ray a = camera_ray(c, px, py, u1, u2), b = camera_ray(c, px + h, py, u1, u2);
        struct ray d = camera_ray(c, px, py + h, u1, u2);
        double solid_angle = length(cross(sub(b.d, a.d), sub(d.d, a.d)));
        double J = camera_project(c, a.o, a.d, &x, &y);
        CHECK(t, fabs(J * solid_angle / (h * h) - 1) < 1e-3, "J %g but raster/solid angle %g", J, h * h / solid_angle);
    }
}

void test_camera(struct test *t)
{
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 1, 0);
    for (int lens = 0; lens < 2; lens++)
        for (int wide = 0; wide < 3; wide++) {
            struct camera c = make_camera(lens * 0.3, wide == 0 ? 0.5 : wide);
            test_inverse(t, &c, &r);
            test_jacobian(t, &c, &r);
        }
    /* The field of view is along the shorter side. */
    struct camera c = camera_default();
    c.fov = 60;
    camera_prepare(&c, 200, 100);
    struct ray top = camera_ray(&c, 100, 0, 0, 0), right = camera_ray(&c, 200, 50, 0, 0);
    double edge = atan2(top.d.y, top.d.z);
    CHECK(t, fabs(edge - PI / 6) < 1e-12, "upper edge at %g degrees", edge * 180 / PI);
    CHECK(t, fabs(right.d.x / right.d.z - 2 * tan(PI / 6)) < 1e-12, "right edge at slope %g", right.d.x / right.d.z);
}
