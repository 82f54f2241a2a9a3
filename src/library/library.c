/* library.c: see asbdpt.h. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/number.h"
#include "base/version.h"
#include "image/image.h"
#include "library/job_options.h"
#include "library/state.h"
#include "render/noise_estimate.h"

const char *asbdpt_version(void) { return VERSION; }

/* --- messages ----------------------------------------------------------------------------------------- */

static void hear(void *context, bool is_error, const char *text)
{
    struct asbdpt *r = context;
    bool error = is_error || r->job.strict;
    if (error && !r->said)
        r->message.n = 0;
    struct growing *to = error ? &r->message : &r->warnings;
    growing_add(to, "%s%s", to->n > 0 ? "\n" : "", text);
    r->said |= error;
}

/* A call begins: is there a scene, or none, as it needs? */
static bool begins(asbdpt *r, bool open)
{
    r->said = false;
    if (r->open != open)
        hear(r, true, open ? "there is no scene yet: call asbdpt_open or asbdpt_open_text first"
                           : "there is a scene already: options come before it, and another scene needs another render");
    return r->open == open;
}

/* The status of a call; what `err` says becomes the message unless another one is. */
static int end_call(asbdpt *r, bool ok, const struct error *err)
{
    if (!ok && err->text[0] != '\0')
        hear(r, true, err->text);
    return !ok;
}

static bool unsampled(asbdpt *r)
{
    if (r->film.iterations > 0 || r->film.passes > 0)
        hear(r, true, "there are samples already: this comes before the first");
    return !r->said;
}

const char *asbdpt_message(const asbdpt *r) { return r->message.n > 0 ? r->message.text : ""; }
const char *asbdpt_warnings(const asbdpt *r) { return r->warnings.n > 0 ? r->warnings.text : ""; }

/* --- a render ----------------------------------------------------------------------------------------- */

asbdpt *asbdpt_new(void)
{
    asbdpt *r = mem_alloc(1, sizeof *r);
    r->job.quiet = true;
    r->job.sink = (struct message_sink){hear, r};
    return r;
}

void asbdpt_free(asbdpt *r)
{
    if (r == NULL)
        return;
    state_free(r);
    options_free(LIMIT_OPTIONS, r);
    for (int i = 0; i < r->kept.n; i++)
        free((char *)r->kept.item[i]);
    free(r->kept.item);
    free(r->message.text);
    free(r->warnings.text);
    free(r->statistics.text);
    free(r);
}

static char *keep(asbdpt *r, const char *text)
{
    char *copy = mem_copy_text(text);
    texts_add(&r->kept, copy);
    return copy;
}

int asbdpt_set(asbdpt *r, const char *option, const char *value)
{
    struct error err = {.text = ""};
    if (!begins(r, false))
        return 1;
    char *argv[3] = {"asbdpt_set", keep(r, option), value != NULL ? keep(r, value) : NULL};
    bool ok = option[0] == '-' || error_set(&err, "%s is no option", option);
    return end_call(r, ok && options_add(LIMIT_OPTIONS, value != NULL ? 3 : 2, argv, r, &err), &err);
}

int asbdpt_parameter(int number, struct asbdpt_parameter *out)
{
    for (const struct method *const *m = method_rows; *m != NULL && number >= 0; m++) {
        const struct field *const tables[] = {job_common(), (*m)->parameters, (*m)->own};
        *out = (struct asbdpt_parameter){(*m)->name, (*m)->select, NULL, (*m)->help, ""};
        if (number-- == 0)
            return 1;
        for (int i = 0; i < 3; i++)
            for (const struct field *f = tables[i]; f != NULL && f->name != NULL; f++)
                if (number-- == 0) {
                    out->name = f->name;
                    out->help = f->help;
                    field_fallback(f, out->fallback, sizeof out->fallback);
                    return 1;
                }
    }
    return 0;
}

/* A file, or a text in its place. */
static int open_scene(asbdpt *r, const char *name, const char *text, size_t length)
{
    struct error err = {.text = ""};
    if (!begins(r, false))
        return 1;
    r->warnings.n = 0;
    r->job.scene_path = keep(r, name);
    r->job.scene_text = text;
    r->job.scene_length = length;
    bool ok = strcmp(name, "-") != 0 || error_set(&err, "-: standard input belongs to the program");
    ok = ok && state_open(r, &err);
    r->job.scene_text = NULL; /* it was copied */
    return end_call(r, ok, &err);
}

int asbdpt_open(asbdpt *r, const char *path) { return open_scene(r, path, NULL, 0); }

int asbdpt_open_text(asbdpt *r, const char *name, const char *text, size_t length)
{
    return open_scene(r, name, length > 0 ? text : "", length);
}

int asbdpt_size(asbdpt *r, int *width, int *height)
{
    if (!begins(r, true))
        return 1;
    *width = rect_width(r->film.rect);
    *height = rect_height(r->film.rect);
    return 0;
}

int asbdpt_render(asbdpt *r, long samples, asbdpt_progress *progress, asbdpt_cancel *cancel, void *context)
{
    struct error err = {.text = ""};
    if (!begins(r, true))
        return 1;
    bool ok = (samples >= 0 && samples <= 1 << 30) || error_set(&err, "%ld samples cannot be rendered", samples);
    r->progress = progress;
    r->cancel = cancel;
    r->context = context;
    r->by_parts |= samples > 0;
    return end_call(r, ok && state_render(r, samples, &err), &err);
}

/* --- what there is so far ----------------------------------------------------------------------------- */

double asbdpt_samples(const asbdpt *r) { return r->open ? film_samples(&r->film) : -1; }

int asbdpt_read(asbdpt *r, float *pixels)
{
    if (!begins(r, true))
        return 1;
    film_develop(&r->film, r->scene.film_scale, pixels);
    return 0;
}

int asbdpt_keep_error(asbdpt *r)
{
    struct error err = {.text = ""};
    if (!begins(r, true) || !unsampled(r))
        return 1;
    bool ok = r->film.half != NULL || budget_has(&r->scene.memory, film_bytes(r->film.rect, true), &err);
    if (ok && r->film.half == NULL)
        film_keep_halves(&r->film);
    return end_call(r, ok, &err);
}

int asbdpt_error(asbdpt *r, float *pixels)
{
    struct error err = {.text = ""};
    const struct film *f = &r->film;
    if (!begins(r, true))
        return 1;
    bool ok = f->half != NULL || error_set(&err, "no error is kept: call asbdpt_keep_error before the first sample");
    long every = noise_every(f);
    ok = ok && (every > 0 || error_set(&err, "the error is known once asbdpt_render was called"));
    ok = ok && ((f->iterations > 0 && f->passes == 0 && f->iterations % every == 0) ||
                error_set(&err, "the error is known at every %ld samples, not at %ld", every, f->iterations));
    double scale = r->scene.film_scale / (double)(f->iterations > 0 ? f->iterations : 1);
    for (size_t i = 0; ok && i < rect_pixels(f->rect) * 3; i++)
        pixels[i] = float_within(fabs(2 * exact_value(&f->half[i]) - film_value(f, i)) * scale);
    return end_call(r, ok, &err);
}

const char *asbdpt_statistics(asbdpt *r)
{
    const struct texts none = {0};
    if (!begins(r, true))
        return NULL;
    r->statistics.n = 0;
    stats_add(&r->statistics, r, &none, NULL);
    return r->statistics.text;
}

static bool save_picture(const asbdpt *r, const char *path, struct error *err)
{
    int width = rect_width(r->film.rect), height = rect_height(r->film.rect);
    struct file_output file;
    if (!image_create(path, &file, err))
        return false;
    float *pixels = mem_alloc(rect_pixels(r->film.rect) * 3, sizeof *pixels);
    film_develop(&r->film, r->scene.film_scale, pixels);
    for (size_t i = 0; i < rect_pixels(r->film.rect) * 3; i++)
        pixels[i] = pixels[i] > 0 ? pixels[i] : 0;
    const struct raster raster = {r->part.place, width, height, pixels, NULL, 0, false};
    bool ok = image_finish(&file, &raster, err);
    free(pixels);
    return ok;
}

static bool save_part(const asbdpt *r, const char *path, struct error *err)
{
    return part_possible(&r->film, path, err) && state_save(r, path, err);
}

/* The scene's files are not written over. */
static int save(asbdpt *r, const char *path, bool (*write)(const asbdpt *r, const char *path, struct error *err))
{
    struct error err = {.text = ""};
    const struct texts outputs = {(const char **)&path, 1};
    if (!begins(r, true))
        return 1;
    bool ok = strcmp(path, "-") != 0 || error_set(&err, "-: standard output belongs to the program");
    return end_call(r, ok && job_spares(&r->scene, &outputs, &err) && write(r, path, &err), &err);
}

int asbdpt_save(asbdpt *r, const char *path)
{
    return save(r, path, file_has_extension(path, ".part") ? save_part : save_picture);
}

int asbdpt_save_checkpoint(asbdpt *r, const char *path) { return save(r, path, state_save); }

int asbdpt_load_checkpoint(asbdpt *r, const char *path)
{
    struct error err = {.text = ""};
    if (!begins(r, true) || !unsampled(r))
        return 1;
    r->by_parts = true;
    return end_call(r, state_load(r, path, &err), &err);
}

/* --- paths -------------------------------------------------------------------------------------------- */

static void put(double out[3], vec3 v)
{
    out[0] = v.x;
    out[1] = v.y;
    out[2] = v.z;
}

/* A vertex of a sub-path, in the coordinates of the file. */
static struct asbdpt_vertex tell(const struct scene *scene, const struct vertex *v)
{
    static const int KINDS[] = {[VERTEX_LENS] = ASBDPT_LENS, [VERTEX_LIGHT] = ASBDPT_LIGHT,
                                [VERTEX_SURFACE] = ASBDPT_SURFACE, [VERTEX_MEDIUM] = ASBDPT_MEDIUM,
                                [VERTEX_ESCAPED] = ASBDPT_ESCAPED};
    bool far = v->kind == VERTEX_ESCAPED || vertex_at_infinity(scene, v);
    struct asbdpt_vertex out = {.kind = KINDS[v->kind], .beta = {v->beta.r, v->beta.g, v->beta.b}, .pdf = v->pdf_fwd};
    put(out.p, far ? vec(0, 0, 0) : add(v->p, scene->origin));
    put(out.n, v->ng);
    return out;
}

static void joined(void *context, const struct sample *sample, const struct joined *j)
{
    const struct asbdpt *r = context;
    const struct scene *scene = &r->scene;
    rgb value = rgb_scale(j->c->value, j->scale);
    struct asbdpt_vertex vertex[PATH_MAX_DEPTH + 2];
    struct asbdpt_path told = {.s = j->s, .t = j->t, .x = sample->x, .y = sample->y, .sample = sample->iteration,
                               .value = {value.r, value.g, value.b}, .weight = j->c->weight, .vertex = vertex};
    if (rgb_is_black(value))
        return;
    if (j->t == 1) {
        told.px = j->px;
        told.py = j->py;
    }
    if ((j->s == 0 || j->path != NULL) && (j->t == 1 || j->z != NULL)) {
        for (int i = 0; i < j->s; i++)
            vertex[told.n++] = tell(scene, &j->path[i]);
        for (int i = 0; i < j->t && j->t > 1; i++)
            vertex[told.n++] = tell(scene, j->z - i);
        if (j->t == 1) {
            vertex[told.n] = (struct asbdpt_vertex){.kind = ASBDPT_LENS, .beta = {1, 1, 1}, .pdf = 1};
            put(vertex[told.n++].p, add(scene->camera.position, scene->origin));
        }
        if (j->s == 0 && j->z->lamp != NULL) /* the path ends there */
            vertex[0] = tell(scene, j->z->lamp);
    }
    r->observer(r->observer_context, &told);
}

static struct observer begin_pass(void *context, int slot, const struct tile *tile)
{
    (void)slot, (void)tile;
    return (struct observer){.context = context, .joined = joined};
}

static void end_pass(void *context, int slot) { (void)context, (void)slot; }

int asbdpt_observe(asbdpt *r, asbdpt_observer *observer, void *context)
{
    if (!begins(r, true))
        return 1;
    r->observer = observer;
    r->observer_context = context;
    r->observers = (struct observers){r, begin_pass, end_pass};
    r->job.observers = observer != NULL ? &r->observers : NULL;
    return 0;
}
