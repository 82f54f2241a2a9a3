/* job.c: see job.h. */
#include "render/job.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/near.h"
#include "base/number.h"
#include "base/os.h"
#include "integrators/race.h"
#include "parser/parser.h"

/* --- methods ------------------------------------------------------------------------------------------ */

/* The rows of a name, which are neighbours: the first, and how many. */
static const struct method *const *rows_of(const char *name, int *n)
{
    const struct method *const *first = method_rows;
    name = strcmp(name, "path") == 0 ? "pt" : name;
    while (*first != NULL && strcmp((*first)->name, name) != 0)
        first++;
    for (*n = 0; first[*n] != NULL && strcmp(first[*n]->name, name) == 0;)
        ++*n;
    return first;
}

static struct near near_method(const char *wanted)
{
    struct near near = near_start(wanted);
    for (const struct method *const *m = method_rows; *m != NULL; m++)
        near_try(&near, (*m)->name);
    return near;
}

static void say_unknown(const char *wanted, struct error *err)
{
    char known[256] = "";
    const char *before = "", *elsewhere = "";
    for (const struct method *const *m = method_rows; *m != NULL; before = (*m++)->name)
        if (strcmp((*m)->name, before) != 0)
            snprintf(known + strlen(known), sizeof known - strlen(known), " %s", (*m)->name);
    for (const char *const *name = method_elsewhere; *name != NULL; name++)
        if (strcmp(*name, wanted) == 0)
            elsewhere = "; asbdpt-lab has it";
    error_usage(err, "there is no integrator %s; known are:%s%s", wanted, known,
                elsewhere[0] != '\0' ? elsewhere : near_method(wanted).text);
}

const struct method *method_find(const char *name, const struct settings *s, struct error *err)
{
    enum { MOST = 16 };
    const char *words[MOST + 1] = {NULL};
    int n, which = 0;
    const struct method *const *row = rows_of(name, &n);
    if (n == 0)
        say_unknown(name, err);
    for (int i = 0; i < n && i < MOST; i++)
        words[i] = row[i]->select;
    return n > 0 && (words[0] == NULL || settings_choice(s, "select", 0, words, &which, err)) ? row[which] : NULL;
}

/* --- settings ----------------------------------------------------------------------------------------- */

/* What all integrators have. */
struct common {
    int max_depth, strategy;
    double rr_threshold;
};
enum { DEFAULT_MAX_DEPTH = 5 }; /* pbrt-v3's */
const char *const LIGHT_STRATEGIES[] = {"spatial", "power", "uniform", NULL};

#define AT(member) offsetof(struct common, member)
static const struct field COMMON[] = {
    {"maxdepth", FIELD_INTEGER, AT(max_depth), DEFAULT_MAX_DEPTH, 0, PATH_MAX_DEPTH,
     "longest path, in edges minus one", NULL},
    {"rrthreshold", FIELD_NUMBER, AT(rr_threshold), DEFAULT_RR_THRESHOLD, 0, 1e6,
     "relative throughput below which Russian roulette begins, 0: never; for bins 0", NULL},
    {"lightsamplestrategy", FIELD_WORD, AT(strategy), 0, 0, 0,
     "how lights are chosen: by power or uniformly; spatial: s = 1 by what a region sees, if guide is on",
     LIGHT_STRATEGIES},
    {.name = NULL}};

const struct field *job_common(void) { return COMMON; }

/* The first of these methods that has such a parameter, or NULL. */
static const struct method *owner(const struct method *const *m, const char *name)
{
    bool common = field_find(COMMON, name) != NULL;
    while (*m != NULL && !common && method_has(*m, name) == NULL)
        m++;
    return *m;
}

/* Returns true. */
static bool warn(const struct message_sink *sink, const struct setting *item, const char *text)
{
    struct error line;
    error_set(&line, "%s: \"%s\" %s", item->origin, item->name, text);
    if (sink != NULL)
        sink->hear(sink->context, false, line.text);
    return true;
}

/* pbrt-v3 has no longest path. */
static void adapt(struct settings *s, const struct setting *item, const struct message_sink *sink)
{
    char text[96], most[32];
    snprintf(most, sizeof most, "%d", PATH_MAX_DEPTH);
    snprintf(text, sizeof text, "is %.20s, which counts as %s", item->value, most);
    bool deep = strcmp(item->name, "maxdepth") == 0 && setting_is_of_file(item) && item->number > PATH_MAX_DEPTH;
    if (deep && warn(sink, item, text))
        settings_set(s, item->name, most, item->origin);
}

/* Is it one of the integrator that the file names? There it is right: --integrator may have replaced that, or -P its
 * selection. */
static bool belongs_to_file(const struct scene *scene, const struct setting *item)
{
    for (const struct method *const *m = method_rows; scene->integrator != NULL && *m != NULL; m++)
        if (strcmp((*m)->name, scene->integrator) == 0 && method_has(*m, item->name) != NULL)
            return true;
    return false;
}

/* "asbdpt", or "asbdpt with select=bins" where a name has several rows, which `select` itself belongs to alike. */
static void name_method(const struct method *m, const char *parameter, char *out, size_t size)
{
    bool row = m->select != NULL && strcmp(parameter, "select") != 0;
    snprintf(out, size, row ? "%s with select=%s" : "%s", m->name, m->select);
}

static void try_fields(struct near *near, const struct field *f)
{
    for (; f != NULL && f->name != NULL; f++)
        near_try(near, f->name);
}

/* The parameter that was meant, of the method that would read it before others. */
static struct near near_parameter(const char *name, const struct method *reader)
{
    struct near near = near_of(name, (const char *const[]){"select", NULL});
    try_fields(&near, COMMON);
    try_fields(&near, reader->parameters);
    try_fields(&near, reader->own);
    for (const struct method *const *m = method_rows; *m != NULL; m++) {
        try_fields(&near, (*m)->parameters);
        try_fields(&near, (*m)->own);
    }
    return near;
}

/* Of -P, a parameter of `has`, or, if that is NULL, of nobody. Returns false. */
static bool refuse(const struct setting *item, const struct method *has, const struct method *reader, struct error *err)
{
    char whose[64], here[64];
    struct near near = near_parameter(item->name, reader);
    if (has == NULL)
        return error_usage(err, "%s: no integrator has a parameter \"%s\"%s asbdpt help integrators lists them",
                           item->origin, item->name, near.name != NULL ? near.text : ";");
    name_method(has, item->name, whose, sizeof whose);
    name_method(reader, item->name, here, sizeof here);
    return error_usage(err, "-P: \"%s\" is a parameter of %s, not of %s; see --integrator", item->name, whose, here);
}

bool job_adapt(struct scene *scene, const struct method *const *readers, const struct message_sink *sink,
               struct error *err)
{
    struct settings *all = &scene->settings;
    for (int i = 0; i < all->n;) {
        const struct setting *item = &all->item[i];
        const struct method *has = owner(method_rows, item->name);
        char text[160];
        if (has != NULL)
            snprintf(text, sizeof text, "is not used: it is a parameter of %s", has->name);
        else
            snprintf(text, sizeof text, "is not used: no integrator here has such a parameter%s",
                     near_parameter(item->name, readers[0]).text);
        if (owner(readers, item->name) != NULL || (setting_is_of_file(item) && belongs_to_file(scene, item)))
            adapt(all, &all->item[i++], sink);
        else if (!setting_is_of_file(item))
            return refuse(item, has, readers[0], err);
        else if (warn(sink, item, text))
            settings_remove(all, i);
    }
    return true;
}

/* --- jobs --------------------------------------------------------------------------------------------- */

/* Fractions lie within [0,1]: readers of scenes and options see to it. Products are floats, as pbrt's. */
struct pixel_rect render_crop(const struct scene *scene)
{
    const double *c = scene->crop;
    float x0 = (float)scene->width * (float)c[0], x1 = (float)scene->width * (float)c[1];
    float y0 = (float)scene->height * (float)c[2], y1 = (float)scene->height * (float)c[3];
    return (struct pixel_rect){(int)ceil(x0), (int)ceil(y0), (int)ceil(x1), (int)ceil(y1)};
}

bool job_settle(struct render_job *job, const struct scene *scene, struct prepared *out, struct error *err)
{
    const struct method *m = job->integrator;
    const struct settings *s = &scene->settings;
    struct common c;
    if (!settings_fields(s, COMMON, &c, err) || !method_read(m, scene, out, err))
        return false;
    job->scene = scene;
    job->film_rect = render_crop(scene);
    job->planned = job->planned > 0 ? job->planned : job->end;
    job->n_threads = job->n_threads > 0 ? job->n_threads : os_cores();
    job->max_depth = job->max_depth > 0 ? job->max_depth : c.max_depth;
    job->eye_seed = job->seed;
    job->strategy = (enum light_strategy)c.strategy;
    job->rr_threshold = settings_find(s, "rrthreshold") != NULL ? c.rr_threshold : m->rr_threshold;
    return true;
}

void job_prepare(struct render_job *job, struct prepared *p)
{
    if (job->strategy == LIGHTS_UNIFORM)
        job->scene = p->uniform = scene_uniform(job->scene);
    method_prepare(job, p);
}

/* --- loading ------------------------------------------------------------------------------------------ */

/* Who hears of what is wrong with a scene. */
struct loading {
    const struct render_job *job;
    struct scene *scene; /* whose warnings are counted */
};

static void hear(void *context, bool is_error, const char *text)
{
    struct loading *l = context;
    l->scene->n_warnings += !is_error;
    if (l->job->sink.hear != NULL)
        l->job->sink.hear(l->job->sink.context, is_error, text);
    else
        say_line("asbdpt: %s%s", is_error || l->job->strict ? "" : "warning: ", text);
}

/* A warning about the scene as a whole. */
static void warn_of_scene(struct loading *l, const char *format, ...)
{
    char text[ERROR_TEXT_SIZE / 2];
    struct error line;
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    error_set(&line, "%s: %s", l->job->scene_path, text);
    hear(l, false, line.text);
}

/* Put what is asked in the place of what the scene says. */
static bool apply(const struct render_job *q, struct scene *scene, struct error *err)
{
    const struct settings *given = &q->overrides;
    if (q->res[0] > 0) {
        struct error why;
        scene_resize(scene, q->res[0], q->res[1]);
        if (!picture_size_ok((uint64_t)scene->width, (uint64_t)scene->height, &why))
            return error_usage(err, "--res: %s", why.text);
    } else if (q->quick) {
        scene->width = scene->width > 4 ? scene->width / 4 : 1;
        scene->height = scene->height > 4 ? scene->height / 4 : 1;
    }
    if (q->filter != NULL)
        filter_default(q->filter, &scene->filter);
    for (int i = 0; i < given->n; i++)
        settings_set(&scene->settings, given->item[i].name, given->item[i].value, given->item[i].origin);
    if (q->max_depth > 0) /* for who lists them; the job has the number */
        settings_set_number(&scene->settings, "maxdepth", q->max_depth, "-P");
    if (q->crop[1] > 0)
        memcpy(scene->crop, q->crop, sizeof scene->crop);
    struct pixel_rect crop = render_crop(scene);
    if (rect_width(crop) < 1 || rect_height(crop) < 1)
        return q->crop[1] > 0 ? error_usage(err, "--cropwindow holds no pixel")
                               : error_set(err, "the crop window holds no pixel");
    return true;
}

/* The row asked for; pbrt's integrators that do not exist here are replaced by the default. */
static const struct method *choose_method(struct loading *l, struct error *err)
{
    const struct scene *scene = l->scene;
    const char *usual = "bdpt", *name = scene->integrator != NULL ? scene->integrator : usual;
    int n;
    if (l->job->integrator_name == NULL && (rows_of(name, &n), n == 0)) {
        warn_of_scene(l, "integrator \"%s\" does not exist here; bdpt is used, which computes all light up to "
                      "maxdepth%s", name, near_method(name).text);
        name = usual;
    }
    return method_find(l->job->integrator_name != NULL ? l->job->integrator_name : name, &scene->settings, err);
}

bool job_open(struct render_job *job, struct scene *scene, struct error *err)
{
    struct loading l = {job, scene};
    const struct message_sink sink = {hear, &l};
    const struct parse_options options = {job->integrator_name, 1e9 * job->max_memory, job->scene_text, job->scene_length};
    err->text[0] = '\0';
    if (!parse_scene(job->scene_path, &options, scene, &sink, NULL))
        return false;
    if (apply(job, scene, err) && (job->integrator = choose_method(&l, err)) != NULL)
        return true;
    scene_free(scene);
    return false;
}

/* Vertices are floats, and shadow rays begin a step of theirs away from surfaces: see doc/design-notes.md. */
enum { FAR_AWAY = 1000 };

static void warn_of_size(struct loading *l)
{
    const struct scene *scene = l->scene;
    vec3 center = add(scene->lights.center, scene->origin);
    if (scene->space != NULL && scene->space->ends)
        warn_of_scene(l, "a medium without a bound ends on a sphere of radius %g about (%g %g %g), beyond which the "
                      "infinite and distant lights are", scene->lights.radius, center.x, center.y, center.z);
    double distance = length(scene->lights.center) / scene->lights.radius; /* from the camera, in radii */
    if (distance > FAR_AWAY)
        warn_of_scene(l, "the scene is %.3g times its own radius away from the camera; above %d light passes through "
                      "edges, by rounding: move the camera nearer", distance, FAR_AWAY);
}

/* Are the lens and the first boundary in the middle of the image in one medium? Eye sub-paths believe the lens, light
 * sub-paths the boundary. */
static void warn_of_media(struct loading *l)
{
    const struct scene *scene = l->scene;
    struct ray ray = camera_ray(&scene->camera, scene->width / 2.0, scene->height / 2.0, 0, 0);
    struct surface at;
    struct hit hit;
    bool met = scene_intersect(scene, &ray, &at);
    if (met)
        ray.tmax = length(sub(at.p, ray.o));
    bool bounded = scene->space != NULL && kd_closest(&scene->space->interfaces, &scene->geo, &ray, &hit);
    if (bounded)
        shape_surface(&scene->geo, &hit, &ray, &at);
    if (!bounded && !met)
        return;
    int before = medium_before(&scene->geo, &at, ray.d);
    vec3 p = add(at.p, scene->origin);
    if (before >= 0 && before != scene->camera.medium)
        warn_of_scene(l, "the camera and the boundary that it looks at, at (%g %g %g), are in different media: "
                      "integrators will differ; check each MediumInterface", p.x, p.y, p.z);
}

/* Are s = 0 and s = 1 enough? They miss light from a delta light that reaches a surface through a delta lobe. */
static bool path_tracer_sees_all(const struct scene *scene)
{
    bool delta_light = false, delta_lobe = false;
    for (int i = 0; i < scene->lights.n; i++)
        delta_light |= light_is_delta(&scene->lights.light[i]);
    for (int i = 0; i < scene->n_materials; i++)
        delta_lobe |= scene->material[i]->row->may_be_delta;
    return !(delta_light && delta_lobe);
}

/* Parameters may leave out connections that nothing else makes up for. */
static void warn_of_loss(struct loading *l, const struct prepared *p)
{
    const struct numbers *n = &p->parameters.numbers;
    bool complete = n->path_pixels > 0 && n->draws[FIRST_HIT] > 0 && n->draws[LATER_HIT] > 0;
    if (method_has(p->method, "later") != NULL && !complete && !path_tracer_sees_all(l->scene))
        warn_of_scene(l, "with connections, later or pathpixels 0 the image may lack light of point, spot and distant "
                      "lights that mirrors or glass send to a surface");
}

/* The filter must be prepared. */
static bool set_samples(struct render_job *job, struct error *err)
{
    long wanted = job->spp > 0 ? job->spp : job->quick ? 1 : job->scene->spp > 0 ? job->scene->spp : 16;
    long cycle = filter_cycle(&job->scene->filter);
    const int *part = job->samples;
    job->planned = (wanted + cycle - 1) / cycle * cycle;
    job->is_part = part[1] > 0;
    job->first = part[0];
    job->end = job->is_part ? part[1] : job->planned;
    if (!job->quiet && job->planned > wanted)
        say_line("asbdpt: a pixel filter with negative lobes takes samples in fours: %ld, not %ld", job->planned,
                 wanted);
    return job->end <= job->planned || error_usage(err, "--samples %d:%d: there are %ld per pixel, see --spp", part[0],
                                                   part[1], job->planned);
}

bool job_ready(struct render_job *job, const struct method *const *readers, struct scene *scene, struct prepared *out,
               struct error *err)
{
    struct loading l = {job, scene};
    const struct message_sink sink = {hear, &l};
    job->integrator = readers[0];
    if (!job_adapt(scene, readers, &sink, err) || !job_settle(job, scene, out, err)) {
        scene_free(scene);
        return false;
    }
    scene_prepare(scene);
    warn_of_size(&l);
    warn_of_media(&l);
    warn_of_loss(&l, out);
    bool strict = job->strict && scene->n_warnings > 0;
    if (set_samples(job, err) && !strict)
        return true;
    if (strict)
        error_set(err, "%s: refused for what is said above, by --strict", job->scene_path);
    method_release(out);
    scene_free(scene);
    return false;
}

bool job_load(struct render_job *job, struct scene *scene, struct prepared *out, struct error *err)
{
    if (!job_open(job, scene, err))
        return false;
    const struct method *const readers[2] = {job->integrator, NULL};
    return job_ready(job, readers, scene, out, err);
}
