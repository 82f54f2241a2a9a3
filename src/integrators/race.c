/* race.c: see race.h. */
#include "integrators/race.h"

#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "base/parallel.h"
#include "learning/patience.h"

enum { SIDE = 16, MOST_PIXELS = SIDE * SIDE, EACH = 75, SAMPLES = 16 }; /* a pixel of EACH, SIDE x SIDE at most */
static const double FIREFLY = 11;

/* What is counted, and its price. Prices were fitted to CPU times; only their ratios count. The price of a light vertex
 * includes its splat. A light point that the guide chooses costs GUIDE more. */
enum item { SAMPLE, EYE_VERTEX, FIRST_POINT, LATER_POINT, FIRST_DRAW, LATER_DRAW, LIGHT_VERTEX, ITEMS };
static const double PRICE[ITEMS] = {1, 1.25, 1.75, 1.75, 2.75, 2.75, 4}, GUIDE = 0.25;

/* How a sample is taken. PLAIN: by a path tracer that chooses lights by power. FIRST: by the first runner. OTHER: with
 * other random numbers. Then as FIRST, with half the count of one kind of strategy. */
enum turn { PLAIN, PLAIN_OTHER, OTHER, FIRST, HALF_FIRST_DRAWS, HALF_LATER_DRAWS, HALF_SPLATS, TURNS };
enum { KINDS = TURNS - HALF_FIRST_DRAWS };

/* A path that contributes x to FIRST. */
struct event {
    int cell;      /* of pixels, in which it is seen */
    enum turn half; /* the turn with half the count of its strategy, if there is one */
    bool direct;   /* light at a first hit */
    double x, weight;
    double share[KINDS]; /* of each kind of strategy in S */
};

/* Sums over samples. */
struct tally {
    double count[ITEMS];
    double value[FIRST + 1][MOST_PIXELS];  /* by turn: luminance of a pixel, and of the splats in its cell */
    double direct[FIRST + 1][MOST_PIXELS]; /* by turn: the part of it that is direct light */
};

/* One sample of each pixel in each turn. */
struct lap {
    enum turn turn;
    struct tile_pixels pixels;
    struct tally tally;
    struct event *event;      /* [n], owned */
    size_t n, capacity, next; /* next: the one that a turn after FIRST meets next */
    struct patience *patience;
    double asked; /* see patience_lasts */
};

struct race {
    const struct render_job *job;
    struct prepared by[TURNS]; /* how each turn samples */
    struct workspace *work;       /* [n_threads], as tile */
    struct tile *tile;
    struct lap lap[SAMPLES];
    struct tally tally; /* of all laps */
    double unit[MOST_PIXELS]; /* brightness in which contributions are measured */
};

/* --- one path ---------------------------------------------------------------------------------------- */

static void joined(void *context, const struct sample *sample, const struct joined *p)
{
    struct lap *l = context;
    bool first = p->t > 1 && (p->s == 0 ? p->z - 1 : p->z)->eye_end == FIRST_HIT; /* s = 0: z is on the light */
    bool direct = first && p->s <= 1;
    enum turn half = p->t == 1 ? HALF_SPLATS : p->s <= 1 ? TURNS : first ? HALF_FIRST_DRAWS : HALF_LATER_DRAWS;
    struct pixel_rect film = l->pixels.rect; /* a splat next to the film counts at its edge */
    int x_seen = p->t == 1 ? int_within(floor(p->px), film.x0, film.x1 - 1) : sample->x;
    int y_seen = p->t == 1 ? int_within(floor(p->py), film.y0, film.y1 - 1) : sample->y;
    int cell = pixels_cell(l->pixels, x_seen, y_seen);
    double x = fabs(rgb_luminance(p->added)); /* that signs of a filter differ is no noise of an image (filter.h) */
    if (l->turn == FIRST && p->t > 1 && p->s > 0)
        l->tally.count[(p->s == 1 ? FIRST_POINT : FIRST_DRAW) + !first]++;
    if (!(rgb_luminance(p->c->value) > 0) || !fits_float(x) || p->s + p->t == 2)
        return; /* in every turn */
    if (l->turn > FIRST) {
        if (l->next >= l->n)
            return; /* what overflows in one turn alone */
        struct event *e = &l->event[l->next++];
        double S = e->weight / p->c->weight * (half == l->turn ? 0.5 : 1); /* S of this turn over that of FIRST */
        e->share[l->turn - HALF_FIRST_DRAWS] = S <= 1 ? fmin(2 * (1 - S), 1) : 0;
        return;
    }
    l->tally.value[l->turn][cell] += x;
    l->tally.direct[l->turn][cell] += direct ? x : 0;
    if (l->turn == FIRST) {
        l->event = mem_grow(l->event, &l->capacity, l->n + 1, sizeof *l->event);
        l->event[l->n++] = (struct event){cell, half, direct, x, p->c->weight, {0}};
    }
}

static void walked(void *context, const struct sample *sample, enum transport mode, const struct vertex *path,
                   int n)
{
    struct lap *l = context;
    (void)sample;
    (void)path;
    if (l->turn == FIRST) {
        l->tally.count[mode == RADIANCE ? EYE_VERTEX : LIGHT_VERTEX] += n;
        l->tally.count[SAMPLE] += mode == RADIANCE;
    }
}

/* --- all laps ---------------------------------------------------------------------------------------- */

static bool enough(void *context)
{
    struct lap *l = context;
    return !patience_lasts(l->patience, &l->asked);
}

static void run_lap(void *context, int64_t number, int slot, int thread)
{
    struct race *r = context;
    struct lap *l = &r->lap[number];
    const struct observer observer = {.context = l, .walked = walked, .joined = joined};
    struct render_job job = *r->job;
    const struct tile_pass pass = {.job = &job, .first = (long)number, .end = (long)number + 1,
                                   .tile = &r->tile[thread], .work = &r->work[thread], .observer = &observer};
    (void)slot;
    job.enough = enough;
    job.enough_context = l;
    for (l->turn = PLAIN; l->turn < TURNS && !enough(l); l->turn++, l->next = 0) {
        bool other = l->turn == OTHER || l->turn == PLAIN_OTHER;
        job.seed = job.eye_seed = hash_combine(hash_combine(r->job->seed, 0x3c6ef372fe94f82bu), other);
        tile_start(pass.tile, l->pixels, job.film_rect, &job.scene->filter);
        r->by[l->turn].method->render(&r->by[l->turn], &pass);
    }
}

static bool add_lap(void *context, int64_t number, int slot)
{
    struct race *r = context;
    struct lap *l = &r->lap[number];
    (void)slot;
    for (int i = 0; i < ITEMS; i++)
        r->tally.count[i] += l->tally.count[i];
    for (int turn = 0; turn <= FIRST; turn++)
        for (int i = 0; i < MOST_PIXELS; i++) {
            r->tally.value[turn][i] += l->tally.value[turn][i];
            r->tally.direct[turn][i] += l->tally.direct[turn][i];
        }
    return patience_count(l->patience, TURNS * pixels_count(l->pixels));
}

/* Run all laps; false if job->watch ends them. */
static bool run(struct race *r)
{
    int n_threads = r->job->n_threads;
    struct parallel_jobs jobs = {SAMPLES, n_threads, SAMPLES, r, run_lap, add_lap, NULL};
    r->work = workspaces_new(n_threads, r->job->max_depth);
    r->tile = mem_alloc((size_t)n_threads, sizeof *r->tile);
    bool all = parallel_run(&jobs) == SAMPLES;
    for (int i = 0; i < n_threads; i++)
        tile_free(&r->tile[i]);
    free(r->tile);
    workspaces_free(r->work, n_threads);
    return all;
}

/* --- predictions ------------------------------------------------------------------------------------- */

/* The square of x >= 0, continued by its tangent above FIREFLY. */
static double huber(double x) { return x < FIREFLY ? x * x : 2 * FIREFLY * x - FIREFLY * FIREFLY; }

static void find_units(struct race *r)
{
    double mean = 0;
    for (const struct lap *l = r->lap; l < r->lap + SAMPLES; l++)
        for (size_t i = 0; i < l->n; i++)
            mean += l->event[i].x / r->tally.count[SAMPLE];
    for (int i = 0; i < MOST_PIXELS; i++) {
        double own = (r->tally.value[OTHER][i] + r->tally.value[FIRST][i]) / (2 * SAMPLES);
        r->unit[i] = 0.75 * own + 0.25 * mean + 1e-30;
    }
}

/* The variance of a sample, summed over all samples, from the difference of two turns. */
static double variance(const struct race *r, const double *a, const double *b)
{
    double sum = 0;
    for (int i = 0; i < MOST_PIXELS; i++)
        sum += SAMPLES * huber(fabs(a[i] - b[i]) / sqrt(2.0 * SAMPLES) / r->unit[i]);
    return sum;
}

static void predict(const struct race *r, struct runner *k)
{
    const struct prepared *p = &r->by[FIRST];
    const struct numbers *most = &p->numbers, *n = &k->numbers;
    const double *count = r->tally.count, credit = p->parameters.credits ? PAIR_CREDIT : 1;
    double times[ITEMS] = {1, 1, (double)n->light_points / most->light_points, 1}; /* as many as of the first */
    double direct = variance(r, r->tally.direct[OTHER], r->tally.direct[FIRST]), square = 0, more[2] = {0, 0};
    for (int end = 0; end < EYE_ENDS && n->path_pixels > 0; end++) {
        times[FIRST_DRAW + end] = (double)n->draws[end] / most_of(most->draws[end], 1);
        times[LIGHT_VERTEX] = (double)most->path_pixels / n->path_pixels;
    }
    k->variance = variance(r, r->tally.value[OTHER], r->tally.value[FIRST]);
    for (const struct lap *l = r->lap; l < r->lap + SAMPLES; l++)
        for (const struct event *e = l->event; e < l->event + l->n; e++) {
            double S = 1, x = e->x / r->unit[e->cell]; /* S_k / S */
            for (int i = 0; i < KINDS; i++)
                S += (times[FIRST_DRAW + i] - 1) * e->share[i];
            S = fmax(S, 1e-9);
            more[e->direct] += (huber(x / S) * S - huber(x)) / (e->half < HALF_SPLATS ? credit : 1);
            square += e->direct ? huber(x) : 0;
        }
    more[1] *= square > 0 ? fmin(direct / square, 1) : 0;
    if (k->plain)
        more[1] = variance(r, r->tally.direct[PLAIN_OTHER], r->tally.direct[PLAIN]) - direct;
    k->variance = fmax(k->variance + more[0] + more[1], 1e-30); /* by chance a difference may be negative */
    k->price = 0;
    for (int i = 0; i < ITEMS; i++) {
        bool guided = (i == FIRST_POINT || i == LATER_POINT) && p->tables->direct.rows > 0 && !k->plain;
        k->price += (PRICE[i] + (guided ? GUIDE : 0)) * times[i] * count[i] / count[SAMPLE];
    }
}

static int find_winner(struct race *r, struct prepared *p)
{
    int best = 0;
    find_units(r);
    for (int i = 0; i < p->n_runners; i++) {
        struct runner *k = &p->runner[i], *b = &p->runner[best];
        predict(r, k);
        best = k->variance * k->price < b->variance * b->price ? i : best;
    }
    return best;
}

/* --- the race ---------------------------------------------------------------------------------------- */

bool race_path_tracer_sees_all(const struct scene *scene)
{
    bool delta_light = false, delta_lobe = false;
    for (int i = 0; i < scene->lights.n; i++)
        delta_light |= light_is_delta(&scene->lights.light[i]);
    for (int i = 0; i < scene->n_materials; i++)
        delta_lobe |= scene->material[i]->row->may_be_delta;
    return !(delta_light && delta_lobe);
}

const struct runner_kind runner_kinds[MAX_RUNNERS] = {
    {"all", "as the parameters say: pathpixels, connections, later, lightpoints"},
    {"quarter", "a light sub-path for four times as many pixels"},
    {"quarter_first", "so, too; one light vertex for each eye vertex that the camera sees, none for others"},
    {"guided", "no light sub-paths: path tracing that has learnt which lights matter where"},
    {"plain", "no light sub-paths: path tracing that chooses lights by power"}};

/* The first COMPLETE runners make every path that the method can make. The others lack strategies: a path tracer must
 * see the light that these would bring. */
static void add_runners(const struct scene *scene, struct prepared *p)
{
    enum { COMPLETE = 2 };
    struct numbers all = p->numbers, quarter = all, quarter_first, guided = all;
    quarter.path_pixels *= 4;
    quarter_first = quarter;
    quarter_first.draws[FIRST_HIT] = all.draws[FIRST_HIT] > 0;
    quarter_first.draws[LATER_HIT] = 0;
    guided.path_pixels = 0;
    const struct runner runner[MAX_RUNNERS] = {
        {.name = "race_all", .numbers = all}, {.name = "race_quarter", .numbers = quarter},
        {.name = "race_quarter_first", .numbers = quarter_first}, {.name = "race_guided", .numbers = guided},
        {.name = "race_plain", .numbers = NUMBERS_OF_PT, .plain = true}};
    p->n_runners = race_path_tracer_sees_all(scene) ? MAX_RUNNERS : COMPLETE;
    memcpy(p->runner, runner, (size_t)p->n_runners * sizeof *runner);
}

/* How a turn samples; it shares all that it points to with *p. */
static struct prepared prepare_turn(const struct prepared *p, enum turn turn)
{
    struct prepared q = *p;
    if (turn == PLAIN || turn == PLAIN_OTHER) {
        q.numbers = (struct numbers)NUMBERS_OF_PT;
        q.counts = counts_of(q.numbers, 1, 1, 0, &NO_TABLES);
    }
    if (turn == HALF_SPLATS)
        q.counts.lens /= 2;
    else if (turn > FIRST)
        q.counts.pair[turn - HALF_FIRST_DRAWS] /= 2;
    return q;
}

void race(const struct render_job *job, struct prepared *p)
{
    struct race *r = mem_alloc(1, sizeof *r);
    struct patience patience = patience_begin(job);
    struct pixel_rect film = job->film_rect;
    int side = int_within(sqrt((double)rect_pixels(film) / EACH), 1, SIDE);
    add_runners(job->scene, p);
    r->job = job;
    for (int i = 0; i < SAMPLES; i++) {
        r->lap[i].patience = &patience;
        r->lap[i].pixels = (struct tile_pixels){film, (rect_width(film) + side - 1) / side,
                                                (rect_height(film) + side - 1) / side, 0, 0};
    }
    for (int turn = 0; turn < TURNS; turn++)
        r->by[turn] = prepare_turn(p, (enum turn)turn);
    p->winner = run(r) ? find_winner(r, p) : 0;
    patience_end(&patience);
    for (int i = 0; i < SAMPLES; i++)
        free(r->lap[i].event);
    free(r);
}
