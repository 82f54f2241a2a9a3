/* usefulness.c: are light sub-paths worth their time in this scene? See probe.h. */
#include <stdlib.h>

#include "base/number.h"
#include "learning/probe.h"

enum { LEAST_PIXELS = 512, MOST_PIXELS = 4096 };
static const double SHARE_OF_PIXELS = 0.25;
static const double CLIP_TAIL = 1e4; /* bound of a pixel's sum; large, because only this sum shows fireflies */

/* The samples of a pixel. OTHER has other random numbers than FIRST; AGAIN has those of FIRST and other counts. */
enum render { FIRST, OTHER, AGAIN };

struct pixel {
    double value[2];  /* luminance of FIRST and OTHER, t >= 2 */
    double direct[2]; /* the part of it that is direct light */
    double splats;    /* sum of squares of the contributions of FIRST with t = 1 */
    double tail, direct_tail; /* sums of X^2 (1/P - 1): paths of three edges or more; direct light */
};

struct path {
    double x, weight; /* in FIRST */
};

struct usefulness {
    struct mis_counts counts, again;
    struct pixel *pixel; /* [n] */
};

/* Data of one pixel while it takes its samples. */
struct notes {
    struct pixel *pixel;
    enum render render;
    struct path *path; /* [n], paths of FIRST in their order; `next` is the number that AGAIN makes next; owned */
    size_t n, next;
};

static void add_tail(struct notes *n, const struct joined *now)
{
    const struct path *before = &n->path[n->next++];
    double w = now->c->weight;
    int edges = now->s + now->t - 1;
    if (edges < 2 || !(before->weight > 0) || !(w > 0))
        return; /* light that the camera sees directly has one strategy */
    double P = clamp((now->s <= 1 ? 2 : 1) * before->weight / w - 1, 1e-6, 1);
    *(edges == 2 ? &n->pixel->direct_tail : &n->pixel->tail) += sqr(before->x) * (1 / P - 1);
}

static void note(void *context, const struct pixel_sample *sample, const struct joined *path)
{
    struct notes *n = context;
    double x = rgb_luminance(path->added);
    (void)sample;
    if (!(rgb_luminance(path->c->value) > 0))
        return; /* both samples leave it out */
    if (n->render == AGAIN) {
        add_tail(n, path);
        return;
    }
    x = fits_float(x) ? x : 0;
    if (path->t > 1) {
        n->pixel->value[n->render] += x;
        n->pixel->direct[n->render] += path->s + path->t == 3 ? x : 0;
    }
    if (n->render == FIRST) {
        n->pixel->splats += path->t == 1 ? x * x : 0;
        n->path = mem_append(n->path, n->n, sizeof *n->path);
        n->path[n->n++] = (struct path){x, path->c->weight};
    }
}

static void measure(struct probe *p, int64_t k, int x, int y, int thread)
{
    const struct usefulness *u = p->context;
    struct notes n = {.pixel = &u->pixel[k]};
    const struct observer observer = {.context = &n, .joined = note};
    double asked = 0;
    for (n.render = FIRST; n.render <= AGAIN && patience_lasts(&p->patience, &asked); n.render++)
        probe_sample(p, n.render == AGAIN ? &u->again : &u->counts, n.render == OTHER, x, y, (long)k, thread,
                     &observer);
    free(n.path);
}

bool light_paths_useful(const struct render_job *job)
{
    const struct numbers bdpt = {.path_pixels = 1, .draws = {1, 1}, .light_points = 1, .path_tracing = true};
    struct usefulness u = {.counts = counts_of(bdpt, NO_CREDITS, pixel_light_count(job))};
    struct probe p = {.job = job, .context = &u, .measure = measure};
    double all = 0, variance = 0, tail = 0, direct = 0, direct_square = 0, direct_tail = 0;
    p.n = int_within(SHARE_OF_PIXELS * pixel_light_count(job), LEAST_PIXELS, MOST_PIXELS);
    int64_t wanted = p.n;
    u.again = u.counts;
    u.again.connect[FIRST_HIT] = u.again.connect[LATER_HIT] = 0.5;
    u.again.splat /= 2;
    u.pixel = mem_alloc((size_t)p.n, sizeof *u.pixel);
    probe_run(&p);
    for (const struct pixel *x = u.pixel; x < u.pixel + p.n; x++)
        all += (x->value[0] + x->value[1]) / (2 * (double)p.n);
    for (const struct pixel *x = u.pixel; x < u.pixel + p.n; x++) {
        double scale = probe_scale((x->value[0] + x->value[1]) / 2, all);
        variance += fmin(sqr(x->value[0] - x->value[1]) / 2 / scale, PROBE_CLIP);
        variance += fmin(x->splats / probe_scale(all, all), PROBE_CLIP); /* they land on any pixel */
        tail += fmin(x->tail / scale, CLIP_TAIL);
        direct += fmin(sqr(x->direct[0] - x->direct[1]) / 2 / scale, PROBE_CLIP);
        direct_square += fmin((sqr(x->direct[0]) + sqr(x->direct[1])) / 2 / scale, PROBE_CLIP);
        direct_tail += fmin(x->direct_tail / scale, CLIP_TAIL);
    }
    free(u.pixel);
    if (direct_square > 0)
        tail += direct_tail * direct / direct_square;
    return p.n < wanted || !(tail < variance);
}
