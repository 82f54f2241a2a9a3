/* pilot.c: see pilot.h. */
#include "pilot/pilot.h"

#include <string.h>

#include "base/maths.h"
#include "base/number.h"
#include "pilot/first_light.h"

/* Samples per eye vertex (per pixel) of each kind while the pilot runs, and in its absence. The choice moves from the
 * latter by BOLDNESS of the way, on a logarithmic scale: more samples of a kind also take over weight from others, so
 * its variance falls more slowly than 1/n. */
static const double TRIED[N_KINDS] = {4, 4, 4, 0.25}, USUAL[N_KINDS] = {3, 1, 2, 0.25};
static const double BOLDNESS = 2.0 / 3;

/* Draws are stratified over the pool: the weights count them for more than as many independent samples. */
static const double DRAW_CREDIT = 2;

/* What the pilot finds. */
struct choice_of_numbers {
    double n[N_KINDS]; /* samples */
    bool light_paths;  /* are there to be any? */
};

/* In units of a ray that looks for the closest hit; the factors were measured. */
struct costs {
    double fixed, each[N_KINDS];
};

static struct costs costs_of(const struct importance *importance)
{
    const double CONNECTION = 0.6, POINT = 0.8;
    double n_eye = importance->eye_vertices, n_first = importance->first_vertices, n_light = importance->light_vertices;
    double n_later = n_eye - n_first;
    struct costs c = {1 + n_eye + POINT * n_later,
                      {CONNECTION * n_first, CONNECTION * n_later, POINT * n_first, 1 + (1 + CONNECTION) * n_light}};
    return c;
}

/* Is the path tracer alone better at equal time? Light sub-paths cost more than rays: they are kept and chosen from. */
static bool light_paths_pay(const struct costs *c, const double *n, const struct noise *s)
{
    const double KEEPING = 1.08;
    double paths = c->fixed + c->each[LIGHT_FIRST] * n[LIGHT_FIRST], all = paths;
    for (int k = 0; k < N_KINDS; k++)
        all += k == LIGHT_FIRST ? 0 : c->each[k] * n[k];
    return (s->total + s->tail) * paths > KEEPING * s->total * all;
}

static void choose(const struct costs *c, const struct noise *s, struct choice_of_numbers *out)
{
    const double LEAST = 0.2, LEAST_PATH = 0.02; /* shares of the variance that A and light sub-paths have at least */
    double A = fmax(s->total - s->given_eye, LEAST * s->total), b[N_KINDS], drawn = 0;
    for (int k = 0; k < LIGHT_PATH; k++)
        drawn += b[k] = s->spread[k];
    b[LIGHT_PATH] = fmax(fmax(s->given_eye, s->blocks) - drawn, LEAST_PATH * s->total);
    for (int k = 0; k < N_KINDS; k++) {
        double best = c->each[k] > 0 ? sqrt(b[k] * TRIED[k] / c->each[k] * c->fixed / A) : USUAL[k];
        out->n[k] = USUAL[k] * m_pow(fmax(best, 1e-3) / USUAL[k], BOLDNESS);
    }
    out->light_paths = light_paths_pay(c, out->n, s);
}

static void set_numbers(struct subspaces_state *s, const struct choice_of_numbers *c, const struct first_light *light)
{
    struct frozen *f = &s->frozen;
    s->draws[FIRST_HIT] = clamp(c->n[DRAW_FIRST], 0.25, 16);
    s->draws[LATER_HIT] = clamp(c->n[DRAW_LATER], 0.125, 8);
    f->lights = (int)clamp(c->n[LIGHT_FIRST] + 0.5, 1, 8);
    f->path_pixels = c->light_paths ? (int)clamp(1 / c->n[LIGHT_PATH] + 0.5, 1, 64) : 0;
    f->counts.hit[FIRST_HIT] = light->broad;
    f->counts.direct[FIRST_HIT] = light->broad * f->lights;
    f->counts.delta[FIRST_HIT] = light->delta * f->lights;
    for (int end = 0; end < EYE_ENDS; end++)
        f->counts.connect[end] = c->light_paths ? DRAW_CREDIT * s->draws[end] : 0;
}

void pilot_set_draws(struct subspaces_state *s, double C)
{
    for (int end = 0; end < EYE_ENDS; end++) {
        s->frozen.counts.connect[end] *= C / s->draws[end];
        s->draws[end] = C;
    }
}

/* Can a path tracer find all light? What a delta light sends by way of a delta lobe it cannot. */
static bool paths_suffice(const struct scene *scene)
{
    bool delta_light = false, delta_lobe = false;
    for (int i = 0; i < scene->lights.n; i++)
        delta_light |= light_is_delta(&scene->lights.light[i]);
    for (int i = 0; i < scene->n_materials; i++)
        delta_lobe |= scene->material[i]->row->may_be_delta;
    return !(delta_light && delta_lobe);
}

void pilot_run(const struct render_job *job, const struct pilot_method *method, bool free_choice,
               struct subspaces_state *s)
{
    struct choice_of_numbers choice = {.light_paths = true};
    struct first_light light;
    struct noise sums;
    struct costs costs = costs_of(&s->tables.importance);
    struct render_job other = *job;
    other.seed = hash_combine(job->seed, 0x3c6ef372fe94f82bu); /* unlike the render's */
    first_light_measure(&other, &s->tables, method->work, &light);
    memcpy(choice.n, TRIED, sizeof choice.n);
    set_numbers(s, &choice, &light);
    s->frozen.counts.splat = pixel_light_count(job) / s->frozen.path_pixels;
    bool complete = noise_measure(&other, method, s, TRIED, noise_tiles(job), &sums);
    memcpy(choice.n, USUAL, sizeof choice.n);
    if (sums.total > 0 && complete)
        choose(&costs, &sums, &choice);
    choice.light_paths |= !free_choice || !paths_suffice(job->scene);
    set_numbers(s, &choice, &light);
}
