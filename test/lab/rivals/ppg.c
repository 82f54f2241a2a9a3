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
 * What differs from the papers:
 *   - Training is a fixed number of samples, which are not part of the image: a render may go on, so its length is not
 *     known. The papers give half of all samples to the last pass, or combine passes by their inverse variances.
 *   - a is found by Newton's method and kept between 0.1 and 0.9. The papers take Adam with a term of regularisation.
 *   - Roulette is that of `pt`, by the throughput that the path would have if the BSDF had drawn all directions: a path
 *     towards light has a low one. The first paper's takes expected contributions; its author's program has none.
 * The tree does not see normals and materials. Delta lobes and all scattering in media are left to the BSDF. Like `pt`,
 * it misses what delta lights send through mirrors and glass. Without training it is `pt` to the bit.
 *
 * Tests: test_rivals.c.
 */
#include <stddef.h>

#include "base/warp.h"
#include "learning/training.h"
#include "rivals/plain.h"
#include "rivals/sdtree.h"

struct ppg_state {
    struct frozen frozen;
    int training, cell;
    struct sdtree tree;
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
        z->pdf_rev = from.pdf_rev;
        met = walk_on(w, from, path, n, n + 1, RADIANCE) > n;
        n += met;
    }
    return n;
}

/* s = 1, as pixel_sum_direct. */
static void sum_direct(struct pixel_sample *sample, const struct vertex *z, int t, const struct sd_leaf *guide)
{
    struct lit l;
    struct connection c = {.light = -1, .cell = -1};
    if (connect_light_point(sample->scene, sample->counts, z, &sample->sampler, 0, 1, &l)) {
        if (guide != NULL)
            l.pdf_z = mixed(guide, l.pdf_z, quadtree_pdf(&guide->known, l.w));
        c = connect_lit(sample->scene, sample->counts, &l);
    }
    pixel_add(sample, &c, 1, t, NULL, z, NO_CHOICE);
}

/* A sample of a pixel, not ended. Its vertices are in the workspace; returns their number, and of each the step. */
static int trace_pixel(const struct ppg_state *s, const struct tile_pass *pass, struct pixel_sample *sample,
                       struct step **step)
{
    const struct render_job *job = pass->job;
    struct vertex *eye = pass->work->eye;
    int most = sample->max_depth + 2;
    uint64_t pixel = (uint64_t)sample->y * (uint64_t)job->scene->width + (uint64_t)sample->x;
    struct sampler sampler = sampler_start(job->eye_seed, RNG_EYE, pixel, (uint64_t)sample->iteration);
    const struct walk w = {job->scene, sample->counts, &pass->work->arena, &sampler, job->rr_threshold};
    arena_reset(&pass->work->arena);
    *step = arena_alloc(&pass->work->arena, (size_t)most * sizeof **step);
    int n = path_eye_pixel(&w, sample->x, sample->y, eye, 2, &sample->filter_weight);
    n = walk_guided(&s->tree, &w, eye, *step, n, most);
    for (const struct observer *o = sample->observer; o != NULL; o = o->next)
        if (o->walked != NULL)
            o->walked(o->context, sample, RADIANCE, eye, n);
    for (int t = 2; t <= n; t++) {
        pixel_sum_hit(sample, eye, t);
        if (eye[t - 1].kind != VERTEX_ESCAPED && t < most)
            sum_direct(sample, &eye[t - 1], t, (*step)[t - 1].guide);
        (*step)[t - 1].before = sample->value;
    }
    return n;
}

static void render(const struct preparation *m, const struct tile_pass *pass)
{
    const struct ppg_state *s = m->state;
    struct step *step;
    for (long iteration = pass->first; iteration < pass->end; iteration++)
        for (int i = 0, x, y; pass_pixel(pass, i, &x, &y); i++) {
            struct pixel_sample sample = pixel_sample_begin(pass, &s->frozen.counts, x, y, iteration);
            trace_pixel(s, pass, &sample, &step);
            pixel_sample_end(&sample);
        }
}

/* --- training ---------------------------------------------------------------------------------------- */

static double ratio(rgb a, rgb b)
{
    return rgb_luminance(rgb_make(b.r > 0 ? a.r / b.r : 0, b.g > 0 ? a.g / b.g : 0, b.b > 0 ? a.b / b.b : 0));
}

/* The step from vertex z, and what the sample found behind it. */
static void record(struct findings *out, const struct sdtree *tree, const struct vertex *z, const struct step *step,
                   rgb found, struct sampler *sampler)
{
    vec3 size, p = z->p;
    sdtree_find(tree, p, &size);
    p.x += size.x * (sampler_number(sampler, DRAW_ORDER) - 0.5);
    p.y += size.y * (sampler_number(sampler, DRAW_ORDER) - 0.5);
    p.z += size.z * (sampler_number(sampler, DRAW_ORDER) - 0.5);
    uint64_t leaf = (uint64_t)sdtree_find(tree, p, NULL);
    struct finding way = {.kind = TRIAL, .eye = leaf, .x = ratio(found, z->beta), .w = step->odds};
    struct finding light = {.kind = LIGHT_SEEN, .eye = leaf, .x = ratio(found, step->from.beta) / step->from.pdf};
    warp_sphere_inverse(step->from.ray.d, &light.u[0], &light.u[1]);
    findings_add(out, way);
    if (!step->from.delta)
        findings_add(out, light);
}

/* Sample i of a pass of n samples a pixel, which have the numbers -n, -n - 1 ... for all pixels in turn. */
static void trace(const struct pass *p, int thread, long i, struct findings *out)
{
    const struct ppg_state *s = p->context;
    const struct pixel_rect rect = p->training->job->film_rect;
    struct tile tile = {.sum = NULL}; /* counts what is not finite */
    const struct tile_pass pass = {.job = p->training->job, .tile = &tile, .work = &p->training->work[thread]};
    long width = rect_width(rect), pixels = width * rect_height(rect), at = i % pixels;
    struct step *step;
    struct pixel_sample sample = pixel_sample_begin(&pass, &s->frozen.counts, rect.x0 + (int)(at % width),
                                                    rect.y0 + (int)(at / width), -(p->end + i) / pixels);
    for (int t = trace_pixel(s, &pass, &sample, &step); t >= 2; t--)
        if (step[t - 1].guide != NULL && step[t - 1].left && sample.filter_weight != 0) {
            rgb found = rgb_sub(sample.value, step[t - 1].before);
            record(out, &s->tree, &pass.work->eye[t - 1], &step[t - 1], rgb_scale(found, 1 / sample.filter_weight),
                   &sample.sampler);
        }
}

static void take(void *context, const struct finding *f)
{
    struct ppg_state *s = context;
    struct sd_leaf *leaf = &s->tree.node[f->eye].leaf;
    if (f->kind == TRIAL)
        sd_add_record(leaf, f->x, f->w);
    else
        sd_add_light(leaf, f->u[0], f->u[1], f->x);
}

static void prepare(const struct render_job *job, struct preparation *out)
{
    struct ppg_state *s = out->state;
    struct training t = {.job = job, .work = workspaces_new(job->n_threads, job->max_depth),
                         .patience = patience_begin(job)};
    struct pass pass = {.training = &t, .context = s, .trace = trace, .take = take};
    vec3 low, high;
    s->frozen.services.emission = 1; /* there are no light sub-paths */
    plain_prepare(job, out);
    train_extent(&t, &low, &high);
    sdtree_init(&s->tree, low, high);
    for (long n = 1; 2 * n - 1 <= s->training && !t.patience.over; n *= 2) {
        pass.end = n * (long)pixel_light_count(job);
        pass_run(&pass);
        if (!t.patience.over)
            sdtree_build(&s->tree, s->cell * sqrt((double)n));
    }
    patience_end(&t.patience);
    workspaces_free(t.work, job->n_threads);
}

static void release(void *state)
{
    struct ppg_state *s = state;
    sdtree_free(&s->tree);
}

#define AT(member) offsetof(struct ppg_state, member)
static const struct field PARAMETERS[] = {
    {"training", FIELD_INTEGER, AT(training), 15, 0, 1 << 20, "most samples of a pixel in all of training", NULL},
    {"cell", FIELD_INTEGER, AT(cell), 250, 1, 1 << 30, "records of the first pass above which a leaf is halved", NULL},
    SERVICE_GUIDE(false), SERVICE_CREDIT(1),
    {.name = NULL}};

const struct method method_ppg = {
    .name = "ppg", .help = "practical path guiding [Mueller 2017]: pt that learns from where light arrives",
    .parameters = PARAMETERS, .state_size = sizeof(struct ppg_state),
    .numbers = {.light_points = 1, .path_tracing = true}, .rr_threshold = DEFAULT_RR_THRESHOLD, .prepare = prepare,
    .release = release, .render = render};
