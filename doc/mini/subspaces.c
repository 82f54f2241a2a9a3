/* subspaces.c: the default method, draws that know who asks, in an addition to asbdpt.c, to be read after it:
 *     cc -O2 -o mini subspaces.c -lm && ./mini subspaces 64 out.ppm
 *
 * `vertices` gives a light vertex one worth, whoever asks. But the wall behind the gap is worth much to the floor that
 * faces it, and nothing to the wall beside it. So learn a table h(e,l): what a light vertex in cell l of space is worth
 * to an eye vertex in cell e. An eye vertex z draws light vertex v of the row's pool with probability
 *     P(v|z) = (1 - delta) h(e(z),l(v)) L_v / sum + delta / size,     L_v = luminance(beta_v),
 * and divides by it: unbiased whatever h is. The weights count n = DRAWS h(e,l) samples, a function of both ends of the
 * edge, on which all strategies of a path agree. A table for each cell that asks costs more time here than it saves; in
 * src a tile shares them, regions are found, and a pilot chooses how many to draw. */
#define main main_of_asbdpt
#include "asbdpt.c"
#undef main

enum { PLACES = CELLS * CELLS * CELLS, PARENTS = PLACES / 8, TRIALS = 2 * SIZE * SIZE, KAPPA = 4 };

/* ---- Learning (src/learning/pairs_pass.c)   ---------------------------------------------------------------------
 * A trial joins an eye vertex z in e to a light vertex y in l, unweighted, and notes what arrives,
 *     x = luminance(connection) / w,     with the weight w = luminance(beta_z) luminance(beta_y).
 * There are more pairs than trials, so the mean of a pair leans on that of the cells twice as large that hold the two:
 *     m(e,l) = (sum w x + kappa w_mean m(e',l')) / (sum w + kappa w_mean). */
struct lessons {
    struct lesson { double wx, w; } pair[PLACES][PLACES], parent[PARENTS][PARENTS];
    double visits[PLACES]; /* light vertices there, per light sub-path */
    double w, n;           /* the weights of all trials, and how many there were */
};

static int parent(int at) /* the cell twice as large that holds this one */
{
    return (at / CELLS / CELLS / 2 * (CELLS / 2) + at / CELLS % CELLS / 2) * (CELLS / 2) + at % CELLS / 2;
}

static void try_pairs(struct lessons *s, const struct vertex *eye, int n_eye, const struct light_path *light)
{
    const struct counts alone = {0, 0, 1, 0, NULL, 0}; /* no other strategy: the weight is 1 */
    for (int j = 1; j < light->n; j++) {
        const struct vertex *y = &light->v[j];
        s->visits[place(y->p)] += connectible(y) ? 1.0 / TRIALS : 0;
        for (int i = 1; i < n_eye && connectible(y); i++) {
            int e = place(eye[i].p), l = place(y->p);
            struct lesson *to[] = {&s->pair[e][l], &s->parent[parent(e)][parent(l)]};
            double wx = luminance(connect(&alone, y, &eye[i])), w = luminance(eye[i].beta) * luminance(y->beta);
            for (int k = 0; k < 2 && connectible(&eye[i]); k++) {
                to[k]->wx += wx;
                to[k]->w += w;
            }
            s->w += w;
            s->n++;
        }
    }
}

/* h [PLACES][PLACES]: m, such that a light sub-path is worth 1 to every e, mixed with delta. Frozen from here on. */
static void learn_pairs(struct lessons *s, double *h, uint64_t *rng)
{
    const struct counts n = {0, 0, 0, 0, NULL, 0};
    struct vertex eye[EYE_VERTICES];
    struct light_path light;
    for (int i = 0; i < TRIALS; i++) {
        path_light(&n, &light, 0, rng);
        try_pairs(s, eye, path_eye(&n, i % SIZE, i / SIZE % SIZE, eye, rng), &light);
    }
    double lean = KAPPA * s->w / s->n;
    for (int e = 0; e < PLACES; e++) {
        double sum = 0, *row = h + e * PLACES;
        for (int l = 0; l < PLACES; l++) {
            const struct lesson *own = &s->pair[e][l], *large = &s->parent[parent(e)][parent(l)];
            double mean = large->w > 0 ? large->wx / large->w : 0;
            row[l] = (own->wx + lean * mean) / (own->w + lean);
            sum += row[l] * s->visits[l];
        }
        for (int l = 0; l < PLACES; l++)
            row[l] = sum > 0 ? (1 - DELTA) * row[l] / sum + DELTA : 1;
    }
}

/* ---- Drawing (src/integrators/subspaces.c) -------------------------------------------------------------------------
 * A table over the row's light vertices for every cell from which somebody asks, made when the first does. */
struct table {
    double q[PLACES][TABLE];
    struct bin bin[PLACES][TABLE];
    bool made[PLACES];
};

static void make_table(struct table *t, struct work *w, const struct counts *n, int e)
{
    double *q = t->q[e], sum = 0;
    for (int v = 0; v < TABLE; v++) {
        const struct vertex *y = &w->path[v / DEPTH].v[v % DEPTH + 1];
        bool usable = v % DEPTH + 1 < w->path[v / DEPTH].n && connectible(y);
        q[v] = usable ? luminance(y->beta) * n->worth[e * n->row + place(y->p)] : 0;
        sum += q[v];
    }
    for (int v = 0; v < TABLE; v++)
        q[v] = sum > 0 ? (1 - DELTA) * q[v] / sum + DELTA / TABLE : 1.0 / TABLE;
    alias_build(t->bin[e], q, TABLE, w->scratch);
    t->made[e] = true;
}

/* DRAWS light vertices for z; a light sub-path of more than `max` vertices would make the path too long. */
static rgb draw(struct table *t, struct work *w, const struct counts *n, const struct vertex *z, int max, uint64_t *rng)
{
    rgb sum = BLACK;
    int e = place(z->p);
    if (!t->made[e])
        make_table(t, w, n, e);
    for (int c = 0; c < DRAWS; c++) {
        int b = (int)(next(rng) * TABLE), v = alias_choose(t->bin[e], b, next(rng)), k = v / DEPTH, s = v % DEPTH + 2;
        if (s <= w->path[k].n && s <= max)
            sum = add(sum, mul(connect(n, &w->path[k].v[s - 1], z), 1 / (DRAWS * SIZE * t->q[e][v])));
    }
    return sum;
}

static void render_subspaces(struct work *w, struct table *t, const double *h, int spp, uint64_t *rng)
{
    const struct counts n = {1, 1, DRAWS, SIZE * SIZE, h, PLACES};
    struct vertex eye[EYE_VERTICES];
    for (int i = 0; i < SIZE * spp; i++) { /* row by row, as render does */
        memset(t->made, 0, sizeof t->made);
        for (int k = 0; k < SIZE; k++) {
            path_light(&n, &w->path[k], 0, rng);
            splat_path(&n, &w->path[k], w->image);
        }
        for (int x = 0, y = i / spp; x < SIZE; x++) {
            int n_eye = path_eye(&n, x, y, eye, rng);
            rgb sum = sum_eye(&n, eye, n_eye, rng), *pixel = &w->image[y * SIZE + x];
            for (int j = 1; j < n_eye && j < DEPTH; j++)
                sum = connectible(&eye[j]) ? add(sum, draw(t, w, &n, &eye[j], DEPTH + 1 - j, rng)) : sum;
            *pixel = add(*pixel, sum);
        }
    }
}

int main(int argc, char **argv)
{
    if (argc < 4 || strcmp(argv[1], "subspaces") != 0 || atoi(argv[2]) < 1)
        return main_of_asbdpt(argc, argv);
    uint64_t rng = argc > 4 ? (uint64_t)strtoul(argv[4], NULL, 10) << 40 : 0;
    struct { struct work work; struct lessons lessons; struct table tables; double h[PLACES * PLACES]; } *all;
    FILE *f = fopen(argv[3], "wb");
    if ((all = calloc(1, sizeof *all)) == NULL || f == NULL)
        return perror(argv[3]), 1;
    learn_pairs(&all->lessons, all->h, &rng);
    render_subspaces(&all->work, &all->tables, all->h, atoi(argv[2]), &rng);
    write_picture(f, strstr(argv[3], ".pfm") != NULL, all->work.image, 1.0 / atoi(argv[2]));
    free(all);
    bool good = !ferror(f);
    return fclose(f) == 0 && good ? 0 : (perror(argv[3]), 1);
}
