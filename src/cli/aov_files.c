/* aov_files.c: render --aov; see render_files.h. */
#include "cli/render_files.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/os.h"
#include "image/image.h"

static const char NO_VARIANCE[] = "one sample per pixel shows no variance";

bool aov_read(const char *list, struct aov_files *out, struct error *err)
{
    memset(out, 0, sizeof *out);
    for (const char *word = list; word != NULL;) {
        size_t n = strcspn(word, ",");
        int i = 0;
        while (i < N_AOVS && (strlen(aov_name((enum aov)i)) != n || strncmp(word, aov_name((enum aov)i), n) != 0))
            i++;
        if (i == N_AOVS)
            return error_usage(err, "--aov %s: known are albedo, normal, depth, position, variance, with commas "
                                    "between them", list);
        out->wanted[i] = true;
        word = word[n] == ',' ? word + n + 1 : NULL;
    }
    return true;
}

static bool open_one(const char *picture, enum aov which, struct names *all, struct outputs *out, struct error *err)
{
    const char *dot = strrchr(picture, '.'), *slash = os_last_separator(picture);
    int stem = dot != NULL && (slash == NULL || dot > slash) ? (int)(dot - picture) : (int)strlen(picture);
    size_t size = strlen(picture) + 20;
    char *name = mem_alloc(size, 1);
    snprintf(name, size, "%.*s.%s.pfm", stem, picture, aov_name(which));
    bool ok = names_add(all, FILE_WRITTEN, "--aov", name, err) && outputs_add(out, name, false, err);
    free(name);
    return ok;
}

/* Every .exr a second time: it is whole without layers while these are made. */
static bool open_layers(struct aov_files *f, const struct outputs *pictures, struct error *err)
{
    bool ok = true;
    for (int i = 0; ok && i < pictures->n; i++)
        if (!pictures->item[i].is_part && image_keeps_place(pictures->item[i].file.path))
            ok = outputs_add(&f->out, pictures->item[i].file.path, false, err);
    return ok && (f->out.n > 0 ||
                  error_usage(err, "--layers: no other format has them than .exr; name one by -o"));
}

bool aov_open(struct aov_files *f, bool layers, struct names *all, const struct outputs *pictures, struct error *err)
{
    bool ok = true;
    f->layers = layers;
    if (layers)
        return open_layers(f, pictures, err);
    for (int i = 0; ok && i < N_AOVS; i++) {
        const char *picture = pictures->item[0].file.path;
        if (f->wanted[i] && strcmp(picture, "-") == 0)
            return error_usage(err, "--aov needs a picture with a name (-o), to write beside it");
        ok = !f->wanted[i] || open_one(picture, (enum aov)i, all, &f->out, err);
    }
    return ok;
}

/* The channels of a picture, at most three. */
static void add_layer(struct outputs *out, enum aov which, const float *picture)
{
    static const char *const NAMES[N_AOVS][3] = {{"albedo.R", "albedo.G", "albedo.B"},
                                                 {"normal.X", "normal.Y", "normal.Z"},
                                                 {"depth.Z", NULL, NULL},
                                                 {"position.X", "position.Y", "position.Z"},
                                                 {"variance.R", "variance.G", "variance.B"}};
    for (int c = 0; c < 3 && NAMES[which][c] != NULL; c++)
        out->layer[out->n_layers++] = (struct channel){NAMES[which][c], picture + c, 3, true};
}

/* Say where each comes from; of one sample there is no variance. */
static void place(struct aov_files *f, bool has_variance)
{
    struct outputs *out = &f->out;
    for (int i = 0, at = 0; i < N_AOVS; i++) {
        bool missing = i == AOV_VARIANCE && !has_variance;
        if (f->wanted[i] && f->layers && missing) {
            fprintf(stderr, "asbdpt: warning: %s, so there is no such layer\n", NO_VARIANCE);
        } else if (f->wanted[i] && f->layers) {
            add_layer(out, (enum aov)i, f->picture[i]);
        } else if (f->wanted[i]) {
            out->item[at].missing = missing ? NO_VARIANCE : NULL;
            out->item[at++].pixels = f->picture[i];
        }
    }
}

bool aov_write(struct aov_files *f, const struct scene *scene, const struct render_options *options,
               const struct film *film, bool seen, const float *pixels, bool quiet, struct error *err)
{
    struct render_options first = *options;
    bool first_hit = false, ok = true;
    if (f->out.n == 0)
        return true;
    first.end = film->iterations > 0 ? film->iterations : 1;
    for (int i = 0; i < N_AOVS; i++) {
        f->picture[i] = mem_alloc(rect_pixels(film->rect) * 3, sizeof *f->picture[i]);
        first_hit |= i < N_FIRST_HIT && f->wanted[i];
    }
    if (f->wanted[AOV_VARIANCE])
        aov_variance(film, scene->film_scale, f->picture[AOV_VARIANCE]);
    if (!first_hit || aov_render(scene, &first, seen, f->picture)) {
        place(f, film->iterations > 1);
        ok = outputs_write(&f->out, rect_width(film->rect), rect_height(film->rect), pixels, quiet, err);
    } else {
        fprintf(stderr, "asbdpt: --aov: not written, for there are pixels that have not been looked at\n");
    }
    for (int i = 0; i < N_AOVS; i++)
        free(f->picture[i]);
    return ok;
}
