/* aov_files.c: see aov_files.h. */
#include "cli/aov_files.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/os.h"

/* The aov that the word at the beginning of the list names, or N_AOVS. */
static int first_word(const char *list)
{
    size_t n = strcspn(list, ",");
    int i = 0;
    while (i < N_AOVS && (strlen(aov_name((enum aov)i)) != n || strncmp(list, aov_name((enum aov)i), n) != 0))
        i++;
    return i;
}

/* What follows the first word and its comma; NULL: nothing. */
static const char *other_words(const char *list)
{
    const char *comma = strchr(list, ',');
    return comma != NULL ? comma + 1 : NULL;
}

bool aov_check(const char *list, struct error *err)
{
    for (const char *word = list; word != NULL; word = other_words(word))
        if (first_word(word) == N_AOVS)
            return error_set(err, "--aov %s: known are albedo, normal, depth, position, variance, with commas between "
                                  "them", list);
    return true;
}

static bool open_one(const char *picture, enum aov which, struct names *all, struct outputs *out, struct error *err)
{
    const char *dot = strrchr(picture, '.'), *slash = os_last_separator(picture);
    int stem = dot != NULL && (slash == NULL || dot > slash) ? (int)(dot - picture) : (int)strlen(picture);
    size_t size = strlen(picture) + 20;
    char *name = mem_alloc(size, 1);
    struct texts names = {0};
    snprintf(name, size, "%.*s.%s.pfm", stem, picture, aov_name(which));
    texts_add(&names, name);
    bool ok = names_add(all, FILE_WRITTEN, "--aov", name, err) && outputs_open(&names, NULL, PARTS_NONE, out, err);
    free(names.item);
    free(name);
    return ok;
}

bool aov_open(const char *list, const char *picture, struct names *all, struct aov_files *out, struct error *err)
{
    bool ok = true;
    memset(out, 0, sizeof *out);
    if (list != NULL && strcmp(picture, "-") == 0)
        return error_set(err, "--aov needs a picture with a name (-o), to write beside it");
    for (const char *word = list; ok && word != NULL; word = other_words(word)) {
        int which = first_word(word);
        if (out->file[which].n == 0)
            ok = open_one(picture, (enum aov)which, all, &out->file[which], err);
        out->any = true;
    }
    if (!ok)
        aov_abandon(out);
    return ok;
}

bool aov_write(struct aov_files *f, const struct scene *scene, const struct render_options *options,
               const struct film *film, bool quiet, struct error *err)
{
    int width = rect_width(film->rect), height = rect_height(film->rect);
    float *picture[N_AOVS];
    bool ok = true, first_hit = false;
    if (!f->any)
        return true;
    for (int i = 0; i < N_AOVS; i++) {
        picture[i] = mem_alloc((size_t)width * (size_t)height * 3, sizeof *picture[i]);
        first_hit |= i < N_FIRST_HIT && f->file[i].n > 0;
    }
    if (first_hit)
        aov_render(scene, options, picture);
    if (f->file[AOV_VARIANCE].n > 0 && film->iterations < 2) {
        ok = error_set(err, "%s: not written: one sample per pixel shows no variance",
                       f->file[AOV_VARIANCE].file[0].path);
        outputs_abandon(&f->file[AOV_VARIANCE]);
    } else if (f->file[AOV_VARIANCE].n > 0) {
        aov_variance(film, scene->film_scale, picture[AOV_VARIANCE]);
    }
    for (int i = 0; i < N_AOVS; i++) {
        if (f->file[i].n > 0)
            ok = outputs_write(&f->file[i], width, height, picture[i], quiet, ok ? err : NULL) && ok;
        free(picture[i]);
    }
    return ok;
}

void aov_abandon(struct aov_files *f)
{
    for (int i = 0; i < N_AOVS; i++)
        outputs_abandon(&f->file[i]);
}
