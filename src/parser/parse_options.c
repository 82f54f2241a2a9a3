/* parse_options.c: the directives before WorldBegin: camera, film, filter, sampler, integrator. Defaults are pbrt-v3's
 * [pbrt-v3 cameras/, core/film.cpp, filters/]. See parse.h. */
#include "parser/parse.h"

#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/image.h"

/* Which camera it is, and its screen. The resolution may still change, which shifts the scale by a few powers of ten;
 * the limits of a usable camera are far from where numbers end. */
static void framing(struct parser *p, void *object)
{
    struct params *q = &p->params;
    struct camera *c = object;
    double *w = c->screen_window;
    c->kind = (enum camera_kind)p->type.kind;
    double half = c->kind == CAMERA_PERSPECTIVE ? params_number(q, "halffov", -1, -NUMBER_MAX, 89.9995) : -1;
    if (half > 0)
        c->fov = 2 * half;
    if (c->kind == CAMERA_PERSPECTIVE && c->fov < 1 && c->fov > 0.1) /* nobody means 0.1 radians, 6 degrees */
        source_warn(&p->messages, q->position, "a field of view of %g degrees is hardly more than a point; if these "
                    "are radians, write \"float fov\" %g", c->fov, c->fov * 180 / PI);
    c->has_screen_window = c->kind != CAMERA_ENVIRONMENT && params_numbers(q, "screenwindow", w, 4);
    if (c->has_screen_window && !(w[0] < w[1] && w[2] < w[3]))
        type_error(q, "\"screenwindow\" wants four numbers: xmin < xmax, ymin < ymax");
    struct camera prepared = *c;
    camera_prepare(&prepared, 1, 1);
    if (!camera_is_usable(&prepared))
        type_error(q, "this camera is not usable: its place must be within 1e12, and its view at distance 1 "
                   "from 1e-12 to 1e12 wide and high; change transform, field of view or window");
}

#define AT(member) offsetof(struct camera, member)
/* Nothing moves here, so that of the shutter its opening alone matters. */
static const struct field PERSPECTIVE[] = {
    {"fov", FIELD_NUMBER, AT(fov), FIELD_KEPT, NUMBER_MIN, .high = 179.999},
    {.name = "halffov"},
    {"frameaspectratio", FIELD_NUMBER, AT(frame_aspect_ratio), 0, NUMBER_MIN, .high = NUMBER_MAX},
    {"lensradius", FIELD_NUMBER, AT(lens_radius), 0, 0, .high = NUMBER_MAX},
    {"focaldistance", FIELD_NUMBER, AT(focal_distance), 1e6, NUMBER_MIN, .high = NUMBER_MAX},
    {.name = "screenwindow"},
    {.name = "shutteropen"}, {"shutterclose", .kind = FIELD_IGNORED}, {.name = NULL}};
static const struct field ENVIRONMENT[] = {
    {"frameaspectratio", .kind = FIELD_IGNORED}, {"lensradius", .kind = FIELD_IGNORED},
    {"focaldistance", .kind = FIELD_IGNORED}, {"screenwindow", .kind = FIELD_IGNORED},
    {.name = "shutteropen"}, {"shutterclose", .kind = FIELD_IGNORED}, {.name = NULL}};
#undef AT

static const struct object_type CAMERA_TYPES[] = {
    {"perspective", PERSPECTIVE, CAMERA_PERSPECTIVE, framing},
    {"orthographic", PERSPECTIVE + 2, CAMERA_ORTHOGRAPHIC, framing}, /* all but the two of the angle */
    {"environment", ENVIRONMENT, CAMERA_ENVIRONMENT, framing}, {.name = NULL}};

static bool camera(struct parser *p)
{
    struct camera c = camera_default();
    parse_open_shutter(p, params_number(&p->params, "shutteropen", 0, -NUMBER_MAX, NUMBER_MAX));
    c.world_to_camera = p->place.ctm;
    if (!parse_placed(p) || !parse_object(p, &c))
        return false;
    p->scene->camera = c;
    p->has_camera = true;
    p->moved.position.file = NULL;
    const struct transform to_world[2] = {transform_inverse(p->place.at[0]), transform_inverse(p->place.at[1])};
    parse_name_system(p, "camera", to_world);
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

#define AT(member) offsetof(struct scene, member)
static const struct field IMAGE_FILM[] = {
    {"xresolution", FIELD_INTEGER, AT(width), 1280, 1, .high = 65536},
    {"yresolution", FIELD_INTEGER, AT(height), 720, 1, .high = 65536},
    {"scale", FIELD_NUMBER, AT(film_scale), 1, 0, .high = NUMBER_MAX},
    {.name = "cropwindow"}, {.name = "filename"},
    {"diagonal", .kind = FIELD_IGNORED}, /* for realistic cameras only */
    {.name = NULL}};

static const struct object_type FILM_TYPES[] = {{"image", IMAGE_FILM, 0, image_film}, {.name = NULL}};

/* Within these limits the table of a profile (filter.c) is fine enough for it, and its integral is far from 0. */
#define OF(member) offsetof(struct filter, member)
#define WIDTHS {"xwidth", FIELD_NUMBER, OF(radius[0]), FIELD_KEPT, 1e-3, .high = 64}, \
    {"ywidth", FIELD_NUMBER, OF(radius[1]), FIELD_KEPT, 1e-3, .high = 64}
static const struct field BOX[] = {WIDTHS, {.name = NULL}};
static const struct field GAUSSIAN[] = {WIDTHS, {"alpha", FIELD_NUMBER, OF(alpha), FIELD_KEPT, 1e-6, .high = 1e3},
                                        {.name = NULL}};
static const struct field MITCHELL[] = {WIDTHS, {"B", FIELD_NUMBER, OF(B), FIELD_KEPT, -100, .high = 100},
                                        {"C", FIELD_NUMBER, OF(C), FIELD_KEPT, -100, .high = 100}, {.name = NULL}};
static const struct field SINC[] = {WIDTHS, {"tau", FIELD_NUMBER, OF(tau), FIELD_KEPT, 0.7, .high = 1e6},
                                    {.name = NULL}};

static const struct object_type FILTER_TYPES[] = {
    {"box", BOX, FILTER_BOX, NULL},
    {"triangle", BOX, FILTER_TRIANGLE, NULL},
    {"gaussian", GAUSSIAN, FILTER_GAUSSIAN, NULL},
    {"mitchell", MITCHELL, FILTER_MITCHELL, NULL},
    {"sinc", SINC, FILTER_SINC, NULL}, {.name = NULL}};

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

static const struct field RANDOM[] = {{"pixelsamples", FIELD_INTEGER, AT(spp), 4, 1, .high = 1 << 30}, {.name = NULL}};
static const struct field SEQUENCE[] = {{"pixelsamples", FIELD_INTEGER, AT(spp), 16, 1, .high = 1 << 30},
                                        {.name = NULL}};
static const struct field STRATIFIED[] = {
    {.name = "xsamples"}, {.name = "ysamples"}, {.name = NULL}};

static const struct object_type SAMPLER_TYPES[] = {
    {"sobol", SEQUENCE, 0, NULL},
    {"halton", SEQUENCE, 0, NULL},
    {"random", RANDOM, 0, NULL},
    {"stratified", STRATIFIED, 0, stratified},
    {"02sequence", SEQUENCE, 0, NULL},
    {"lowdiscrepancy", SEQUENCE, 0, NULL},
    {"maxmindist", SEQUENCE, 0, NULL}, {.name = NULL}};

/* Film and sampler are fields of the scene itself. */
static bool of_scene(struct parser *p) { return parse_object(p, p->scene); }

/* Which parameters an integrator has is its own affair: the first value of each is kept with its position; none has
 * several. */
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
        char origin[512];
        snprintf(origin, sizeof origin, "%s:%d:%d", item->position.file->path, item->position.line,
                 item->position.column);
        if (item->n > 0 && !item->is_text)
            settings_set_number(&s->settings, item->name, item->number[0], origin);
        else
            settings_set(&s->settings, item->name, item->n > 0 ? item->text[0] : "", origin);
    }
    return true;
}

const struct directive OPTION_DIRECTIVES[] = {{"Camera", BEFORE_WORLD, camera, CAMERA_TYPES},
                                              {"Film", BEFORE_WORLD, of_scene, FILM_TYPES},
                                              {"PixelFilter", BEFORE_WORLD, filter, FILTER_TYPES},
                                              {"Sampler", BEFORE_WORLD, of_scene, SAMPLER_TYPES},
                                              {"Accelerator", BEFORE_WORLD, parse_typed, NULL},
                                              {"Integrator", BEFORE_WORLD, integrator, NULL}, {.name = NULL}};
