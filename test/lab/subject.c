/* subject.c: see subject.h. */
#include "lab/subject.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "lab/methods.h"
#include "lab/stats.h"
#include "lab/timed.h"

enum { PROBE_WIDTH = 24, ROUNDS = 3, LEAST_TIMED = 4, TIMED_SHARE = 16 };

struct render_job subject_options(struct subject *s, const struct measured *m, uint64_t seed, int n_threads)
{
    struct settings base = {0};
    if (s->plan->no_roulette)
        settings_set(&base, "rrthreshold", "0", "experiment");
    settings_clear(&s->scene.settings);
    s->scene.settings = measured_settings(m, &base);
    settings_clear(&base);
    struct render_job o = {.integrator = method_of(&s->scene, m->integrator), .seed = seed, .n_threads = n_threads,
                               .max_depth = s->out->max_depth};
    return o;
}

static void resize(struct scene *scene, int width, int height)
{
    scene->width = width;
    scene->height = height;
    camera_prepare(&scene->camera, width, height);
}

unsigned long subject_probe(struct subject *s, int method)
{
    struct render_job o = subject_options(s, &s->plan->methods.item[method], 0, 1);
    struct timed picture;
    int width = s->scene.width, height = s->scene.height, least = width < PROBE_WIDTH ? width : PROBE_WIDTH;
    if (s->probe[method] != 0)
        return s->probe[method];
    o.end = 1;
    resize(&s->scene, least, 1 + (height - 1) * least / width);
    if (timed_render(&s->scene, &o, &picture, NULL)) {
        s->probe[method] = store_checksum(picture.pixels, s->scene.width, s->scene.height);
        free(picture.pixels);
    }
    resize(&s->scene, width, height);
    return s->probe[method];
}

int subject_key(struct subject *s, int method, char key[STORE_KEY])
{
    return snprintf(key, STORE_KEY, "%s %016" PRIx64 " %08lx %dx%d maxdepth=%d %s%s", s->out->name, s->scene.content,
                    subject_probe(s, method), s->scene.width, s->scene.height, s->out->max_depth,
                    s->plan->methods.item[method].text, s->plan->no_roulette ? " rrthreshold=0" : "");
}

/* --- prices ------------------------------------------------------------------------------------------ */

/* CPU seconds of what a method prepares and of each of a few samples: a whole block of them, unless that is longer than
 * what the first method renders. */
static bool time_method(struct subject *s, int method, int seed, long spp, double *before, double *each)
{
    uint64_t number = plan_seed(s->plan, method, seed);
    struct render_job o = subject_options(s, &s->plan->methods.item[method], number, 1);
    struct timed took;
    int block;
    if (!timed_prepare(&s->scene, &o, before, &block, s->err))
        return false;
    o.end = block > spp && block <= plan_last_spp(s->plan) ? block : spp;
    if (!timed_render(&s->scene, &o, &took, s->err))
        return false;
    free(took.pixels);
    *each = fmax(took.seconds - *before, 1e-6) / (double)o.end;
    return true;
}

/* The first method and another by turns. */
static bool measure_price(struct subject *s, int method, int seed, double out[STORE_NUMBERS])
{
    double before[ROUNDS], each[ROUNDS], first[ROUNDS], ignored;
    long spp = plan_last_spp(s->plan) / TIMED_SHARE;
    spp = spp > LEAST_TIMED ? spp : LEAST_TIMED;
    for (int i = 0; i < ROUNDS; i++) {
        if (!time_method(s, 0, seed, spp, &ignored, &first[i]) ||
            !time_method(s, method, seed, spp, &before[i], &each[i]))
            return false;
        before[i] /= first[i];
        each[i] = method == 0 ? 1 : each[i] / first[i];
    }
    stats_sort(first, ROUNDS);
    out[0] = stats_median(before, ROUNDS);
    out[1] = stats_median(each, ROUNDS);
    out[2] = first[0];
    return true;
}

bool subject_price(struct subject *s, int method, int seed)
{
    const struct plan *p = s->plan;
    const struct measured *first = &p->methods.item[0];
    struct record r = {{0}, NULL, 0, 0};
    char name[STORE_NAME], key[STORE_KEY];
    int n = subject_key(s, method, key);
    snprintf(key + n, (size_t)(STORE_KEY - n), " price over %s, %08lx, spp=%ld seed=%" PRIu64, first->text,
             subject_probe(s, 0), plan_last_spp(p), plan_seed(p, method, seed));
    snprintf(name, sizeof name, "store/%s--%s--%d--price-over-%.20s--seed%" PRIu64, s->out->name,
             p->methods.item[method].file, s->scene.width, first->file, plan_seed(p, method, seed));
    bool ok = store_read(p->directory, name, key, &r) ||
              (measure_price(s, method, seed, r.number) && store_write(p->directory, name, key, &r, s->err));
    s->out->price[method][seed - 1] = (struct price){r.number[0], r.number[1]};
    bool less = (method == 0 && seed == 1) || r.number[2] < s->out->seconds;
    s->out->seconds = less ? r.number[2] : s->out->seconds;
    return ok;
}
