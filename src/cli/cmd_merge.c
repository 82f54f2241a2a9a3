/* cmd_merge.c: asbdpt merge: parts of a picture's samples added up to the picture, or to a larger part. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "cli/command.h"
#include "cli/outputs.h"
#include "render/part.h"

struct merge_options {
    struct texts output, part;
    struct tone_options tone;
    bool partial, unclamped, quiet;
};

#define AT(member) offsetof(struct merge_options, member)
static const struct option OPTIONS[] = {
    {"PART", NULL, OPTION_TEXTS, AT(part), 1, .help = "a part of an image"},
    {"-o", "FILE", OPTION_TEXTS, AT(output), 1, .alias = "--outfile", .written = true,
     .help = "an image or .part to write; repeatable"},
    {"--partial", NULL, OPTION_ON, AT(partial), .help = "make an image even if samples are missing"},
    TONE_ROWS,
    UNCLAMPED_ROW,
    {"--quiet", NULL, OPTION_ON, AT(quiet), .help = "do not print what was written"}, {.name = NULL}};

struct named {
    const char *path;
    struct part part;
};

struct merge {
    struct named *part; /* [n], by first sample; owned */
    int n;
};

static int by_first(const void *a, const void *b)
{
    const struct named *x = a, *y = b;
    bool same = x->part.first == y->part.first;
    return same ? strcmp(x->path, y->path) : x->part.first < y->part.first ? -1 : 1;
}

/* Every wrong range is said, for parts may be of many jobs. Returns false. */
static bool wrong_range(const char *path, const char *what, long first, long end)
{
    struct error err;
    error_set(&err, "%s%s the samples %ld:%ld", path, what, first, end);
    return fail(&err) == EXIT_OK;
}

/* What the parts say of themselves; files are closed again, for there may be thousands. */
static bool read_headers(struct merge *m, const struct texts *names, bool partial, struct error *err)
{
    m->part = mem_alloc((size_t)names->n, sizeof *m->part);
    for (int i = 0; i < names->n; i++) {
        struct named *p = &m->part[m->n];
        p->path = names->item[i];
        FILE *f = part_open(p->path, &p->part, err);
        if (f == NULL)
            return false;
        fclose(f);
        m->n++;
        if (!part_same(&p->part, p->path, &m->part[0].part, err))
            return false;
        if (p->part.passes > 0 && !partial)
            return error_set(err, "%s: ends in the middle of a block of samples; --resume it first, or take --partial",
                             p->path);
    }
    qsort(m->part, (size_t)m->n, sizeof *m->part, by_first);
    return true;
}

/* Are no samples twice, and none between `first` and `end` in no part unless that is allowed? *reached: the end of the
 * last samples that there are. */
static bool check_ranges(const struct merge *m, long first, long end, bool gaps, long *reached)
{
    bool ok = true;
    *reached = first;
    for (int i = 0; i < m->n; i++) {
        const struct part *p = &m->part[i].part;
        long part_end = p->passes > 0 ? p->end : p->first + p->done;
        if (p->first > *reached && !gaps)
            ok = wrong_range("", "missing are", *reached, p->first);
        if (i > 0 && p->first < *reached && p->first < part_end)
            ok = wrong_range(m->part[i].path, ": other parts have", p->first,
                             part_end < *reached ? part_end : *reached);
        *reached = part_end > *reached ? part_end : *reached;
    }
    if (*reached < end && !gaps)
        ok = wrong_range("", "missing are", *reached, end);
    return ok;
}

static bool add_parts(const struct merge *m, struct film *film, struct error *err)
{
    bool ok = true;
    for (int i = 0; ok && i < m->n; i++) {
        struct part again;
        FILE *f = part_open(m->part[i].path, &again, err);
        ok = f != NULL && part_add(f, m->part[i].path, &again, film, err);
        part_free(&again);
        if (again.passes > 0)
            film_settle(film);
    }
    return ok;
}

static bool write_film(const struct merge_options *o, struct merge *m, long end, struct film *film, struct outputs *out,
                       struct error *err)
{
    struct part whole = m->part[0].part; /* its identity is borrowed */
    float *pixels = mem_alloc((size_t)whole.width * (size_t)whole.height * 3, sizeof *pixels);
    whole.end = end;
    out->place = whole.place;
    out->part = &whole;
    out->film = film;
    out->unclamped = o->unclamped;
    film_warn(film, outputs_develop(out, pixels));
    bool ok = outputs_write(out, whole.width, whole.height, pixels, o->quiet, err);
    free(pixels);
    return ok;
}

/* A picture needs all samples, a part only that nothing is missing between its first and its last. */
static bool merge(const struct merge_options *o, struct merge *m, bool picture, struct outputs *out, struct error *err)
{
    struct film film;
    struct error why;
    long end;
    if (!read_headers(m, &o->part, o->partial, err))
        return false;
    const struct part *first = &m->part[0].part;
    struct pixel_rect rect = {0, 0, first->width, first->height};
    if (!check_ranges(m, picture ? 0 : first->first, picture ? first->planned : 0, o->partial, &end))
        return error_set(err, "nothing was written");
    if (end == first->first)
        return error_set(err, "the parts hold no samples");
    const struct budget memory = budget_new(0, "");
    if (!budget_has(&memory, film_bytes(rect, false), &why))
        return error_set(err, "%s: its film of %dx%d pixels: %s", m->part[0].path, rect.x1, rect.y1, why.text);
    film_init(&film, rect, rect.x1, rect.y1);
    bool ok = add_parts(m, &film, err) && write_film(o, m, end, &film, out, err);
    film_free(&film);
    return ok;
}

static int run(void *options)
{
    const struct merge_options *o = options;
    struct outputs out;
    struct merge m = {0};
    struct error err;
    int n_pictures = 0;
    for (int i = 0; i < o->output.n; i++)
        n_pictures += !file_has_extension(o->output.item[i], ".part");
    if (o->partial && n_pictures < o->output.n)
        return usage_error(&command_merge, "--partial is for images; a part has one range of samples");
    if (!outputs_open(&o->output, &o->tone, true, &out, &err))
        return fail(&err);
    bool ok = merge(o, &m, n_pictures > 0, &out, &err);
    outputs_abandon(&out); /* unless they are written */
    for (int i = 0; i < m.n; i++)
        part_free(&m.part[i].part);
    free(m.part);
    return ok ? EXIT_OK : fail(&err);
}

const struct command command_merge = {
    "merge", "add up parts of an image's samples", {"PART... -o FILE... [options]"}, OPTIONS,
    sizeof(struct merge_options), run, false,
    "merge out/0.part out/1.part -o out/image.exr"};
