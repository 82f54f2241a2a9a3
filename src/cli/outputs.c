/* outputs.c: see outputs.h. */
#include "cli/outputs.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"

static void release(struct outputs *o)
{
    free(o->item);
    o->item = NULL;
    o->n = 0;
}

static bool read_tone(const struct tone_options *t, const struct texts *names, struct tone *out, struct error *err)
{
    bool shown = false;
    *out = (struct tone){0, TONE_NONE};
    if (t != NULL)
        *out = (struct tone){t->exposure, (enum tone_curve)names_find(TONE_NAMES, t->curve)};
    for (int i = 0; i < names->n; i++)
        shown = shown || image_is_8_bit(names->item[i]);
    return shown || tone_is_plain(out) ||
           error_usage(err, "--exposure and --tonemap are for 8-bit images; none is written");
}

static bool add_file(struct outputs *out, const char *name, bool is_part, struct error *err)
{
    struct output o = {.is_part = is_part};
    if (is_part ? !file_create(name, &o.file, err) : !image_create(name, &o.file, err))
        return false;
    out->item = mem_append(out->item, (size_t)out->n, sizeof *out->item);
    out->item[out->n++] = o;
    return true;
}

bool outputs_open(const struct texts *names, const struct tone_options *tone, bool parts, struct outputs *out,
                  struct error *err)
{
    memset(out, 0, sizeof *out);
    bool ok = read_tone(tone, names, &out->tone, err);
    for (int i = 0; ok && i < names->n; i++)
        ok = add_file(out, names->item[i], parts && file_has_extension(names->item[i], ".part"), err);
    if (!ok)
        outputs_abandon(out);
    return ok;
}

static bool write_one(struct outputs *o, struct output *one, int width, int height, const float *pixels,
                      struct error *err)
{
    const struct raster r = {o->place, width, height, pixels, NULL, 0, o->preview};
    if (!one->is_part)
        return image_finish(&one->file, &r, err);
    if (!part_possible(o->film, one->file.path, err)) {
        file_abandon(&one->file);
        return false;
    }
    part_write(&one->file, o->part, o->film);
    return file_commit(&one->file, err);
}

long outputs_develop(const struct outputs *o, float *out)
{
    long cut = film_develop(o->film, o->part->scale, out);
    for (size_t i = 0; !o->unclamped && i < rect_pixels(o->film->rect) * 3; i++)
        out[i] = out[i] > 0 ? out[i] : 0;
    return cut;
}

bool outputs_write(struct outputs *o, int width, int height, const float *pixels, bool quiet, struct error *err)
{
    bool ok = true;
    size_t n = (size_t)width * (size_t)height * 3;
    float *shown = tone_is_plain(&o->tone) ? NULL : mem_alloc(n, sizeof *shown);
    if (shown != NULL)
        tone_map(&o->tone, pixels, n, shown);
    for (int i = 0; i < o->n; i++) {
        char *name = mem_copy_text(o->item[i].file.path);
        const float *source = shown != NULL && image_is_8_bit(name) ? shown : pixels;
        bool done = write_one(o, &o->item[i], width, height, source, ok ? err : NULL);
        if (done && !quiet)
            say_line("wrote %s", strcmp(name, "-") == 0 ? "standard output" : name);
        ok = ok && done;
        free(name);
    }
    free(shown);
    release(o);
    return ok;
}

bool outputs_preview(const struct outputs *o, struct error *err)
{
    struct outputs first = *o;
    const struct film *f = o->film;
    first.item = NULL;
    first.n = 0;
    first.preview = true;
    if (!add_file(&first, o->item[0].file.path, false, err))
        return false;
    float *pixels = mem_alloc(rect_pixels(f->rect) * 3, sizeof *pixels);
    outputs_develop(o, pixels);
    bool ok = outputs_write(&first, rect_width(f->rect), rect_height(f->rect), pixels, true, err);
    free(pixels);
    return ok;
}

bool outputs_previews(const struct outputs *o, struct error *err)
{
    const struct output *first = &o->item[0]; /* what is no file has no temporary one */
    return (!first->is_part && first->file.temporary != NULL) ||
           error_usage(err, "--preview: %s: the first output must be an image file", first->file.path);
}

void outputs_abandon(struct outputs *o)
{
    for (int i = 0; i < o->n; i++)
        file_abandon(&o->item[i].file);
    release(o);
}

bool outputs_end(struct outputs *o, const struct image *about, int width, int height, float *pixels, bool quiet,
                 struct error *err)
{
    bool ok = pixels != NULL;
    if (ok) {
        o->place = about->place;
        ok = outputs_write(o, width, height, pixels, quiet, err);
    }
    outputs_abandon(o); /* unless they are written */
    free(pixels);
    return ok;
}

bool outputs_possible(const char *name, struct error *err)
{
    struct file_output probe;
    bool ok = file_create(name, &probe, err);
    if (ok)
        file_abandon(&probe);
    return ok;
}
