/* test_table.c: tables (table.h): means are those of the definition, sample by sample; draws have the probabilities
 * that the ratios tell, everywhere above 0 where a column may be drawn; nothing changes while samples are taken. */
#include "tables/table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/rng.h"
#include "lab/numbers.h"
#include "lab/stats.h"
#include "bench.h"
#include "helpers.h"
#include "suites.h"

/* --- the definition ----------------------------------------------------------------------------------- */

enum { FEW = 3, LEVELS = 3, NODES = 1 + FEW + FEW * FEW, SAMPLES = 400 };

/* FEW nodes below each of two levels, but one of those one level up stays without. */
struct tree {
    int above[NODES], level[NODES];
    struct axis axis;
};

static void grow(struct tree *t)
{
    for (int i = 0; i < NODES; i++) {
        t->above[i] = i == 0 ? 0 : (i - 1) / FEW;
        t->level[i] = i == 0 ? LEVELS - 1 : i <= FEW ? 1 : 0;
    }
    t->axis = (struct axis){NODES - FEW, t->above, t->level};
}

struct sample_of_table {
    int r, c;
    double x, w;
};

/* Does node i contain node k? */
static bool contains(struct axis a, int i, int k)
{
    while (a.above != NULL && k > i)
        k = a.above[k];
    return k == i;
}

static int level(struct axis a, int i) { return a.above != NULL ? a.level[i] : 0; }

/* A sample counts for a pair that contains it and has one level, or the coarser of its two own nodes and a finer
 * one. */
static bool counts_for(struct axis row, struct axis column, const struct sample_of_table *s, int r, int c)
{
    if (!contains(row, r, s->r) || !contains(column, c, s->c))
        return false;
    if (row.above == NULL || column.above == NULL)
        return true;
    int finer = level(row, r) - level(column, c);
    return finer == 0 || (finer > 0 ? r == s->r : c == s->c);
}

/* m(r,c), multiplied out. */
static double mean(const struct sample_of_table *s, struct axis row, struct axis column, int r, int c)
{
    double worth = 0, weight = 0, all = 0, mean_weight = 0, above;
    for (int i = 0; i < SAMPLES; i++) {
        bool here = counts_for(row, column, &s[i], r, c);
        worth += here ? s[i].w * s[i].x : 0;
        weight += here ? s[i].w : 0;
        all += s[i].w * s[i].x / SAMPLES;
        mean_weight += s[i].w / SAMPLES;
    }
    bool up_r = row.above != NULL && r > 0, up_c = column.above != NULL && c > 0;
    if (!up_r && !up_c)
        above = all / mean_weight;
    else if (up_r && up_c && level(row, r) != level(column, c))
        above = level(row, r) < level(column, c) ? mean(s, row, column, row.above[r], c)
                                                 : mean(s, row, column, r, column.above[c]);
    else
        above = mean(s, row, column, up_r ? row.above[r] : r, up_c ? column.above[c] : c);
    return (worth + 4 * mean_weight * above) / (weight + 4 * mean_weight);
}

/* Probabilities of columns: of nodes without others below; every third is 0. */
static double probabilities(double *e, int n)
{
    double sum = 0;
    for (int c = 0; c < n; c++)
        sum += e[c] = c % 3 == 0 ? 0 : 1 + c % 5;
    for (int c = 0; c < n; c++)
        e[c] /= sum;
    return sum;
}

static struct table learnt(struct rng *rng, struct axis row, struct axis column, const double *e, double delta,
                           bool root, struct sample_of_table *s)
{
    struct table t = table_learn(row.n + 2, column.n); /* room for more rows than there will be */
    for (int i = 0; i < SAMPLES; i++) {
        s[i].r = (int)rng_below(rng, (uint32_t)row.n);
        s[i].c = (int)rng_below(rng, (uint32_t)column.n);
        s[i].x = rng_below(rng, 3) == 0 ? 0 : (1 + s[i].r) * (1 + s[i].c) * rng_uniform(rng);
        s[i].w = 0.1 + rng_uniform(rng);
        table_add(&t, row, column, s[i].r, s[i].c, s[i].x, s[i].w);
    }
    table_build(&t, row, column, e, delta, root, true);
    return t;
}

static void check_ratios(struct test *t, const struct table *table, const struct sample_of_table *s, struct axis row,
                         struct axis column, const double *e, double delta, bool root)
{
    double worst = 0, least = INFINITY, sums = 0;
    for (int r = 0; r < row.n; r++) {
        double sum = 0, all = 0;
        for (int c = 0; c < column.n; c++) {
            double m = mean(s, row, column, r, c);
            sum += e[c] * (root ? sqrt(m) : m);
            all += e[c] * table_ratio(table, r, c);
            least = fmin(least, table_ratio(table, r, c));
        }
        for (int c = 0; c < column.n; c++) {
            double m = mean(s, row, column, r, c), ratio = (1 - delta) * (root ? sqrt(m) : m) / sum + delta;
            worst = most_of(worst, fabs(table_ratio(table, r, c) / ratio - 1));
        }
        sums = most_of(sums, fabs(all - 1));
    }
    CHECK(t, worst < 1e-9, "%d x %d: ratios are off by a factor of %g", row.n, column.n, worst + 1);
    CHECK(t, sums < 1e-9 && least >= delta, "probabilities add up to 1 + %g, a ratio is %g", sums, least);
}

/* --- draws -------------------------------------------------------------------------------------------- */

/* Draws from a span against e ratio, and, as a plant, against e; what is left of the numbers is uniform. */
static void check_draws(struct test *t, struct rng *rng, const struct table *table, const double *e, int r,
                        int first, int n, int each)
{
    enum { DRAWS = 20000 };
    double count[2 * NODES] = {0}, expected[2 * NODES] = {0}, even[2 * NODES] = {0}, left[DRAWS], pmf, all = 0, off = 0;
    double e_all = 0;
    for (int k = 0; k < n * each; k++) {
        int c = first + k;
        expected[k / each] += e[c] * table_ratio(table, r, c);
        even[k / each] += e[c];
        all += e[c] * table_ratio(table, r, c);
        e_all += e[c];
    }
    for (int i = 0; i < DRAWS; i++) {
        int k = table_draw(table, r, first, n, each, rng_uniform(rng), &pmf, &left[i]);
        off = most_of(off, fabs(pmf / (expected[k] / all) - 1));
        count[k]++;
        CHECK(t, left[i] >= 0 && left[i] < 1, "%g is left of a number", left[i]);
    }
    for (int k = 0; k < n; k++) {
        expected[k] *= DRAWS / all;
        even[k] *= DRAWS / e_all;
    }
    CHECK(t, off < 1e-9, "a draw tells a probability that is off by a factor of %g", off + 1);
    TEST_ACCEPT(t, stats_chi2_test(count, expected, (size_t)n), "draws of row %d", r);
    TEST_REJECT(t, stats_chi2_test(count, even, (size_t)n), "draws of row %d, as if nothing were learnt", r);
    TEST_ACCEPT(t, stats_ks_uniform_p(left, DRAWS), "what is left of numbers");
}

/* The largest and the least number draw a column that can be drawn. */
static void check_ends(struct test *t, const struct table *table, const double *e, int r)
{
    const double ends[] = {0, 1 - 0x1p-53, 1};
    for (int i = 0; i < 3; i++)
        for (int from = 0; from < table->columns; from++)
            for (int to = from + 1; to <= table->columns; to++) {
                double pmf, left, any = 0;
                for (int c = from; c < to; c++)
                    any += e[c];
                if (!(any > 0))
                    continue;
                int c = from + table_draw(table, r, from, to - from, 1, ends[i], &pmf, &left);
                CHECK(t, c < to && e[c] > 0 && pmf > 0 && left >= 0 && left < 1,
                      "%.17g among columns %d to %d draws %d with probability %g, %g is left", ends[i], from, to, c,
                      pmf, left);
            }
}

static void test_learnt(struct test *t, struct rng *rng)
{
    struct tree tree;
    grow(&tree);
    const struct axis axes[][2] = {{{1, NULL, NULL}, {9, NULL, NULL}}, {tree.axis, {7, NULL, NULL}},
                                   {{1, NULL, NULL}, tree.axis}, {tree.axis, tree.axis}};
    for (int k = 0; k < 8; k++) {
        struct axis row = axes[k / 2][0], column = axes[k / 2][1];
        struct sample_of_table s[SAMPLES];
        double e[NODES], delta = k % 2 == 0 ? 0.1 : 0.4;
        probabilities(e, column.n);
        struct table table = learnt(rng, row, column, e, delta, k % 2 == 1, s);
        CHECK(t, table.rows == row.n && table.columns == column.n, "%d x %d", table.rows, table.columns);
        check_ratios(t, &table, s, row, column, e, delta, k % 2 == 1);
        check_draws(t, rng, &table, e, row.n - 1, 0, column.n, 1);
        check_draws(t, rng, &table, e, row.n / 2, 1, column.n / 2 - 1, 2);
        check_ends(t, &table, e, row.n - 1);
        table_free(&table);
    }
}

/* --- tables without samples, or of one row ------------------------------------------------------------ */

static void test_special(struct test *t)
{
    const struct axis row = {2, NULL, NULL}, column = {3, NULL, NULL};
    const double e[3] = {0.25, 0.25, 0.5}, m[3] = {8, 0, 1};
    struct table none = table_learn(2, 3), dark = table_learn(2, 3);
    table_build(&none, row, column, e, 0.1, false, true);
    CHECK(t, none.rows == 0 && table_ratio(&none, 1, 2) == 1, "a table without samples is not empty");
    table_add(&dark, row, column, 1, 1, 0, 1);
    table_build(&dark, row, column, e, 0.1, false, true);
    for (int i = 0; i < 6; i++)
        CHECK(t, dark.rows == 2 && table_ratio(&dark, i / 3, i % 3) == 1, "nothing is worth anything: ratio %g",
              table_ratio(&dark, i / 3, i % 3));
    struct table one = table_of_row(m, e, 3, 0.1), no = table_of_row(NULL, e, 3, 0.1);
    const double expected[3] = {0.9 * 8 / 2.5 + 0.1, 0.1, 0.9 / 2.5 + 0.1};
    for (int c = 0; c < 3; c++)
        CHECK(t, fabs(table_ratio(&one, 0, c) / expected[c] - 1) < 1e-12 &&
                     table_row(&one, 5)[c] == table_row(&one, 0)[c],
              "column %d of one row: %g, not %g", c, table_ratio(&one, 0, c), expected[c]);
    CHECK(t, no.rows == 0 && table_ratio(&no, 0, 1) == 1, "no row is a row");
    table_free(&none);
    table_free(&dark);
    table_free(&one);
    table_free(&no);
}

/* --- frozen ------------------------------------------------------------------------------------------- */

/* The FNV-1a hash of all numbers. */
static uint64_t sum_of_table(const struct table *table)
{
    size_t n = (size_t)table->rows * (size_t)table->columns * sizeof *table->ratio;
    uint64_t hash = 14695981039346656037u;
    for (size_t i = 0; i < n; i++)
        hash = (hash ^ ((const unsigned char *)table->ratio)[i]) * 1099511628211u;
    return hash;
}

/* The tables of a render are the same after it. */
static void test_frozen(struct test *t)
{
    struct scene scene;
    struct bench b;
    if (!scene_from_file(t, "scenes/many-lights.pbrt", 16, 16, &scene))
        return;
    if (bench_new(t, &scene, set_method(&scene, "asbdpt race=off"), 4, 0, &b)) {
        const struct tables *known = b.prepared.tables;
        const struct table *table[] = {&known->guide, &known->pairs, &known->emission};
        uint64_t before[3];
        int regions = known->regions.n;
        for (int i = 0; i < 3; i++)
            before[i] = sum_of_table(table[i]);
        struct tile_pass pass = bench_pass(&b, 0, 2);
        b.prepared.method->render(&b.prepared, &pass);
        for (int i = 0; i < 3; i++)
            CHECK(t, table[i]->rows > 0 && sum_of_table(table[i]) == before[i], "table %d changes in a render", i);
        CHECK(t, known->regions.n == regions, "a render adds %d regions", known->regions.n - regions);
        bench_free(&b);
    }
    scene_free(&scene);
}

void test_table(struct test *t)
{
    struct rng rng = rng_stream(test_seed(t), RNG_TEST, 94, 0);
    test_learnt(t, &rng);
    test_special(t);
    test_frozen(t);
}
