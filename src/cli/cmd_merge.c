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
    bool partial, quiet;
};

#define AT(member) offsetof(struct merge_options, member)
static const struct option OPTIONS[] = {
    {"PART", NULL, OPTION_TEXTS, AT(part), 1, .help = "a part of a picture"},
    {"-o", "FILE", OPTION_TEXTS, AT(output), 1, .alias = "--outfile", .written = true,
     .help = "a picture to write, or .part; repeatable"},
    {"--partial", NULL, OPTION_ON, AT(partial), .help = "make a picture even where samples are missing"},
    {"--exposure", "EV", OPTION_NUMBER, AT(tone.exposure), -100, 100, .fallback = "0", .help = EXPOSURE_HELP},
    {"--tonemap", "NAME", OPTION_TEXT, AT(tone.curve), .help = TONEMAP_HELP},
    {"--quiet", NULL, OPTION_ON, AT(quiet), .help = "do not say what was written"}, {.name = NULL}};

struct named {
    const char *path;
    struct part part;
};

struct merge {
    struct named *part; /* [n], by first sample; owned */
    int n, n_wrong;
};

static int by_first(const void *a, const void *b)
{
    const struct named *x = a, *y = b;
    bool same = x->part.first == y->part.first;
    return same ? strcmp(x->path, y->path) : x->part.first < y->part.first ? -1 : 1;
}

/* All that is wrong is said, not only the first. */
static void wrong(struct merge *m, const char *text)
{
    fprintf(stderr, "asbdpt: %s\n", text);
    m->n_wrong++;
}

static void wrong_range(struct merge *m, const char *path, const char *what, long first, long end)
{
    struct error err;
    error_set(&err, "%s%s%s samples %ld:%ld", path, path[0] != '\0' ? ": " : "", what, first, end);
    wrong(m, err.text);
}

/* What the parts say of themselves; files are closed again, for there may be thousands. */
static void read_headers(struct merge *m, const struct texts *names)
{
    struct error err;
    m->part = mem_alloc((size_t)names->n, sizeof *m->part);
    for (int i = 0; i < names->n; i++) {
        struct named *p = &m->part[m->n];
        p->path = names->item[i];
        FILE *f = part_open(p->path, &p->part, &err);
        if (f == NULL) {
            wrong(m, err.text);
            continue;
        }
        fclose(f);
        m->n++;
        if (!part_same(&p->part, p->path, &m->part[0].part, &err))
            wrong(m, err.text);
        else if (p->part.passes > 0)
            wrong_range(m, p->path, "stands in the middle of a block (see --resume) of the", p->part.first,
                        p->part.end);
    }
    qsort(m->part, (size_t)m->n, sizeof *m->part, by_first);
}

/* Samples twice, and samples between `first` and `end` in no part unless that is allowed. Returns the end of the last
 * samples that there are. */
static long check_ranges(struct merge *m, long first, long end, bool gaps)
{
    long reached = first;
    for (int i = 0; i < m->n; i++) {
        const struct part *p = &m->part[i].part;
        long part_end = p->first + p->done;
        if (p->first > reached && !gaps)
            wrong_range(m, "", "missing are the", reached, p->first);
        if (i > 0 && p->first < reached && p->done > 0)
            wrong_range(m, m->part[i].path, "other parts have the", p->first, part_end < reached ? part_end : reached);
        reached = part_end > reached ? part_end : reached;
    }
    if (reached < end && !gaps)
        wrong_range(m, "", "missing are the", reached, end);
    return reached;
}

/* Is the part what it was when it was opened first? */
static bool unchanged(const struct part *p, const char *path, const struct part *before, struct error *err)
{
    return part_same(p, path, before, err) &&
           ((p->first == before->first && p->end == before->end && p->done == before->done &&
             p->passes == before->passes && p->left_out == before->left_out) ||
            error_set(err, "%s: the part has changed while it was read", path));
}

static void add_parts(struct merge *m, struct film *film)
{
    struct error err;
    for (int i = 0; i < m->n && m->n_wrong == 0; i++) {
        struct part again;
        const char *path = m->part[i].path;
        FILE *f = part_open(path, &again, &err);
        bool same = f != NULL && unchanged(&again, path, &m->part[i].part, &err);
        if (!same || !part_add(f, path, &again, film, &err))
            wrong(m, err.text);
        if (f != NULL && !same)
            fclose(f);
        if (f != NULL)
            part_free(&again);
    }
}

static bool write_film(const struct merge_options *o, struct merge *m, long end, struct film *film, struct outputs *out,
                       struct error *err)
{
    struct part whole = m->part[0].part; /* its identity is borrowed */
    float *pixels = mem_alloc((size_t)whole.width * (size_t)whole.height * 3, sizeof *pixels);
    float *alpha = film_alpha(film);
    whole.end = end;
    film_warn(film, film_develop(film, whole.scale, pixels));
    out->place = whole.place;
    out->alpha = alpha;
    out->part = &whole;
    out->film = film;
    bool ok = outputs_write(out, whole.width, whole.height, pixels, o->quiet, err);
    free(alpha);
    free(pixels);
    return ok;
}

/* A picture needs all samples, a part only that nothing is missing between its first and its last. */
static bool merge(const struct merge_options *o, struct merge *m, bool picture, struct outputs *out, struct error *err)
{
    bool ok = false;
    read_headers(m, &o->part);
    if (m->n_wrong == 0) {
        struct film film;
        const struct part *first = &m->part[0].part;
        struct pixel_rect rect = {0, 0, first->width, first->height};
        long end = check_ranges(m, picture ? 0 : first->first, picture ? first->planned : 0, o->partial);
        film_init(&film, rect, rect.x1, rect.y1);
        film_keep_planes(&film, first->planes);
        add_parts(m, &film);
        ok = m->n_wrong == 0 && write_film(o, m, end, &film, out, err);
        film_free(&film);
    }
    if (m->n_wrong > 0) {
        outputs_abandon(out);
        error_set(err, "nothing was written");
    }
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
        n_pictures += !outputs_is_part(o->output.item[i]);
    if (o->partial && n_pictures < o->output.n)
        return usage_error(&command_merge, "--partial is for pictures; a part has one range of samples");
    if (!outputs_open(&o->output, &o->tone, PARTS_NAMED, &out, &err))
        return fail(&err);
    bool ok = merge(o, &m, n_pictures > 0, &out, &err);
    for (int i = 0; i < m.n; i++)
        part_free(&m.part[i].part);
    free(m.part);
    return ok ? EXIT_OK : fail(&err);
}

const struct command command_merge = {
    "merge", "add up parts of a picture's samples", {"PART... -o FILE... [options]"}, OPTIONS,
    sizeof(struct merge_options), run, false,
    "merge 0.part 1.part -o picture.exr"};
