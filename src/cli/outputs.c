/* outputs.c: see outputs.h. */
#include "cli/outputs.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "image/image.h"

static void release(struct outputs *o)
{
    free(o->file);
    o->file = NULL;
    o->n = 0;
}

static bool read_tone(const struct tone_options *t, const struct texts *names, struct tone *out, struct error *err)
{
    struct tone tone = {0, TONE_NONE};
    bool shown = false;
    if (t != NULL) {
        bool filmic = t->curve != NULL && strcmp(t->curve, "filmic") == 0;
        if (t->curve != NULL && !filmic && strcmp(t->curve, "none") != 0)
            return error_set(err, "--tonemap %s: known are none, filmic", t->curve);
        tone.stops = t->exposure;
        tone.curve = filmic ? TONE_FILMIC : TONE_NONE;
    }
    for (int i = 0; i < names->n; i++)
        shown = shown || image_is_8_bit(names->item[i]);
    *out = tone;
    return shown || tone_is_plain(&tone) ||
           error_set(err, "--exposure and --tonemap are for 8-bit pictures (.png, .ppm); none is written");
}

bool outputs_is_part(const char *name)
{
    size_t n = strlen(name);
    return n > 5 && strcmp(name + n - 5, ".part") == 0;
}

static bool takes_part(const struct outputs *o, const char *name)
{
    return o->parts == PARTS_NAMED ? outputs_is_part(name) : o->parts == PARTS_OTHERS && !image_writable(name);
}

bool outputs_open(const struct texts *names, const struct tone_options *tone, enum outputs_parts parts,
                  struct outputs *out, struct error *err)
{
    bool ok = true;
    memset(out, 0, sizeof *out);
    out->parts = parts;
    if (!read_tone(tone, names, &out->tone, err))
        return false;
    out->file = mem_alloc((size_t)names->n, sizeof *out->file);
    for (out->n = 0; ok && out->n < names->n; out->n += ok) {
        const char *name = names->item[out->n];
        bool part = takes_part(out, name);
        if (!part && !image_writable(name))
            ok = error_set(err, "-o %s: pictures are written as " IMAGE_WRITTEN "; end the name in one of these", name);
        else
            ok = part ? file_create(name, &out->file[out->n], err) : image_create(name, &out->file[out->n], err);
    }
    if (!ok)
        outputs_abandon(out);
    return ok;
}

bool outputs_write(struct outputs *o, int width, int height, const float *pixels, bool quiet, struct error *err)
{
    bool ok = true;
    char *written = mem_alloc(1, 1);
    size_t n = (size_t)width * (size_t)height * 3;
    float *shown = tone_is_plain(&o->tone) ? NULL : mem_alloc(n, sizeof *shown);
    if (shown != NULL)
        tone_map(&o->tone, pixels, n, shown);
    for (int i = 0; i < o->n; i++) {
        const char *name = strcmp(o->file[i].path, "-") == 0 ? "standard output" : o->file[i].path;
        size_t size = strlen(written) + strlen(name) + 3;
        char *more = mem_alloc(size, 1);
        snprintf(more, size, "%s%s%s", written, written[0] != '\0' ? ", " : "", name);
        const float *source = shown != NULL && image_is_8_bit(o->file[i].path) ? shown : pixels;
        struct error *why = ok ? err : NULL;
        bool done = takes_part(o, o->file[i].path) ? part_write(&o->file[i], o->part, o->film, why)
                                                   : image_finish(&o->file[i], o->place, width, height, source, why);
        free(done ? written : more);
        written = done ? more : written;
        ok = ok && done;
    }
    if (!quiet && written[0] != '\0')
        fprintf(stderr, "wrote %s\n", written);
    free(written);
    free(shown);
    release(o);
    return ok;
}

void outputs_abandon(struct outputs *o)
{
    for (int i = 0; i < o->n; i++)
        file_abandon(&o->file[i]);
    release(o);
}
