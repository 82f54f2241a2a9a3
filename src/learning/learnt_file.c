/* learnt_file.c: see learnt_file.h. One function goes over all that there is, for writing as for reading. */
#include "learning/learnt_file.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "image/zlib.h"

enum { MOST = 1 << 25 }; /* numbers in an array */

struct stream {
    struct bytes *bytes;
    size_t at;    /* where it is read */
    bool writing;
    bool ok;      /* so far */
};

static void number(struct stream *s, uint64_t *x)
{
    struct bytes *b = s->bytes;
    if (s->writing)
        b->data = mem_grow(b->data, &b->capacity, b->n + 8, 1);
    else if (!s->ok || b->n - s->at < 8) {
        s->ok = false;
        *x = 0;
        return;
    }
    uint8_t *byte = &b->data[s->writing ? b->n : s->at];
    uint64_t read = 0;
    for (int i = 0; i < 8; i++) {
        if (s->writing)
            byte[i] = (uint8_t)(*x >> 8 * i);
        read |= (uint64_t)byte[i] << 8 * i;
    }
    *x = read;
    b->n += s->writing ? 8 : 0;
    s->at += 8;
}

/* low <= *x <= high. */
static void whole(struct stream *s, int *x, int low, int high)
{
    uint64_t n = (uint64_t)*x;
    number(s, &n);
    bool good = n >= (uint64_t)low && n <= (uint64_t)high;
    s->ok = s->ok && good;
    if (!s->writing)
        *x = good ? (int)n : low;
}

/* Finite and >= low. */
static void real(struct stream *s, double *x, double low)
{
    uint64_t bits;
    memcpy(&bits, x, sizeof bits);
    number(s, &bits);
    double read;
    memcpy(&read, &bits, sizeof read);
    bool good = read >= low && read <= 1e300;
    s->ok = s->ok && good;
    if (!s->writing)
        *x = good ? read : 1;
}

/* n numbers >= 0, for which there is room after reading. */
static void reals(struct stream *s, double **x, int n)
{
    if (!s->writing) {
        s->ok = s->ok && (s->bytes->n - s->at) / 8 >= (size_t)n; /* or the file promises more than it has */
        *x = mem_alloc(s->ok ? (size_t)n : 0, sizeof **x);
    }
    for (int i = 0; s->ok && i < n; i++)
        real(s, &(*x)[i], 0);
}

static void regions(struct stream *s, struct regions *r)
{
    real(s, &r->origin.x, -1e300);
    real(s, &r->origin.y, -1e300);
    real(s, &r->origin.z, -1e300);
    real(s, &r->per_metre, 1e-300);
    for (int k = 0; k < 3; k++)
        whole(s, &r->last[k], 0, 1 << 19);
    whole(s, &r->n_levels, 1, REGION_LEVELS);
    whole(s, &r->limit, 1, MOST);
    int n = r->n;
    whole(s, &n, 1, r->limit);
    uint64_t *key = mem_alloc(s->writing ? (size_t)n : 1, sizeof *key);
    if (s->writing)
        regions_keys(r, key);
    else
        regions_start(r);
    for (int i = 1; s->ok && i < n; i++) {
        uint64_t *k = &key[s->writing ? i : 0];
        number(s, k);
        if (!s->writing)
            s->ok = s->ok && regions_restore(r, *k) == i;
    }
    free(key);
}

static void guide(struct stream *s, struct learnt *l, const struct light_set *lights)
{
    struct guide *g = &l->guide;
    int columns = g->columns.n;
    if (!s->writing)
        guide_start(g, lights);
    whole(s, &columns, g->columns.n, g->columns.n);
    whole(s, &g->n, 1, l->eye.n);
    if (!s->ok)
        g->n = 0;
    reals(s, &g->before, g->n * (g->columns.n + 1));
    for (int i = 1; s->ok && i < g->n * (g->columns.n + 1); i++) /* sums rise */
        s->ok = i % (g->columns.n + 1) == 0 || g->before[i] >= g->before[i - 1];
}

static void emission(struct stream *s, struct learnt *l, const struct light_set *lights)
{
    struct emission *e = &l->emission;
    int columns = e->columns.n;
    if (!s->writing)
        emission_start(e, lights);
    whole(s, &columns, e->columns.n, e->columns.n);
    for (int i = 0; s->ok && i < columns * EMISSION_BINS; i++)
        real(s, &e->q[i], 0);
    s->ok = s->ok && (s->writing || (columns > 0 && emission_freeze(e)));
}

static void pairs(struct stream *s, struct learnt *l)
{
    struct pairs *p = &l->pairs;
    whole(s, &p->n_eye, 1, l->eye.n);
    whole(s, &p->n_light, l->light.n, l->light.n);
    s->ok = s->ok && (p->n_eye == 1 || p->n_eye == l->eye.n) && p->n_eye <= MOST / p->n_light;
    if (s->ok)
        reals(s, &p->h, p->n_eye * p->n_light);
}

static void importance(struct stream *s, struct importance *g)
{
    double *const means[] = {&g->light_vertices, &g->eye_vertices, &g->first_vertices, &g->mean, &g->useful};
    whole(s, &g->n, 0, MOST);
    reals(s, &g->E, g->n);
    whole(s, &g->n_vertices, 0, MOST);
    reals(s, &g->vertices, g->n_vertices);
    for (size_t i = 0; i < sizeof means / sizeof means[0]; i++)
        real(s, means[i], 0);
}

static void everything(struct stream *s, struct learnt *l, const struct light_set *lights)
{
    int guided = l->guided, paired = l->paired, aimed = l->aimed;
    whole(s, &guided, 0, 1);
    whole(s, &paired, 0, 1);
    whole(s, &aimed, 0, 1);
    regions(s, &l->eye);
    regions(s, &l->light);
    if (s->ok)
        importance(s, &l->importance);
    if (s->ok && guided)
        guide(s, l, lights);
    if (s->ok && paired)
        pairs(s, l);
    if (s->ok && aimed)
        emission(s, l, lights);
    for (int i = 0; s->ok && i < LEARNT_NUMBERS; i++)
        real(s, &l->number[i], 0);
    l->guided = s->ok && guided;
    l->paired = s->ok && paired;
    l->aimed = s->ok && aimed;
}

static int head(uint64_t of, char *text, size_t size)
{
    return snprintf(text, size, "asbdpt learnt 2\nof %016" PRIx64 "\n", of);
}

void learnt_write(const struct learnt *l, uint64_t of, struct bytes *out)
{
    char text[64];
    size_t n = (size_t)head(of, text, sizeof text);
    struct learnt copy = *l; /* it is only read */
    struct stream s = {out, 0, true, true};
    out->data = mem_grow(out->data, &out->capacity, n, 1);
    memcpy(out->data, text, n);
    out->n = n;
    everything(&s, &copy, NULL);
    uint32_t crc = checksum_crc32(0, out->data, out->n);
    out->data = mem_grow(out->data, &out->capacity, out->n + 4, 1);
    for (int i = 0; i < 4; i++)
        out->data[out->n++] = (uint8_t)(crc >> 8 * i);
}

bool learnt_read(struct learnt *l, const struct light_set *lights, uint64_t of, const struct bytes *in,
                 const char *name, struct error *err)
{
    char text[64];
    size_t n = (size_t)head(of, text, sizeof text), line = strcspn(text, "\n") + 1;
    if (in->n < n + 4 || memcmp(in->data, text, line) != 0)
        return error_set(err, "%s: this is no file of what has been learnt", name);
    uint32_t crc = 0;
    for (int i = 0; i < 4; i++)
        crc |= (uint32_t)in->data[in->n - 4 + (size_t)i] << 8 * i;
    if (crc != checksum_crc32(0, in->data, in->n - 4))
        return error_set(err, "%s: the file is damaged", name);
    if (memcmp(in->data, text, n) != 0)
        return error_set(err, "%s: this was learnt for another picture, or with other parameters", name);
    struct bytes body = {in->data, in->n - 4, in->n - 4};
    struct stream s = {&body, n, false, true};
    everything(&s, l, lights);
    learnt_freeze(l);
    return (s.ok && s.at == body.n) || error_set(err, "%s: the file is damaged", name);
}
