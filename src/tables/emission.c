/* emission.c: see emission.h. */
#include "tables/emission.h"

#include <stdlib.h>
#include <string.h>

#include "base/alias.h"
#include "base/mem.h"
#include "base/number.h"

enum { SIDE = EMISSION_SIDE, BINS = EMISSION_BINS };

static int bin_of(const double u[2])
{
    return int_within(u[0] * SIDE, 0, SIDE - 1) * SIDE + int_within(u[1] * SIDE, 0, SIDE - 1);
}

/* --- sums -------------------------------------------------------------------------------------------- */

void emission_sums_init(struct emission_sums *s, const struct light_set *lights)
{
    s->columns = light_columns_new(lights, EMISSION_COLUMNS);
    s->square = mem_alloc((size_t)s->columns.n * BINS, sizeof *s->square);
}

void emission_sums_add(struct emission_sums *s, int cell, const double u[2], double I)
{
    s->square[(size_t)(cell / s->columns.cells_each) * BINS + (size_t)bin_of(u)] += I * I;
}

/* --- the table --------------------------------------------------------------------------------------- */

/* The mean of n squares, regularised towards m_above (emission.h). */
static double shrunk(double sum, double n, double above)
{
    const double K = 4; /* number of rays that m_above counts as */
    return (sum + K * above) / (n + K);
}

/* m of the bins of a column with n rays: first of the column, then of its 2 x 2, 4 x 4 and 8 x 8 parts, each from the
 * part that contains it. */
static void mean_squares(const double *square, double n, double above, double *m)
{
    m[0] = shrunk(sum_of(square, BINS), n, above);
    for (int side = 2; side <= SIDE; side *= 2) {
        double wider[BINS], sum[BINS] = {0};
        memcpy(wider, m, BINS * sizeof *m);
        for (int b = 0; b < BINS; b++)
            sum[b / SIDE * side / SIDE * side + b % SIDE * side / SIDE] += square[b];
        for (int i = 0; i < side * side; i++)
            m[i] = shrunk(sum[i], n / (side * side), wider[i / side / 2 * (side / 2) + i % side / 2]);
    }
}

/* Write the sums of a column's rows; returns their sum. */
static double sum_rows(const double *q, double row[SIDE])
{
    for (int i = 0; i < SIDE; i++)
        row[i] = sum_of(&q[i * SIDE], SIDE);
    return sum_of(row, SIDE);
}

struct emission emission_build(struct emission_sums *s, double rays, double delta)
{
    struct emission e = {.columns = s->columns};
    int n = e.columns.n;
    double m[BINS] = {0}, row[SIDE], total = 0, all = n * BINS > 0 ? sum_of(s->square, n * BINS) / rays : 0;
    e.q = mem_alloc((size_t)n * BINS, sizeof *e.q);
    for (int c = 0; c < n; c++) {
        mean_squares(&s->square[c * BINS], rays * e.columns.power[c], all, m);
        for (int b = 0; b < BINS; b++)
            total += e.q[c * BINS + b] = e.columns.power[c] * sqrt(m[b]);
    }
    for (int i = 0; i < n * BINS; i++) {
        double even = e.columns.power[i / BINS] / BINS;
        e.q[i] = total > 0 ? delta * even + (1 - delta) * e.q[i] / total : even;
    }
    e.before = mem_alloc((size_t)n + 1, sizeof *e.before);
    for (int c = 0; c < n; c++)
        e.before[c + 1] = e.before[c] + sum_rows(&e.q[c * BINS], row);
    free(s->square);
    return e;
}

void emission_free(struct emission *e)
{
    light_columns_free(&e->columns);
    free(e->q);
    free(e->before);
}

/* --- use --------------------------------------------------------------------------------------------- */

/* Draw one of SIDE parts with the uniform number u, which becomes the point in [0,1), uniform within that part. */
static int fall(const double *part, double *u)
{
    double rest = *u * sum_of(part, SIDE);
    int i = 0;
    while (i < SIDE - 1 && rest >= part[i])
        rest -= part[i++];
    *u = below_one((i + fmin(rest / part[i], 1)) / SIDE);
    return i;
}

/* rho / q = B / e, the same for all bins of a column; 0 if its power is 0. */
static double per_q(const struct emission *e, int column)
{
    return e->columns.power[column] > 0 ? BINS / e->columns.power[column] : 0;
}

int emission_draw(const struct emission *e, const struct light_set *lights, double u, double direction[2],
                  double *rho)
{
    *rho = 1;
    if (e->q == NULL)
        return alias_sample(&lights->choice, u, NULL, NULL);
    int column, cell = light_columns_draw(&e->columns, lights, e->before, u, &column);
    const double *q = &e->q[column * BINS];
    double row[SIDE];
    sum_rows(q, row);
    q += SIDE * fall(row, &direction[0]);
    *rho = per_q(e, column) * q[fall(q, &direction[1])];
    return cell;
}

static double ratio_of_cell(const struct emission *e, const struct light_set *lights, const struct light_point *y0,
                            vec3 p, vec3 w)
{
    double u[2];
    int column = y0->cell / e->columns.cells_each;
    light_emission_numbers(lights, y0, p, w, u);
    return per_q(e, column) * e->q[column * BINS + bin_of(u)];
}

double emission_density(const struct emission *e, const struct light_set *lights, const struct light_point *y0, vec3 p,
                        vec3 w)
{
    if (e->q == NULL)
        return 1;
    if (y0->light >= 0)
        return ratio_of_cell(e, lights, y0, p, w);
    double guided = 0, by_power = 0;
    struct light_point at = *y0;
    for (int i = 0; i < lights->n_infinite; i++) {
        at.light = lights->infinite[i];
        double pdf = light_pdf_towards(lights, at.light, y0->w, &at.cell);
        by_power += pdf;
        guided += pdf > 0 ? pdf * ratio_of_cell(e, lights, &at, p, w) : 0;
    }
    return by_power > 0 ? guided / by_power : 0;
}
