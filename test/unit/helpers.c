/* helpers.c: see helpers.h. */
#define _POSIX_C_SOURCE 200809L
#include "helpers.h"

#include <dirent.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/mem.h"
#include "base/os.h"
#include "base/parallel.h"
#include "base/sampler.h"
#include "base/warp.h"
#include "caustics/derived.h"
#include "fuzz/lists.h"
#include "integrators/prepare.h"
#include "lab/numbers.h"
#include "lab/sides.h"
#include "lab/stats.h"
#include "parser/parser.h"
#include "random_structure.h"

void write_bytes(const char *path, const void *data, size_t n)
{
    FILE *f = fopen(path, "wb");
    if (f == NULL)
        return;
    fwrite(data, 1, n, f);
    fclose(f);
}

const char *top_directory(char *path, size_t size)
{
    if (size < 2 || getcwd(path, size - 1) == NULL)
        return "";
    return strcat(path, "/");
}

bool read_exactly(reader *read, const uint8_t *data, size_t n, struct image *out, struct error *err)
{
    uint8_t *copy = mem_alloc(n, 1);
    memcpy(copy, data, n);
    memset(out, 0, sizeof *out);
    const struct budget memory = budget_new(256e6, "");
    bool ok = read(copy, n, &memory, out, err);
    free(copy);
    return ok;
}

bool accepts(reader *read, const uint8_t *data, size_t n, struct error *err)
{
    struct image img;
    bool ok = read_exactly(read, data, n, &img, err);
    image_free(&img);
    return ok;
}

struct shape_fields shape_fields_of(const char *shape)
{
    const struct shape_row *const *row = shape_rows;
    while (strcmp((*row)->name, shape) != 0)
        row++;
    struct shape_fields f = {*row, mem_alloc(1, (*row)->size)};
    return f;
}

void shape_fields_set(struct shape_fields *f, const char *name, const void *value, size_t size)
{
    memcpy(f->fields + field_find(f->row->fields, name)->place, value, size);
}

static void ignore_warning(const struct mesh_task *task, const char *format, ...)
{
    (void)task;
    (void)format;
}

bool shape_fields_mesh(struct shape_fields *f, double bytes, struct mesh *out, struct error *err)
{
    const struct budget memory = budget_new(bytes, "");
    struct mesh_task task = {.shape = f->row->name, .memory = &memory, .warn = ignore_warning};
    memset(out, 0, sizeof *out);
    bool ok = f->row->mesh(f->fields, &task, out);
    *err = task.err;
    free(f->fields);
    return ok;
}

struct rng stream_of(const struct test *t, const char *name, uint64_t purpose)
{
    uint64_t hash = purpose;
    for (const char *c = name; *c != '\0'; c++)
        hash = hash_combine(hash, (uint64_t)*c);
    return rng_stream(test_seed(t), RNG_TEST, 22, hash);
}

bool near3(vec3 a, vec3 b, double tolerance) { return length(sub(a, b)) <= tolerance; }

vec3 on_sphere(struct rng *r)
{
    double u1 = rng_uniform(r), u2 = rng_uniform(r);
    return warp_sphere(u1, u2);
}

void check_no_picture(struct test *t, reader *read, const uint8_t *data, size_t n, const char *message)
{
    struct error err = {.text = ""};
    CHECK(t, !accepts(read, data, n, &err) && strstr(err.text, message) != NULL && strchr(err.text, '\n') == NULL,
          "\"%s\" expected, got \"%s\"", message, err.text);
}

int check_spoilt(struct test *t, const char *what, reader *read, const uint8_t *data, size_t n)
{
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 30, n);
    int accepted = 0;
    for (size_t cut = 0; cut < n; cut += cut < 300 || n - cut < 20 ? 1 : 1 + n / 40)
        CHECK(t, !accepts(read, data, cut, NULL), "%s: the first %lu bytes are accepted", what, (unsigned long)cut);
    uint8_t *copy = mem_alloc(n, 1);
    for (size_t round = 0; round < 200; round++) {
        memcpy(copy, data, n);
        copy[round < n ? round : rng_below(&r, (uint32_t)n)] ^= (uint8_t)(1 + rng_below(&r, 255));
        accepted += accepts(read, copy, n, NULL);
    }
    free(copy);
    return accepted;
}

struct shape_group group_of(int material, int first_light)
{
    struct shape_group g = {.material = material, .alpha = -1, .first_light = first_light};
    return g;
}

struct surface surface_at(const struct geometry *geo, int prim, double b1, double b2)
{
    struct hit hit = {0, b1, b2, prim, 0};
    struct ray ray = {vec(0, 0, 0), vec(0, 0, 1), 0, 1, 0, 0};
    struct surface at;
    shape_surface(geo, &hit, &ray, &at);
    return at;
}

struct transform random_affine(struct rng *r)
{
    struct transform out;
    double m[16];
    do {
        for (int i = 0; i < 16; i++)
            m[i] = i % 5 == 0 ? 0.4 + 1.6 * rng_uniform(r) : i % 4 == 3 ? 0 : 1.2 * rng_uniform(r) - 0.6;
        m[0] *= rng_below(r, 2) == 0 ? 1 : -1;
        m[15] = 1;
    } while (!transform_from_matrix(m, &out) || fabs(transform_determinant(&out)) < 0.2);
    return out;
}

const char *scene_path(struct test *t, const char *path, char out[512])
{
    static const char *const FOLDERS[] = {"scenes", "scenes/conform", "scenes/features", "scenes/sky", "scenes/test"};
    struct error err;
    if (strncmp(path, "scenes/", 7) != 0 || file_exists(path))
        return path;
    snprintf(out, 512, "%s/%s", test_tmp(t), FOLDERS[0]);
    for (int i = mkdir(out, 0777) == 0 ? 1 : 5; i < 5; i++) {
        snprintf(out, 512, "%s/%s", test_tmp(t), FOLDERS[i]);
        CHECK(t, list_unpack(FOLDERS[i], out, &err), "%s", err.text);
    }
    snprintf(out, 512, "%s/%s", test_tmp(t), path);
    return out;
}

bool scene_from_structure(struct test *t, uint64_t number, int width, int height, struct scene *out)
{
    const char *kind = NULL;
    char *text = random_structure(number, &kind);
    bool ok = scene_from_text(t, text, out);
    free(text);
    if (ok) {
        out->width = width;
        out->height = height;
        camera_prepare(&out->camera, width, height);
    }
    return ok;
}

bool scene_from_file(struct test *t, const char *path, int width, int height, struct scene *out)
{
    char listed[512];
    struct error err;
    if (!CHECK(t, parse_scene(scene_path(t, path, listed), NULL, out, NULL, &err), "%s: %s", path, err.text))
        return false;
    if (width > 0) {
        out->width = width;
        out->height = height;
        filter_default("box", &out->filter);
    }
    scene_prepare(out);
    return true;
}

bool scene_from_text(struct test *t, const char *text, struct scene *out)
{
    char path[256];
    snprintf(path, sizeof path, "%s/scene.pbrt", test_tmp(t));
    FILE *f = fopen(path, "w");
    if (!CHECK(t, f != NULL, "cannot write %s", path))
        return false;
    fputs(text, f);
    fclose(f);
    return scene_from_file(t, path, 0, 0, out);
}

bool scene_from_format(struct test *t, struct scene *out, const char *format, ...)
{
    char text[4096];
    va_list args;
    va_start(args, format);
    int n = vsnprintf(text, sizeof text, format, args);
    va_end(args);
    return CHECK(t, n > 0 && n < (int)sizeof text, "a text of %d bytes", n) && scene_from_text(t, text, out);
}

struct filter filter_of(const char *name)
{
    struct filter f;
    filter_default(name, &f);
    filter_prepare(&f);
    return f;
}

const char *set_method(struct scene *scene, const char *way)
{
    static char text[256];
    snprintf(text, sizeof text, "%s", way);
    settings_clear(&scene->settings);
    const char *integrator = strtok(text, " ");
    for (char *name; (name = strtok(NULL, " ")) != NULL;) {
        char *equals = strchr(name, '=');
        *equals = '\0';
        settings_set(&scene->settings, name, equals + 1, "test");
    }
    return integrator;
}

const struct method *set_row(struct scene *scene, const char *way)
{
    return method_of(scene, set_method(scene, way));
}

const char *method_name(const struct method *m)
{
    static char text[64];
    bool one = m->select == NULL;
    snprintf(text, sizeof text, "%s%s%s", m->name, one ? "" : " select=", one ? "" : m->select);
    return text;
}

void render_film(struct test *t, const struct scene *scene, const struct render_job *o, struct film *film)
{
    struct error err;
    film_init(film, render_crop(scene), scene->width, scene->height);
    CHECK(t, render_by(scene, o, film, &err), "%s", err.text);
}

void render_pixels(struct test *t, const struct scene *scene, const struct render_job *o, float *out)
{
    struct film film;
    render_film(t, scene, o, &film);
    film_develop(&film, scene->film_scale, out);
    film_free(&film);
}

bool films_equal(const struct film *a, const struct film *b)
{
    size_t n = (size_t)rect_width(a->rect) * (size_t)rect_height(a->rect) * 3;
    for (size_t i = 0; i < n; i++)
        if (film_value(a, i) != film_value(b, i))
            return false;
    return true;
}

bool same_picture(struct test *t, struct scene *scene, const char *one, const char *other, struct render_job o)
{
    struct film film[2];
    for (int i = 0; i < 2; i++) {
        o.integrator = set_row(scene, i == 0 ? one : other);
        render_film(t, scene, &o, &film[i]);
    }
    bool same = films_equal(&film[0], &film[1]);
    film_free(&film[0]);
    film_free(&film[1]);
    return same;
}

struct batches render_batches(struct test *t, const struct scene *scene, const char *integrator, int max_depth, int spp,
                              int n_batches, int tile, uint64_t seed)
{
    const struct gate all = {0, 0};
    return render_gated(t, scene, integrator, max_depth, all, spp, n_batches, tile, seed);
}

/* What comes through a gate goes into a tile of its own. */
struct gated {
    struct gate gate;
    struct tile tile;
};

static void gate_joined(void *context, const struct sample *sample, const struct joined *path)
{
    struct gated *g = context;
    double length = path_length(sample->pass->job->scene, path);
    if (rgb_is_black(path->added) || !(length >= g->gate.begin && length < g->gate.end))
        return;
    if (path->t == 1)
        tile_add_splat(&g->tile, path->px, path->py, path->added);
    else
        tile_add(&g->tile, sample->x, sample->y, path->added);
}

/* Batches of a render, whose method is prepared. */
struct batch_run {
    struct render_job job;
    struct prepared prepared;
    struct gate gate;
    int spp;
    struct batches *pixels;
    struct workspace *work; /* [threads] */
    long *nonfinite; /* [batches] */
};

/* Batch k, by hand, tile by tile as render.c does, on one thread. */
static void work_batch(void *context, int64_t k, int slot, int thread)
{
    struct batch_run *r = context;
    const struct scene *scene = r->job.scene;
    struct tile tile = {.sum = NULL};
    struct gated gated = {.gate = r->gate};
    const struct observer observer = {.context = &gated, .joined = gate_joined};
    struct tiling tiling = tiling_of(r->job.film_rect, &r->prepared.size);
    struct tile_pass pass = {.job = &r->job, .counts = &r->prepared.counts, .tile = &tile, .work = &r->work[thread],
                             .ends_at = CANCEL_NOW};
    long block = r->prepared.size.block > 0 ? r->prepared.size.block : LONGEST_BLOCK;
    long first = (long)k * SAMPLER_POINTS, end = first + r->spp;
    struct film film;
    (void)slot;
    film_init(&film, r->job.film_rect, scene->width, scene->height);
    for (pass.first = first; pass.first < end; pass.first = pass.end) {
        pass.end = (pass.first / block + 1) * block < end ? (pass.first / block + 1) * block : end;
        for (int64_t i = 0; i < tiling_count(&tiling); i++) {
            tile_start(&tile, tiling_pixels(&tiling, i), r->job.film_rect, &scene->filter);
            tile_start(&gated.tile, tiling_pixels(&tiling, i), r->job.film_rect, &scene->filter);
            pass.observer = r->gate.end > 0 ? &observer : NULL;
            r->prepared.method->render(&r->prepared, &pass);
            gated.tile.nonfinite += tile.nonfinite;
            film_merge_tile(&film, r->gate.end > 0 ? &gated.tile : &tile);
        }
    }
    for (long i = 0; i < r->pixels->n; i++)
        r->pixels->value[r->pixels->n * k + i] = film_value(&film, (size_t)i) / r->spp;
    r->nonfinite[k] = film.nonfinite;
    tile_free(&tile);
    tile_free(&gated.tile);
    film_free(&film);
}

static bool commit_batch(void *context, int64_t k, int slot)
{
    (void)context;
    (void)k;
    (void)slot;
    return true;
}

struct batches render_gated(struct test *t, const struct scene *scene, const char *integrator, int max_depth,
                            struct gate gate, int spp, int n_batches, int tile, uint64_t seed)
{
    struct pixel_rect crop = render_crop(scene);
    struct batches pixels = batches_new(n_batches, 3L * rect_width(crop) * rect_height(crop), false);
    struct batch_run r = {.gate = gate, .spp = spp * test_effort(t), .pixels = &pixels};
    struct render_job o = {.integrator = method_of(scene, integrator), .max_depth = max_depth,
                               .n_threads = os_cores(), .seed = test_seed(t) * 1000003 + seed};
    struct parallel_jobs jobs = {.n_jobs = n_batches, .n_threads = o.n_threads, .n_slots = o.n_threads, .context = &r,
                                 .work = work_batch, .commit = commit_batch};
    struct error err;
    if (!CHECK(t, render_prepare(scene, &o, crop, &r.job, &r.prepared, &err), "%s", err.text))
        return pixels;
    r.nonfinite = mem_alloc((size_t)n_batches, sizeof *r.nonfinite);
    r.work = workspaces_new(o.n_threads, r.job.max_depth);
    parallel_run(&jobs);
    workspaces_free(r.work, o.n_threads);
    method_release(&r.prepared);
    for (int k = 0; k < n_batches; k++)
        CHECK(t, r.nonfinite[k] == 0, "%s: %ld contributions are not finite", integrator, r.nonfinite[k]);
    free(r.nonfinite);
    struct batches tiles = batches_tiles(&pixels, rect_width(crop), rect_height(crop), tile);
    batches_free(&pixels);
    return tiles;
}

struct batches independent_batches(struct test *t, const struct scene *scene, const char *integrator, int max_depth,
                                   long spp, int n_batches, int tile, uint64_t seed)
{
    struct side side = {.name = ""};
    struct error err = {.text = ""};
    struct render_job o = {.integrator = method_of(scene, integrator), .seed = seed, .max_depth = max_depth,
                               .end = spp * test_effort(t), .n_threads = 2};
    CHECK(t, side_render(scene, &o, 0, n_batches, true, &side, &err), "%s: %s", integrator, err.text);
    struct batches tiles = batches_tiles(&side.pixels, side.width, side.height, tile);
    batches_free(&side.pixels);
    return tiles;
}

bool read_reference(struct test *t, const char *path, struct side *out)
{
    char errors[300];
    const char *both[2] = {path, errors};
    struct error err = {.text = ""};
    return CHECK(t, side_errors_path(path, errors, sizeof errors, &err) && side_read(both, 2, true, NULL, out, &err),
                 "%s", err.text);
}

bool load_reference(struct test *t, const char *name, int tile, int *width, int *height, struct batches *out)
{
    char path[256];
    struct side side = {0};
    snprintf(path, sizeof path, "ref/%s.pfm", name);
    bool ok = read_reference(t, path, &side);
    *width = side.width;
    *height = side.height;
    if (ok)
        *out = batches_tiles(&side.pixels, side.width, side.height, tile);
    batches_free(&side.pixels);
    return ok;
}

void batches_scale(struct batches *b, double factor)
{
    for (long i = 0; i < b->n * b->n_batches; i++)
        b->value[i] *= factor;
}

double batches_p(const struct batches *a, const struct batches *b, double *ratio)
{
    *ratio = batches_mean(a, NULL) / batches_mean(b, NULL);
    return batches_smallest_p(a, b);
}

double batches_paired_p(const struct batches *a, const struct batches *b, double *ratio)
{
    struct batches d = batches_new(a->n_batches, a->n, false), zero = batches_new(1, a->n, true);
    for (long i = 0; i < a->n * a->n_batches; i++)
        d.value[i] = a->value[i] - b->value[i];
    double one = batches_smallest_p(&d, &zero), whole = mean_p(&d, 0);
    *ratio = batches_mean(a, NULL) / batches_mean(b, NULL);
    batches_free(&d);
    batches_free(&zero);
    return stats_sidak(whole < one ? whole : one, 2);
}

double mean_p(const struct batches *b, double expected)
{
    double error, mean = batches_mean(b, &error);
    if (error <= 1e-12 * fabs(expected))
        return fabs(mean - expected) <= 1e-9 * fabs(expected) ? 1 : 0;
    return stats_student_p((mean - expected) / error, b->n_batches - 1);
}

char *text_of(struct test *t, const char *directory, const char *name)
{
    char path[512], listed[512];
    uint8_t *data = NULL;
    size_t size = 0;
    struct error err;
    snprintf(path, sizeof path, "%s/%s", directory, name);
    bool ok = CHECK(t, file_read(scene_path(t, path, listed), &data, &size, &err), "%s", err.text);
    return ok ? (char *)data : mem_copy_text(""); /* file_read puts a zero byte behind it */
}

bool remove_tree(const char *path)
{
    DIR *d = opendir(path);
    bool ok = d != NULL;
    for (struct dirent *e = NULL; d != NULL && (e = readdir(d)) != NULL;) {
        char inner[1024];
        if (strcmp(e->d_name, ".") == 0 || strcmp(e->d_name, "..") == 0)
            continue;
        snprintf(inner, sizeof inner, "%.500s/%.500s", path, e->d_name);
        if (remove(inner) != 0)
            ok = remove_tree(inner) && ok;
    }
    if (d != NULL)
        closedir(d);
    return rmdir(path) == 0 && ok;
}
