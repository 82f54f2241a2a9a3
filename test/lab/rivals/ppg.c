/* ppg.c: path tracing that draws directions by the BSDF and by what training has learnt of the light that arrives.
 *
 * Practical path guiding [Mueller 2017 3], with improvements of [Mueller 2019]. A walk leaves a surface with the
 * density
 *     p(w) = a p_bsdf(w) + (1 - a) p_guide(w),
 * where p_guide is a quadtree of the place (sdtree.h). It draws w from one of both, and divides by p. The weights of
 * s = 0 and s = 1 are those of `pt` with p for p_bsdf. The tree is fixed before the first sample, and p > 0 where
 * p_bsdf is, so the expectation is that of `pt` for any tree.
 *
 * Training consists of passes of 1, 2, 4 ... samples a pixel, whose numbers are negative. Each is guided by the tree
 * of the pass before it. A record is a direction w that a sample took, and all that it found from there on, points on
 * lights and weighted hits included, over p(w). The record's place is moved at random within a box of the size of its
 * leaf, and its light is spread over directions. Each leaf learns its share a. After the pass of n samples, leaves with
 * more than `cell` sqrt(n) records are halved.
 *
 * The passes are part of the picture, by their inverse variances [Mueller 2019 5]: pass k of n_k samples, of variance
 * v_k a sample, has the weight n_k / v_k. v_k is a mean over all pixels of the other colour of a chequerboard, so that
 * no weight depends on the value that it weighs, but by way of the trees. If samples after training are as good as
 * those of the last pass, training is worth W = v_last sum n_k / v_k of them, and is to have the weight W / (W + N)
 * among N. N is not known, since a render may go on; so sample i is (1 - a_i) of itself and a_i of training's mean,
 *     a_i = W^2 / ((W + i) (W + i + 1)),   whose sum over N samples is N W / (W + N).
 *
 * What differs from the papers:
 *   - Training is a fixed number of samples. [Mueller 2017] gives half of all samples to the last pass.
 *   - a is found by Newton's method and kept between 0.1 and 0.9. The papers take Adam with a term of regularisation.
 *   - Roulette is that of `pt`, by the throughput that the path would have if the BSDF had drawn all directions: a path
 *     towards light has a low one. The first paper's takes expected contributions; its author's program has none.
 * The tree does not see normals and materials. Delta lobes and all scattering in media are left to the BSDF. Like `pt`,
 * it misses what delta lights send through mirrors and glass. Without training it is `pt` to the bit.
 *
 * Tests: test_rivals.c.
 */
#include <stdlib.h>

#include "base/warp.h"
#include "integrators/prepare.h"
#include "learning/learn.h"
#include "learning/lessons.h"
#include "rivals/sdtree.h"
#include "rivals/together.h"

struct ppg {
    int training, cell, combine;
    struct sdtree tree;
    rgb *trained;    /* [pixels] what training has found; NULL: it is no part of the picture. Owned */
    double worth[2]; /* of that, in samples, by the pixel's colour */
};

/* How a sample left a vertex. */
struct step {
    const struct sd_leaf *guide; /* of the place; NULL: there the BSDF draws alone */
    bool left;
    struct departure from; /* before roulette */
    double odds, lost;     /* p_bsdf / (p_bsdf + p_guide) and p_bsdf / p in that direction */
    rgb before;            /* what the sample had found up to this vertex */
};

/* --- samples ----------------------------------------------------------------------------------------- */

static double mixed(const struct sd_leaf *guide, double bsdf, double known)
{
    return guide->share * bsdf + (1 - guide->share) * known;
}

/* As walk_leave, by the guide: out->pdf is p_bsdf, and beta is not over any density. */
static bool leave_by_guide(const struct walk *w, const struct vertex *z, const struct sd_leaf *guide,
                           struct departure *out)
{
    double u[2];
    sampler_pair(w->sampler, DRAW_SCATTERING, u);
    vec3 wi = quadtree_draw(&guide->known, u);
    struct bsdf_value b = bsdf_eval(&z->bsdf, z->wo, wi, RADIANCE);
    rgb beta = rgb_scale(rgb_mul(z->beta, b.f), scatter_cosine(z, wi, RADIANCE));
    *out = (struct departure){.ray = {z->p, wi, ray_margin(z->p), INFINITY, z->prim_id, 0},
                              .beta = beta, .pdf = b.pdf, .pdf_rev = b.pdf_rev};
    return !rgb_is_black(beta) && rgb_is_finite(beta);
}

/* As walk_leave, by one of both. step->guide is known; the step is filled in. */
static bool leave(const struct walk *w, const struct vertex *z, struct step *step, struct departure *out)
{
    const struct sd_leaf *guide = step->guide;
    bool by_guide = guide != NULL && guide->share < 1 && sampler_number(w->sampler, DRAW_LOBE) >= guide->share;
    step->left = by_guide ? leave_by_guide(w, z, guide, out) : walk_leave(w, z, RADIANCE, out);
    if (guide != NULL && step->left) {
        double bsdf = out->pdf, known = out->delta ? 0 : quadtree_pdf(&guide->known, out->ray.d);
        out->pdf = mixed(guide, bsdf, known);
        out->beta = rgb_scale(out->beta, (by_guide ? 1 : bsdf) / out->pdf);
        step->odds = bsdf / (bsdf + known);
        step->lost = bsdf / out->pdf;
        step->from = *out;
    }
    return step->left;
}

/* Go on from the last of n vertices. Returns their number; step [most] tells of each but the lens. */
static int walk_guided(const struct sdtree *tree, const struct walk *w, struct vertex *path, struct step *step, int n,
                       int most)
{
    double lost = 1; /* of the throughput, since directions are likelier than by the BSDF */
    for (bool met = n > 1; met;) {
        struct vertex *z = &path[n - 1];
        struct departure from;
        step[n - 1] = (struct step){.lost = 1};
        if (z->kind == VERTEX_SURFACE && z->bsdf.n_smooth > 0)
            step[n - 1].guide = &tree->node[sdtree_find(tree, z->p, NULL)].leaf;
        if (n == most || !leave(w, z, &step[n - 1], &from))
            break;
        lost *= step[n - 1].lost;
        double left = rgb_max(from.beta) / lost, q = sqrt(left / w->rr_threshold);
        if (n > 2 && left < w->rr_threshold) { /* roulette, see path.h */
            from.beta = rgb_scale(from.beta, 1 / q);
            if (sampler_number(w->sampler, DRAW_ROULETTE) >= q)
                break;
        }
        met = walk_on(w, from, path, n, n + 1, RADIANCE) > n;
        n += met;
    }
    return n;
}

/* s = 1, as sample_s1. */
static void sum_direct(struct sample *sample, const struct vertex *z, int t, const struct sd_leaf *guide)
{
    struct light_point at;
    struct vertex y;
    struct lit l;
    struct connection c = {.light = -1};
    if (lit_draw(sample, z, &sample->sampler, 0, 1, &at, &l)) {
        if (guide != NULL)
            l.pdf_z = mixed(guide, l.pdf_z, quadtree_pdf(&guide->known, l.w));
        c = connect_lit(sample->pass->job->scene, sample->pass->counts, &l);
    }
    if (at.light >= 0)
        y = light_vertex(sample->pass->job->scene, sample->pass->counts, &at);
    sample_add(sample, (struct joined){.s = 1, .t = t, .path = at.light >= 0 ? &y : NULL, .z = z, .c = &c, .pmf = 1,
                                       .scale = 1});
}

/* A sample of a pixel, not ended, times `share`. Its vertices are in the workspace; returns their number, and of each
 * the step. */
static int trace_pixel(const struct prepared *p, const struct tile_pass *pass, int i, long iteration, double share,
                       struct sample *sample, struct step **step)
{
    struct vertex *eye = pass->work->eye;
    int most = pass->job->max_depth + 2;
    arena_reset(&pass->work->arena);
    *sample = sample_begin(pass, i, iteration);
    struct sampler sampler = sample_stream(pass, RNG_EYE, sample->x, sample->y, (uint64_t)iteration);
    const struct walk w = {pass->job->scene, pass->counts, &pass->work->arena, &sampler, pass->job->rr_threshold};
    *step = arena_alloc(&pass->work->arena, (size_t)most * sizeof **step);
    int n = path_eye_pixel(&w, sample->x, sample->y, eye, 2, &sample->filter_weight);
    sample->filter_weight *= share;
    n = walk_guided(&((const struct ppg *)p->own)->tree, &w, eye, *step, n, most);
    for (const struct observer *o = pass->observer; o != NULL; o = o->next)
        if (o->walked != NULL)
            o->walked(o->context, sample, RADIANCE, eye, n);
    for (int t = 2; t <= n; t++) {
        sample_s0(sample, t);
        if (eye[t - 1].kind != VERTEX_ESCAPED && t < most)
            sum_direct(sample, &eye[t - 1], t, (*step)[t - 1].guide);
        (*step)[t - 1].before = sample->value;
    }
    return n;
}

/* Of two on a chequerboard. */
static int colour_of(int x, int y) { return (x + y) % 2; }

/* The share of what training has found in sample i of a pixel. */
static double share_of_training(const struct ppg *own, int x, int y, double i)
{
    double W = own->worth[colour_of(x, y)];
    return W / (W + i) * W / (W + i + 1);
}

static void add_training(const struct ppg *own, struct sample *sample, double share)
{
    const struct pixel_rect rect = sample->pass->job->film_rect;
    long at = (long)(sample->y - rect.y0) * rect_width(rect) + sample->x - rect.x0;
    struct connection c = {.value = own->trained[at], .weight = 1, .light = -1};
    sample->filter_weight = 1; /* it is in the value */
    sample_add(sample, (struct joined){.t = 2, .c = &c, .pmf = 1, .scale = share});
}

static void render(const struct prepared *p, const struct tile_pass *pass)
{
    const struct ppg *own = p->own;
    struct sample sample;
    struct step *step;
    for (long iteration = pass->first; iteration < pass->end; iteration++)
        for (int i = 0; pass_goes_on(pass, i); i++) {
            const int *at = pass->tile->pixel[i];
            double share = own->trained != NULL ? share_of_training(own, at[0], at[1], (double)iteration) : 0;
            trace_pixel(p, pass, i, iteration, 1 - share, &sample, &step);
            if (share > 0)
                add_training(own, &sample, share);
            sample_end(&sample);
        }
}

/* --- training ---------------------------------------------------------------------------------------- */

/* The running pass. */
struct trainer {
    struct learning learning; /* the first, which lessons_learn passes on */
    struct prepared *prepared;
    long end;
    rgb *found; /* [end] values of its samples */
};

static double ratio(rgb a, rgb b)
{
    return rgb_luminance(rgb_make(b.r > 0 ? a.r / b.r : 0, b.g > 0 ? a.g / b.g : 0, b.b > 0 ? a.b / b.b : 0));
}

/* Lessons of two kinds: a record, whose x and w are contribution and odds; or light x from a direction. Of that w has u
 * and 1, so that it is not 0, and the column has v. */
enum { RECORD, LIGHT, V_STEPS = 1 << 30 };

/* The step from vertex z, and what the sample found behind it. */
static void record(struct lessons *out, const struct sdtree *tree, const struct vertex *z, const struct step *step,
                   rgb found, struct sampler *sampler)
{
    vec3 size, p = z->p;
    double u, v;
    sdtree_find(tree, p, &size);
    p.x += size.x * (sampler_number(sampler, DRAW_ORDER) - 0.5);
    p.y += size.y * (sampler_number(sampler, DRAW_ORDER) - 0.5);
    p.z += size.z * (sampler_number(sampler, DRAW_ORDER) - 0.5);
    uint64_t leaf = (uint64_t)sdtree_find(tree, p, NULL);
    double light = ratio(found, step->from.beta) / step->from.pdf;
    warp_sphere_inverse(step->from.ray.d, &u, &v);
    lessons_add(out, (struct lesson){RECORD, leaf, 0, ratio(found, z->beta), step->odds});
    if (!step->from.delta && light > 0)
        lessons_add(out, (struct lesson){LIGHT, leaf, (int)(v * V_STEPS), light, 1 + u});
}

/* Sample i of a pass of n samples a pixel, which have the numbers -n, -n - 1 ... for all pixels in turn. */
static void trace(struct learning *l, struct workspace *work, long i, struct lessons *out)
{
    const struct trainer *trainer = (const void *)l;
    const struct sdtree *tree = &((const struct ppg *)trainer->prepared->own)->tree;
    const struct pixel_rect rect = l->job->film_rect;
    long width = rect_width(rect), pixels = width * rect_height(rect), at = i % pixels;
    int pixel[1][2] = {{rect.x0 + (int)(at % width), rect.y0 + (int)(at / width)}};
    struct tile tile = {.pixel = pixel, .n_pixels = 1}; /* counts what is not finite */
    const struct tile_pass pass = {.job = l->job, .counts = &trainer->prepared->counts, .tile = &tile, .work = work,
                                   .ends_at = CANCEL_NOW};
    struct sample sample;
    struct step *step;
    int n = trace_pixel(trainer->prepared, &pass, 0, -(trainer->end + i) / pixels, 1, &sample, &step);
    trainer->found[i] = rgb_is_finite(sample.value) ? sample.value : rgb_black();
    for (int t = n; t >= 2; t--)
        if (step[t - 1].guide != NULL && step[t - 1].left && sample.filter_weight != 0) {
            rgb found = rgb_sub(sample.value, step[t - 1].before);
            record(out, tree, &work->eye[t - 1], &step[t - 1], rgb_scale(found, 1 / sample.filter_weight),
                   &sample.sampler);
        }
}

static void take(struct learning *l, const struct lesson *lesson)
{
    struct ppg *own = ((struct trainer *)(void *)l)->prepared->own;
    struct sd_leaf *leaf = &own->tree.node[lesson->row].leaf;
    if (lesson->kind == RECORD)
        sd_add_record(leaf, lesson->x, lesson->w);
    else
        sd_add_light(leaf, lesson->w - 1, (double)lesson->column / V_STEPS, lesson->x);
}

static enum cancel at_once(void *context)
{
    (void)context;
    return CANCEL_NOW;
}

/* The box that contains most eye vertices, which learning finds before all else. */
static void find_box(const struct render_job *job, vec3 *low, vec3 *high)
{
    const struct learn_options options = {.use = true, .emission = 1};
    struct render_job first = *job;
    struct tables tables = NO_TABLES;
    first.cancel = at_once;
    learn(&first, &options, &tables);
    const struct regions *r = &tables.regions;
    *low = r->origin;
    *high = add(*low, mul(vec(r->last[0] + 1, r->last[1] + 1, r->last[2] + 1), 1 / r->per_metre));
    tables_free(&tables);
}

/* What all pixels have found in a pass. */
struct finding {
    double n;       /* samples of a pixel */
    rgb *mean;      /* [pixels] of them */
    double *square; /* [pixels] mean of their squared luminances */
};
enum { MOST_PASSES = 20 };

static struct finding sum_up(const rgb *found, long n, long pixels)
{
    struct finding f = {(double)n, mem_alloc((size_t)pixels, sizeof *f.mean),
                        mem_alloc((size_t)pixels, sizeof *f.square)};
    for (long i = 0; i < n * pixels; i++) {
        f.mean[i % pixels] = rgb_add(f.mean[i % pixels], rgb_scale(found[i], 1 / f.n));
        f.square[i % pixels] += sqr(rgb_luminance(found[i])) / f.n;
    }
    return f;
}

/* Into own->trained and own->worth. */
static void combine(struct ppg *own, const struct finding *f, int n, const struct render_job *job)
{
    const struct pixel_rect rect = job->film_rect;
    int width = rect_width(rect), pixels = (int)rect_pixels(rect);
    double variance[2][MOST_PASSES] = {{0}}, sum[2] = {0}, all = 0;
    own->trained = mem_alloc((size_t)pixels, sizeof *own->trained);
    for (int k = 0; k < n; k++)
        all += f[k].n;
    for (int i = 0; i < pixels; i++) {
        double mean = 0;
        for (int k = 0; k < n; k++)
            mean += f[k].n / all * rgb_luminance(f[k].mean[i]);
        for (int k = 0; k < n; k++)
            variance[colour_of(i % width + rect.x0, i / width + rect.y0)][k] +=
                f[k].square[i] - 2 * mean * rgb_luminance(f[k].mean[i]) + sqr(mean);
    }
    for (int colour = 0; colour < 2; colour++) {
        for (int k = 0; k < n; k++)
            sum[colour] += f[k].n / fmax(variance[!colour][k], 1e-200);
        own->worth[colour] = fmin(sum[colour] * fmax(variance[!colour][n - 1], 1e-200), all);
    }
    for (int i = 0; i < pixels; i++) {
        int colour = colour_of(i % width + rect.x0, i / width + rect.y0);
        for (int k = 0; k < n; k++) {
            double weight = f[k].n / fmax(variance[!colour][k], 1e-200) / sum[colour];
            own->trained[i] = rgb_add(own->trained[i], rgb_scale(f[k].mean[i], weight));
        }
    }
}

static void prepare(const struct render_job *job, struct prepared *p)
{
    struct ppg *own = p->own;
    struct trainer t = {.learning = {.job = job, .work = workspaces_new(job->n_threads, job->max_depth), .take = take},
                        .prepared = p};
    struct finding finding[MOST_PASSES];
    long pixels = (long)rect_pixels(job->film_rect);
    vec3 low, high;
    int passes = 0;
    bool going = job->scene->lights.n > 0;
    method_settle(job, p);
    find_box(job, &low, &high);
    sdtree_init(&own->tree, low, high);
    for (long n = 1; 2 * n - 1 <= own->training && going; n *= 2) {
        t.end = n * pixels;
        t.found = mem_alloc((size_t)t.end, sizeof *t.found);
        t.learning.budget = 2 * (double)t.end;
        lessons_learn(&t.learning, trace, &NO_TABLES, 0, t.end);
        going = job_cancelled(job) == CANCEL_NOT;
        if (going) {
            sdtree_build(&own->tree, own->cell * sqrt((double)n));
            finding[passes++] = sum_up(t.found, n, pixels);
        }
        free(t.found);
    }
    if (own->combine && passes > 0)
        combine(own, finding, passes, job);
    while (passes-- > 0) {
        free(finding[passes].mean);
        free(finding[passes].square);
    }
    workspaces_free(t.learning.work, job->n_threads);
}

static void release(struct prepared *p)
{
    sdtree_free(&((struct ppg *)p->own)->tree);
    free(((struct ppg *)p->own)->trained);
}

static const struct field PARAMETERS[] = {PARAMETER_GUIDE(false), {.name = NULL}};
static const struct field OWN[] = {
    {"training", FIELD_INTEGER, offsetof(struct ppg, training), 15, 0, (1 << MOST_PASSES) - 1,
     "most samples of a pixel in all of training", NULL},
    {"cell", FIELD_INTEGER, offsetof(struct ppg, cell), 250, 1, 1 << 30,
     "records of the first pass above which a leaf is halved", NULL},
    {"combine", FIELD_WORD, offsetof(struct ppg, combine), true, 0, 0, "training is a part of the picture", OFF_ON},
    {.name = NULL}};

const struct method method_ppg = {
    .name = "ppg", .help = "practical path guiding [Mueller 2017]: pt that learns from where light arrives",
    .parameters = PARAMETERS, .own = OWN, .own_size = sizeof(struct ppg), .numbers = NUMBERS_OF_PT,
    .rr_threshold = DEFAULT_RR_THRESHOLD, .prepare = prepare, .release = release, .render = render};
