/* camera.c: see camera.h. Framing rules are those of [PBRT3 6.2-6.3]. */
#include "scene/camera.h"

#include "base/maths.h"
#include "base/number.h"
#include "base/warp.h"

struct camera camera_default(void)
{
    struct camera c = {.fov = 90, .focal_distance = 1e6};
    c.world_to_camera = transform_identity();
    return c;
}

void camera_prepare(struct camera *c, int width, int height)
{
    c->width = width;
    c->height = height;
    double aspect = c->frame_aspect_ratio > 0 ? c->frame_aspect_ratio : (double)width / height;
    double x = aspect > 1 ? aspect : 1, y = aspect > 1 ? 1 : 1 / aspect; /* the shorter side spans [-1,1] */
    const double whole[4] = {-x, x, -y, y}, *window = c->has_screen_window ? c->screen_window : whole;
    c->parallel = c->kind == CAMERA_ORTHOGRAPHIC && c->lens_radius == 0;
    /* Screen unit 1 lies at this height at z = 1, of an orthographic camera with a lens in the plane of focus. */
    double half = c->parallel ? 1 : c->kind == CAMERA_ORTHOGRAPHIC ? 1 / c->focal_distance : m_tan(c->fov * PI / 360);
    c->x_scale = (window[1] - window[0]) * half / width;
    c->y_scale = -(window[3] - window[2]) * half / height;
    c->x_origin = window[0] * half;
    c->y_origin = window[3] * half;
    c->camera_to_world = transform_inverse(c->world_to_camera);
    c->position = transform_point(&c->camera_to_world, vec(0, 0, 0));
    c->forward = normalize(transform_vector(&c->camera_to_world, vec(0, 0, 1)));
    if (c->kind == CAMERA_ENVIRONMENT) {
        c->x_scale = 2 * PI / width;
        c->y_scale = PI / height;
        c->x_origin = c->y_origin = 0;
    }
    c->pixel_volume = fabs(c->x_scale * c->y_scale * transform_determinant(&c->camera_to_world));
}

bool camera_is_usable(const struct camera *c)
{
    const double least = 1e-12, most = 1e12; /* of the screen at distance 1; the film has at most 65536 pixels a side */
    double w = fabs(c->x_scale) * c->width, h = fabs(c->y_scale) * c->height;
    return w >= least && w <= most && h >= least && h <= most && fabs(c->x_origin) <= most &&
           fabs(c->y_origin) <= most && c->pixel_volume > 0 && is_place(camera_ray(c, 0, 0, 0, 0).o) &&
           is_place(camera_ray(c, c->width, c->height, 0, 0).o) && is_place(c->position) &&
           fabs(length2(c->forward) - 1) < 1e-6 &&
           is_place(transform_point(&c->camera_to_world, vec(c->lens_radius, 0, 0))) &&
           is_place(transform_point(&c->camera_to_world, vec(0, c->lens_radius, 0)));
}

static vec3 lens_point(const struct camera *c, double u1, double u2)
{
    double x = 0, y = 0;
    if (c->lens_radius > 0)
        warp_disk(u1, u2, &x, &y);
    return vec(x * c->lens_radius, y * c->lens_radius, 0);
}

vec3 camera_sample_lens(const struct camera *c, vec3 p, double u1, double u2)
{
    if (c->parallel) {
        vec3 at = transform_point(&c->world_to_camera, p);
        return transform_point(&c->camera_to_world, vec(at.x, at.y, 0));
    }
    return c->lens_radius > 0 ? transform_point(&c->camera_to_world, lens_point(c, u1, u2)) : c->position;
}

/* Camera-space direction of the angles theta from +y and phi from x to z. */
static vec3 around(double theta, double phi)
{
    return vec(m_sin(theta) * m_cos(phi), m_cos(theta), m_sin(theta) * m_sin(phi));
}

struct ray camera_ray(const struct camera *c, double px, double py, double u1, double u2)
{
    vec3 on_screen = vec(c->x_origin + px * c->x_scale, c->y_origin + py * c->y_scale, 1);
    vec3 lens = vec(0, 0, 0);
    if (c->kind == CAMERA_ENVIRONMENT) {
        on_screen = around(py * c->y_scale, px * c->x_scale);
    } else if (c->parallel) {
        lens = vec(on_screen.x, on_screen.y, 0);
        on_screen = vec(0, 0, 1);
    } else if (c->lens_radius > 0) {
        /* All lens points see the same point of the plane of focus. */
        lens = lens_point(c, u1, u2);
        on_screen = sub(mul(on_screen, c->focal_distance), lens);
    }
    const struct transform *m = &c->camera_to_world;
    return (struct ray){transform_point(m, lens), normalize(transform_vector(m, on_screen)), 0, INFINITY, 0, 0};
}

/* J as below, over a piece of the unit sphere of camera space, which shrinks with sin theta towards the pole; at the
 * very pole, which no direction is, J stays finite. */
static double project_around(const struct camera *c, vec3 d, double *px, double *py)
{
    double phi = m_atan2(d.z, d.x), d2 = length2(d), ring = sqrt(sqr(d.x) + sqr(d.z)); /* |d| sin theta */
    *px = (phi < 0 ? phi + 2 * PI : phi) / c->x_scale;
    *py = m_atan2(ring, d.y) / c->y_scale;
    return 1 / (c->pixel_volume * d2 * fmax(ring, 1e-9 * sqrt(d2)));
}

double camera_project(const struct camera *c, vec3 lens, vec3 w, double *px, double *py)
{
    vec3 d = transform_vector(&c->world_to_camera, w);
    if (c->kind == CAMERA_ENVIRONMENT)
        return project_around(c, d, px, py);
    if (!(d.z > 0))
        return 0;
    if (c->parallel) {
        vec3 l = transform_point(&c->world_to_camera, lens);
        *px = (l.x - c->x_origin) / c->x_scale;
        *py = (l.y - c->y_origin) / c->y_scale;
        return 1 / (c->pixel_volume * d.z);
    }
    vec3 at = vec(d.x / d.z, d.y / d.z, 1); /* where the parallel ray through the lens centre meets z = 1 */
    if (c->lens_radius > 0) {
        vec3 l = transform_point(&c->world_to_camera, lens);
        at.x += l.x / c->focal_distance;
        at.y += l.y / c->focal_distance;
    }
    *px = (at.x - c->x_origin) / c->x_scale;
    *py = (at.y - c->y_origin) / c->y_scale;
    /* The pyramid over a raster unit at z = 1 has a volume of pixel_volume / 3 in the world and is 1 / d.z long, so a
     * raster unit covers pixel_volume d.z^3 steradians: cos^3 of [PBRT3 16.1.1] under any transform. The plane of focus
     * is the image plane scaled about the lens, so a lens does not change J. */
    return 1 / (c->pixel_volume * d.z * d.z * d.z);
}

/* How many times a filter of this radius may go round a raster of this size. */
static int times_round(double radius, int size) { return int_within(ceil(radius / size), 1, 64); }

int camera_images(const struct camera *c, const double radius[2])
{
    if (c->kind != CAMERA_ENVIRONMENT)
        return 1;
    return (2 * times_round(radius[0], c->width) + 3) * (2 * times_round(radius[1], c->height) + 1);
}

/* Over a pole, the angle from it grows again on the other side. */
void camera_image(const struct camera *c, const double radius[2], int i, double *px, double *py)
{
    if (c->kind != CAMERA_ENVIRONMENT)
        return;
    int across = 2 * times_round(radius[0], c->width) + 3;
    int row = i / across - times_round(radius[1], c->height), column = i % across - across / 2;
    bool odd = row % 2 != 0;
    *px += (column + (odd ? 0.5 : 0)) * c->width;
    *py = odd ? (row + 1.0) * c->height - *py : *py + (double)row * c->height;
}
