/* test_bins.c: the bias of the dissertation's bins, predicted by arithmetic.
 *
 * Two closed rooms have a light each, of equal power, and walls of albedo .8 and .2. Half of the light sub-paths begin
 * in each room, and all have as many vertices. So of a bin with a sub-path of each room, the bright room's is taken
 * with the probability p = 1 / (1 + r^2), r = (.2 / .8)^(maxdepth - 1). What follows is a Markov chain of one bin. The
 * share of the bright room among the sub-paths that are used is its share of the image's indirect light, and 1/2 would
 * be right. The program uses sub-paths in these proportions.
 */
#include <math.h>
#include <stdio.h>

#include "bench.h"
#include "helpers.h"
#include "lab/stats.h"
#include "suites.h"

enum { SIDE = 32, DEPTH = 4, MOST_BINS = 4, MOST_VISITS = 16, BLOCKS = SIDE * SIDE };

static const char ROOMS[] =
    "LookAt -3 0 -1  -3 0 0  0 1 0 Camera \"perspective\" Film \"image\" \"integer xresolution\" 32\n"
    "\"integer yresolution\" 32 WorldBegin\n"
    "LightSource \"point\" \"point from\" [-3 0 0] LightSource \"point\" \"point from\" [3 0 0]\n"
    "Material \"matte\" \"rgb Kd\" [.8 .8 .8] Translate -3 0 0 Shape \"sphere\" \"float radius\" 2\n"
    "Material \"matte\" \"rgb Kd\" [.2 .2 .2] Translate 6 0 0 Shape \"sphere\" \"float radius\" 2 WorldEnd\n";

/* --- the prediction ------------------------------------------------------------------------------------ */

/* A bin: when it is visited, and with which probability a bright sub-path is taken if the other one is dark. */
struct bin {
    int visit[MOST_VISITS], n, max_age;
    double p;
};

/* How many bright sub-paths are used from visit j on, on average. One element is known, the other one is fresh. */
static double used_from(const struct bin *b, int j, int bright, int born)
{
    double sum = 0;
    if (j == b->n)
        return 0;
    if (b->max_age > 0 && b->visit[j] - born > b->max_age)
        return 0.5 * (used_from(b, j, 0, born + b->max_age + 1) + used_from(b, j, 1, born + b->max_age + 1));
    for (int other = 0; other < 2; other++) {
        double p = bright == other ? 0.5 : bright ? b->p : 1 - b->p;
        int other_born = j > 0 ? b->visit[j - 1] : 0;
        sum += p * (bright + used_from(b, j + 1, other, other_born)) +
               (1 - p) * (other + used_from(b, j + 1, bright, born));
    }
    return sum / 2;
}

/* In a block a pixel visits bins by van der Corput's sequence from a random start: mean over many starts. */
static double predict(int bin_paths, int restart, int max_age, double p)
{
    enum { STARTS = 16 };
    double sum = 0;
    for (int start = 0; start < STARTS; start++) {
        struct bin bin[MOST_BINS] = {{{0}, 0, 0, 0}};
        for (int i = 0; i < restart; i++) {
            double x = (start + 0.5) / STARTS, digit = 0.5;
            for (int bits = i; bits > 0; bits /= 2, digit /= 2)
                x += bits % 2 * digit;
            struct bin *b = &bin[(int)((x - floor(x)) * (bin_paths / 2))];
            b->visit[b->n++] = i;
        }
        for (int i = 0; i < bin_paths / 2; i++) {
            bin[i].max_age = max_age;
            bin[i].p = p;
            sum += 0.5 * (used_from(&bin[i], 0, 0, 0) + used_from(&bin[i], 0, 1, 0));
        }
    }
    return sum / (STARTS * restart);
}

/* --- the program --------------------------------------------------------------------------------------- */

/* The sub-paths that one pixel uses, and how many of them are the bright room's. */
struct uses {
    double used[BLOCKS], bright[BLOCKS];
};

static void note_use(void *context, const struct sample *sample, const struct joined *path)
{
    struct uses *u = context;
    if (path->t != 1 || path->s != 2) /* once for each sub-path */
        return;
    u->used[sample->y * SIDE + sample->x]++;
    u->bright[sample->y * SIDE + sample->x] += path->path[0].light == 0;
}

/* p-value: is the share of the bright room as predicted? */
static double p_of_share(struct test *t, struct scene *scene, const char *way, int restart, double share, double *found)
{
    struct uses u = {{0}, {0}};
    struct bench b;
    const struct observer observer = {.context = &u, .joined = note_use};
    double sum = 0, square = 0;
    if (!bench_new(t, scene, set_method(scene, way), DEPTH, 0, &b))
        return NAN;
    struct tile_pass pass = bench_pass(&b, 0, restart);
    pass.observer = &observer;
    b.prepared.method->render(&b.prepared, &pass);
    bench_free(&b);
    for (int i = 0; i < BLOCKS; i++) {
        CHECK(t, u.used[i] == restart, "%s: pixel %d uses %g sub-paths", way, i, u.used[i]);
        sum += u.bright[i] / restart / BLOCKS;
    }
    for (int i = 0; i < BLOCKS; i++)
        square += pow(u.bright[i] / restart - sum, 2) / (BLOCKS - 1);
    *found = sum;
    return stats_normal_p((sum - share) / sqrt(square / BLOCKS));
}

void test_bins(struct test *t)
{
    static const struct {
        int bin_paths, restart;
    } cases[] = {{2, 8}, {8, 8}, {8, 32}};
    double r = pow(0.25, DEPTH - 1), p = 1 / (1 + r * r), found;
    struct scene scene;
    if (!scene_from_text(t, ROOMS, &scene))
        return;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
        for (int printed = 0; printed < 2; printed++) {
            char way[128];
            int n = cases[i].bin_paths, restart = cases[i].restart;
            double share = predict(n, restart, 24, printed ? 1 - p : p);
            snprintf(way, sizeof way, "asbdpt select=bins binpaths=%d restart=%d order=%s", n, restart,
                     printed ? "printed" : "text");
            double p_share = p_of_share(t, &scene, way, restart, share, &found);
            TEST_ACCEPT(t, p_share, "%s: the bright room has %.3f times its light, predicted %.3f", way, 2 * found,
                        2 * share);
            TEST_REJECT(t, p_of_share(t, &scene, way, restart, 0.5, &found), "%s, if nothing were lost", way);
        }
    scene_free(&scene);
}
