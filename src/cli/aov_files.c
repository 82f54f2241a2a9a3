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

static bool has_exr(const struct outputs *out, struct error *err)
{
    for (int i = 0; i < out->n; i++)
        if (!out->item[i].is_part && image_keeps_place(out->item[i].file.path))
            return true;
    return error_usage(err, "--layers: no other format has them than .exr; name one by -o");
}

bool aov_open(struct aov_files *f, bool layers, struct names *all, struct outputs *out, struct error *err)
{
    bool ok = true;
    f->first = out->n;
    f->layers = layers;
    if (layers)
        return has_exr(out, err);
    for (int i = 0; ok && i < N_AOVS; i++) {
        const char *picture = out->item[0].file.path;
        if (f->wanted[i] && strcmp(picture, "-") == 0)
            return error_usage(err, "--aov needs a picture with a name (-o), to write beside it");
        ok = !f->wanted[i] || open_one(picture, (enum aov)i, all, out, err);
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

void aov_make(struct aov_files *f, const struct scene *scene, const struct render_options *options,
              const struct film *film, bool seen, struct outputs *out)
{
    bool first_hit = false;
    if (f->first == out->n && !f->layers)
        return;
    for (int i = 0, at = f->first; i < N_AOVS; i++) {
        f->picture[i] = mem_alloc(rect_pixels(film->rect) * 3, sizeof *f->picture[i]);
        first_hit |= i < N_FIRST_HIT && f->wanted[i];
        bool missing = i == AOV_VARIANCE && film->iterations < 2;
        if (f->wanted[i] && f->layers && missing) {
            fprintf(stderr, "asbdpt: warning: %s, so there is no such layer\n", NO_VARIANCE);
        } else if (f->wanted[i] && f->layers) {
            add_layer(out, (enum aov)i, f->picture[i]);
        } else if (f->wanted[i]) {
            out->item[at].missing = missing ? NO_VARIANCE : NULL;
            out->item[at++].pixels = f->picture[i];
        }
    }
    if (first_hit)
        aov_render(scene, options, seen, f->picture);
    if (f->wanted[AOV_VARIANCE])
        aov_variance(film, scene->film_scale, f->picture[AOV_VARIANCE]);
}

void aov_free(struct aov_files *f)
{
    for (int i = 0; i < N_AOVS; i++)
        free(f->picture[i]);
}
