/* identity.c: what a render is of, whatever its number of samples, in lines that must agree where its films are to be
 * continued or added up (part.h): all that changes a byte of a sample. */
#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/bits.h"
#include "base/mem.h"
#include "base/version.h"
#include "render/render.h"

struct lines {
    char *text; /* owned */
    size_t used, capacity;
};

/* One line more; whatever could break a line is replaced. */
static void add_line(struct lines *l, const char *format, ...)
{
    struct error line;
    va_list args;
    va_start(args, format);
    vsnprintf(line.text, sizeof line.text, format, args);
    va_end(args);
    error_clean(line.text);
    size_t n = strlen(line.text);
    l->text = mem_grow(l->text, &l->capacity, l->used + n + 2, 1);
    memcpy(l->text + l->used, line.text, n);
    l->used += n;
    memcpy(l->text + l->used++, "\n", 2);
}

static int by_name(const void *a, const void *b)
{
    const struct setting *const *x = a, *const *y = b;
    return strcmp((*x)->name, (*y)->name);
}

/* In order of their names: -P may give them in any. Long values are told apart by a hash. */
static void add_settings(struct lines *l, const struct settings *s)
{
    const struct setting **item = mem_alloc((size_t)s->n, sizeof *item);
    for (int i = 0; i < s->n; i++)
        item[i] = &s->item[i];
    qsort(item, (size_t)s->n, sizeof *item, by_name);
    for (int i = 0; i < s->n; i++)
        if (strcmp(item[i]->name, "maxdepth") != 0)
            add_line(l, "parameter %.100s %.200s %016" PRIx64, item[i]->name, item[i]->value,
                hash_content(item[i]->value, strlen(item[i]->value)));
    free(item);
}

char *identity_text(const struct scene *scene, const struct render_options *o)
{
    const struct filter *f = &scene->filter;
    struct lines l = {0};
    add_line(&l, "version %s, estimator %d", VERSION, ESTIMATOR);
    add_line(&l, "scene %016" PRIx64, scene->content);
    add_line(&l, "integrator %s", o->integrator);
    add_line(&l, "maxdepth %d", o->max_depth);
    add_settings(&l, &scene->settings);
    add_line(&l, "seed %" PRIu64, o->seed);
    add_line(&l, "filter %d %.17g %.17g %.17g %.17g %.17g %.17g", (int)f->kind, f->radius[0], f->radius[1], f->alpha,
             f->B, f->C, f->tau);
    return l.text;
}
