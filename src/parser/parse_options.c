/* parse_options.c: what stands before WorldBegin: camera, film, filter, sampler, integrator. Defaults are pbrt-v3's
 * [PBRT3 perspective.cpp, film.cpp, filters/]. See parse.h. */
#include "parser/parse.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/picture.h"

static const char *const NOTHING[] = {NULL};

/* The resolution may still change, which shifts the scale by a few powers of ten: the limits are far from where numbers
 * end. */
static void check_camera(struct params *q, struct camera c)
{
    camera_prepare(&c, 1, 1);
    if (!q->failed && !camera_is_usable(&c))
        params_fail(q, q->place, "this camera is not usable: its place must be within 1e18, and its view at distance 1 %s",
                    "from 1e-12 to 1e12 wide and high; change transform, field of view or window");
}

bool parse_camera(struct parser *p)
{
    static const char *const KNOWN[] = {"perspective", NULL};
    static const char *const REFUSED[] = {"orthographic", "environment", "realistic", NULL};
    struct params *q = &p->params;
    if (parse_name(p, KNOWN, REFUSED) < 0)
        return false;
    struct camera c = camera_default();
    c.world_to_camera = p->state.ctm;
    c.fov = params_positive(q, "fov", c.fov);
    double half = params_float(q, "halffov", -1);
    if (half > 0)
        c.fov = 2 * half;
    if (!(c.fov < 180))
        params_fail(q, q->place, "a field of view of %g degrees is too wide; it must be less than 180", c.fov);
    c.frame_aspect_ratio = params_positive(q, "frameaspectratio", 0);
    c.lens_radius = params_at_least(q, "lensradius", 0, 0);
    c.focal_distance = params_positive(q, "focaldistance", 1e6);
    int n;
    const struct param *item;
    const double *window = params_list(q, "screenwindow", 1u << PARAM_FLOAT, 1, &n, &item);
    if (window != NULL) {
        if (n != 4 || !(window[0] < window[1] && window[2] < window[3]))
            params_fail(q, item->place, "\"screenwindow\" wants four numbers: xmin < xmax, ymin < ymax");
        c.has_screen_window = true;
        for (int i = 0; i < 4 && !q->failed; i++)
            c.screen_window[i] = window[i];
    }
    params_ignore(q, "shutteropen"); /* nothing moves */
    params_ignore(q, "shutterclose");
    check_camera(q, c);
    p->scene->camera = c;
    return params_done(q);
}

static double fraction(double x) { return clamp(x, 0, 1); }

static void crop_window(struct params *q, double crop[4])
{
    int n;
    const struct param *item;
    const double *x = params_list(q, "cropwindow", 1u << PARAM_FLOAT, 1, &n, &item);
    if (x == NULL)
        return;
    if (n != 4) {
        params_fail(q, item->place, "\"cropwindow\" wants four numbers, x0 x1 y0 y1, not %d", n);
        return;
    }
    crop[0] = fraction(fmin(x[0], x[1]));
    crop[1] = fraction(fmax(x[0], x[1]));
    crop[2] = fraction(fmin(x[2], x[3]));
    crop[3] = fraction(fmax(x[2], x[3]));
    if (!(crop[0] < crop[1] && crop[2] < crop[3]))
        params_fail(q, item->place, "\"cropwindow\" leaves no pixel; give x0 < x1 and y0 < y1 within 0 and 1");
}

bool parse_film(struct parser *p)
{
    static const char *const KNOWN[] = {"image", NULL};
    struct params *q = &p->params;
    struct scene *s = p->scene;
    if (parse_name(p, KNOWN, NOTHING) < 0)
        return false;
    s->width = params_int(q, "xresolution", 1280, 1, 65536);
    s->height = params_int(q, "yresolution", 720, 1, 65536);
    struct error why;
    if (!picture_size_ok((unsigned long)s->width, (unsigned long)s->height, &why))
        params_fail(q, q->place, "%s", why.text);
    static const double WHOLE[4] = {0, 1, 0, 1};
    memcpy(s->crop, WHOLE, sizeof s->crop);
    crop_window(q, s->crop);
    s->film_scale = params_at_least(q, "scale", 1, 0);
    free(s->film_filename);
    const char *name = params_string(q, "filename", NULL);
    s->film_filename = name != NULL ? mem_copy_text(name) : NULL;
    params_ignore(q, "diagonal"); /* for realistic cameras only */
    const struct param *clamped = params_ignore(q, "maxsampleluminance");
    if (clamped != NULL)
        place_warn(
            &p->messages, clamped->place, "maxsampleluminance",
            "\"maxsampleluminance\" is ignored: clamping samples would make the image darker than the truth");
    return params_done(q);
}

bool parse_filter(struct parser *p)
{
    static const char *const KNOWN[] = {"box", "triangle", "gaussian", "mitchell", "sinc", NULL};
    struct params *q = &p->params;
    if (parse_name(p, KNOWN, NOTHING) < 0)
        return false;
    struct filter f;
    filter_default(q->type, &f);
    /* Within these limits the table of a profile (filter.c) is fine enough for it, and its integral is far from 0. */
    f.radius[0] = params_positive(q, "xwidth", f.radius[0]);
    f.radius[1] = params_positive(q, "ywidth", f.radius[1]);
    switch (f.kind) {
    case FILTER_BOX:
    case FILTER_TRIANGLE: break;
    case FILTER_GAUSSIAN: f.alpha = params_range(q, "alpha", f.alpha, 1e-6, 1e3); break;
    case FILTER_MITCHELL:
        f.B = params_range(q, "B", f.B, -100, 100);
        f.C = params_range(q, "C", f.C, -100, 100);
        break;
    case FILTER_SINC: f.tau = params_range(q, "tau", f.tau, 0.1, 1e6); break;
    }
    if (f.radius[0] > 64 || f.radius[1] > 64)
        params_fail(q, q->place, "a filter radius above 64 pixels is too wide; pbrt's own are 0.5 to 4");
    if (f.radius[0] < 1e-3 || f.radius[1] < 1e-3)
        params_fail(q, q->place, "a filter radius below 0.001 pixels is too narrow; pbrt's own are 0.5 to 4");
    p->scene->filter = f;
    return params_done(q);
}

/* Accept a parameter that changes noise or speed, not the image. */
static void no_effect(struct parser *p, const char *name)
{
    const struct param *item = params_ignore(&p->params, name);
    if (item != NULL)
        place_warn(&p->messages, item->place, p->params.directive, "%s \"%s\": \"%s\" has no effect here",
                   p->params.directive, p->params.type, name);
}

bool parse_sampler(struct parser *p)
{
    static const char *const KNOWN[] = {"sobol",      "halton",         "random",     "stratified",
                                        "02sequence", "lowdiscrepancy", "maxmindist", NULL};
    struct params *q = &p->params;
    if (parse_name(p, KNOWN, NOTHING) < 0)
        return false;
    if (strcmp(q->type, "stratified") == 0)
        p->scene->spp = params_int(q, "xsamples", 4, 1, 1 << 15) * params_int(q, "ysamples", 4, 1, 1 << 15);
    else
        p->scene->spp = params_int(q, "pixelsamples", strcmp(q->type, "random") == 0 ? 4 : 16, 1, 1 << 30);
    no_effect(p, "dimensions");
    no_effect(p, "jitter");
    no_effect(p, "samplepixelcenter");
    return params_done(q);
}

bool parse_accelerator(struct parser *p)
{
    static const char *const KNOWN[] = {"kdtree", "bvh", NULL};
    static const char *const NAMES[] = {"splitmethod", "maxnodeprims", "intersectcost", "traversalcost",
                                        "emptybonus",  "maxprims",     "maxdepth",      NULL};
    if (parse_name(p, KNOWN, NOTHING) < 0)
        return false;
    for (int i = 0; NAMES[i] != NULL; i++)
        no_effect(p, NAMES[i]);
    return params_done(&p->params);
}

/* How many digits tell this number from all others. */
static int digits(double x)
{
    char text[40];
    snprintf(text, sizeof text, "%.15g", x);
    return strtod(text, NULL) == x ? 15 : 17;
}

/* The values of a parameter as one text, blanks between them. To be given to free(). */
static char *value_text(const struct params *q, const struct param *item)
{
    size_t size = 1, used = 0;
    for (int i = 0; i < item->n; i++)
        size += 1 + (item->is_text ? strlen(q->string[item->first + (size_t)i]) : 32);
    char *text = mem_alloc(size, 1);
    for (int i = 0; i < item->n; i++) {
        const char *blank = i > 0 ? " " : "";
        size_t k = item->first + (size_t)i;
        int n = item->is_text
                    ? snprintf(text + used, size - used, "%s%s", blank, q->string[k])
                    : snprintf(text + used, size - used, "%s%.*g", blank, digits(q->number[k]), q->number[k]);
        used += (size_t)n;
    }
    return text;
}

/* Which parameters an integrator has is its own affair: all are kept as text with their place. */
bool parse_integrator(struct parser *p)
{
    struct params *q = &p->params;
    struct scene *s = p->scene;
    free(s->integrator);
    s->integrator = mem_copy_text(q->type);
    settings_clear(&s->settings);
    for (int i = 0; i < q->n; i++) {
        char origin[512];
        place_text(q->item[i].place, origin, sizeof origin);
        char *text = value_text(q, &q->item[i]);
        settings_set(&s->settings, q->item[i].name, text, origin);
        free(text);
        q->item[i].used = true;
    }
    return params_done(q);
}
