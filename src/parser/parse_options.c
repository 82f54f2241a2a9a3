/* parse_options.c: what stands before WorldBegin: camera, film, filter, sampler, integrator. Defaults are pbrt-v3's
 * [pbrt-v3 cameras/, core/film.cpp, filters/]. See parse.h. */
#include "parser/parse.h"

#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/picture.h"

/* Which camera it is, and its screen. The resolution may still change, which shifts the scale by a few powers of ten;
 * the limits of a usable camera are far from where numbers end. */
static void framing(struct parser *p, void *object)
{
    struct params *q = &p->params;
    struct camera *c = object;
    double *w = c->screen_window;
    c->kind = (enum camera_kind)p->type->kind;
    c->has_screen_window = c->kind != CAMERA_ENVIRONMENT && params_numbers(q, "screenwindow", w, 4);
    if (c->has_screen_window && !(w[0] < w[1] && w[2] < w[3]))
        type_error(q, "\"screenwindow\" wants four numbers: xmin < xmax, ymin < ymax");
    struct camera prepared = *c;
    camera_prepare(&prepared, 1, 1);
    if (!camera_is_usable(&prepared))
        type_error(q, "this camera is not usable: its place must be within 1e12, and its view at distance 1 "
                   "from 1e-12 to 1e12 wide and high; change transform, field of view or window");
}

static void half_fov(struct parser *p, const struct parameter *row, void *field)
{
    double half = params_number(&p->params, row->name, -1, row->low, row->high);
    if (half > 0)
        *(double *)field = 2 * half;
}

#define CAMERA(name, f, value, range) {name, parse_number, offsetof(struct camera, f), GREY(value), range}

#define SHUTTER IGNORED("shutteropen"), IGNORED("shutterclose") /* nothing moves */
#define SCREEN                                                                                            \
    CAMERA("frameaspectratio", frame_aspect_ratio, 0, POSITIVE), CAMERA("lensradius", lens_radius, 0, AT_LEAST_0), \
        CAMERA("focaldistance", focal_distance, 1e6, POSITIVE), BY_BUILD("screenwindow"), SHUTTER

static const struct parameter PERSPECTIVE[] = {
    CAMERA("fov", fov, KEPT, FIELD_OF_VIEW),
    {"halffov", half_fov, offsetof(struct camera, fov), GREY(0), -NUMBER_MAX, 89.9995},
    SCREEN, END_OF_PARAMETERS};
static const struct parameter ORTHOGRAPHIC[] = {SCREEN, END_OF_PARAMETERS};
static const struct parameter ENVIRONMENT[] = {
    IGNORED("frameaspectratio"), IGNORED("lensradius"), IGNORED("focaldistance"), IGNORED("screenwindow"), SHUTTER,
    END_OF_PARAMETERS};

static const struct object_type CAMERA_TYPES[] = {
    {"perspective", PERSPECTIVE, CAMERA_PERSPECTIVE, framing},
    {"orthographic", ORTHOGRAPHIC, CAMERA_ORTHOGRAPHIC, framing},
    {"environment", ENVIRONMENT, CAMERA_ENVIRONMENT, framing},
    END_OF_TYPES};

static bool camera(struct parser *p)
{
    struct camera c = camera_default();
    c.world_to_camera = p->place.ctm;
    if (!parse_placed(p) || !parse_object(p, &c))
        return false;
    p->scene->camera = c;
    parse_name_system(p, "camera", transform_inverse(p->place.ctm));
    return true;
}

static double fraction(double x) { return clamp(x, 0, 1); }

static void crop_window(struct params *q, double crop[4])
{
    double x[4] = {0, 1, 0, 1};
    params_numbers(q, "cropwindow", x, 4);
    crop[0] = fraction(fmin(x[0], x[1]));
    crop[1] = fraction(fmax(x[0], x[1]));
    crop[2] = fraction(fmin(x[2], x[3]));
    crop[3] = fraction(fmax(x[2], x[3]));
    if (!(crop[0] < crop[1] && crop[2] < crop[3]))
        type_error(q, "\"cropwindow\" leaves no pixel; give x0 < x1 and y0 < y1 within 0 and 1");
}

static void image_film(struct parser *p, void *object)
{
    struct params *q = &p->params;
    struct scene *s = object;
    struct error why;
    if (!picture_size_ok((uint64_t)s->width, (uint64_t)s->height, &why))
        type_error(q, "%s", why.text);
    crop_window(q, s->crop);
    free(s->film_filename);
    struct source_position at;
    const char *name = params_text(q, "filename", PARAM_STRING, &at);
    s->film_filename = name != NULL && name[0] != '\0' ? mem_copy_text(name) : NULL;
}

#define SCENE(name, read, f, value, range) {name, read, offsetof(struct scene, f), GREY(value), range}
#define PIXELS 1, 65536

static const struct parameter IMAGE_FILM[] = {
    SCENE("xresolution", parse_integer, width, 1280, PIXELS),
    SCENE("yresolution", parse_integer, height, 720, PIXELS),
    SCENE("scale", parse_number, film_scale, 1, AT_LEAST_0),
    BY_BUILD("cropwindow"),
    BY_BUILD("filename"),
    IGNORED("diagonal"), /* for realistic cameras only */
    END_OF_PARAMETERS};

static const struct object_type FILM_TYPES[] = {{"image", IMAGE_FILM, 0, image_film}, END_OF_TYPES};

/* Within these limits the table of a profile (filter.c) is fine enough for it, and its integral is far from 0. */
#define FILTER(name, f, low, high) {name, parse_number, offsetof(struct filter, f), GREY(KEPT), low, high}
#define RADII FILTER("xwidth", radius[0], 1e-3, 64), FILTER("ywidth", radius[1], 1e-3, 64)

static const struct parameter BOX[] = {RADII, END_OF_PARAMETERS};
static const struct parameter GAUSSIAN[] = {RADII, FILTER("alpha", alpha, 1e-6, 1e3), END_OF_PARAMETERS};
static const struct parameter MITCHELL[] = {
    RADII, FILTER("B", B, -100, 100), FILTER("C", C, -100, 100), END_OF_PARAMETERS};
static const struct parameter SINC[] = {RADII, FILTER("tau", tau, 0.1, 1e6), END_OF_PARAMETERS};

static const struct object_type FILTER_TYPES[] = {
    {"box", BOX, FILTER_BOX, NULL},
    {"triangle", BOX, FILTER_TRIANGLE, NULL},
    {"gaussian", GAUSSIAN, FILTER_GAUSSIAN, NULL},
    {"mitchell", MITCHELL, FILTER_MITCHELL, NULL},
    {"sinc", SINC, FILTER_SINC, NULL},
    END_OF_TYPES};

static bool filter(struct parser *p)
{
    filter_default(p->params.type, &p->scene->filter);
    return parse_object(p, &p->scene->filter);
}

static void stratified(struct parser *p, void *object)
{
    struct scene *s = object;
    s->spp = params_int(&p->params, "xsamples", 4, 1, 1 << 15) * params_int(&p->params, "ysamples", 4, 1, 1 << 15);
}

#define SAMPLES(value) {"pixelsamples", parse_integer, offsetof(struct scene, spp), GREY(value), 1, 1 << 30}

static const struct parameter RANDOM[] = {SAMPLES(4), END_OF_PARAMETERS};
static const struct parameter STRATIFIED[] = {BY_BUILD("xsamples"), BY_BUILD("ysamples"), END_OF_PARAMETERS};
static const struct parameter SEQUENCE[] = {SAMPLES(16), END_OF_PARAMETERS};

static const struct object_type SAMPLER_TYPES[] = {
    {"sobol", SEQUENCE, 0, NULL},
    {"halton", SEQUENCE, 0, NULL},
    {"random", RANDOM, 0, NULL},
    {"stratified", STRATIFIED, 0, stratified},
    {"02sequence", SEQUENCE, 0, NULL},
    {"lowdiscrepancy", SEQUENCE, 0, NULL},
    {"maxmindist", SEQUENCE, 0, NULL},
    END_OF_TYPES};

/* Film and sampler are fields of the scene itself. */
static bool of_scene(struct parser *p) { return parse_object(p, p->scene); }

/* Which parameters an integrator has is its own affair: the first value of each is kept as text, with its position;
 * none has several. */
static bool integrator(struct parser *p)
{
    if (!parse_typed(p))
        return false;
    struct params *q = &p->params;
    struct scene *s = p->scene;
    free(s->integrator);
    s->integrator = mem_copy_text(q->type);
    settings_clear(&s->settings);
    for (struct param *item = q->item; item < q->item + q->n; item++) {
        char origin[512], number[32] = "";
        source_position_text(item->position, origin, sizeof origin);
        if (item->n > 0 && !item->is_text)
            snprintf(number, sizeof number, "%.15g", item->number[0]); /* what was written, if it had no more digits */
        settings_declare(&s->settings, item->name, item->is_text ? item->text[0] : number, origin,
                         params_type_name(item->type), item->n);
    }
    return true;
}

const struct directive OPTION_DIRECTIVES[] = {{"Camera", BEFORE_WORLD, camera, CAMERA_TYPES},
                                              {"Film", BEFORE_WORLD, of_scene, FILM_TYPES},
                                              {"PixelFilter", BEFORE_WORLD, filter, FILTER_TYPES},
                                              {"Sampler", BEFORE_WORLD, of_scene, SAMPLER_TYPES},
                                              {"Accelerator", BEFORE_WORLD, parse_typed, NULL},
                                              {"Integrator", BEFORE_WORLD, integrator, NULL},
                                              END_OF_DIRECTIVES};
