/* methods.c: the table of all methods, and what is done with a row (method.h). A new method is a new line here. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "integrators/method.h"
#include "learning/learnt_file.h"
#include "transport/caustic.h"

extern const struct method method_pt, method_lt, method_bdpt, method_bins, method_pool, method_vertices,
    method_subspaces, method_lvc, method_cbdpt;

static const struct method *const METHODS[] = {&method_pt,       &method_lt,   &method_bdpt,
                                               &method_subspaces, &method_bins, &method_pool,
                                               &method_vertices, &method_lvc,  &method_cbdpt, NULL};

const struct method *const *method_list(void) { return METHODS; }

/* The rows of a name, which stand side by side: the first, and how many. */
static const struct method *const *rows_of(const char *name, int *n)
{
    const struct method *const *first = METHODS;
    name = strcmp(name, "path") == 0 ? "pt" : name;
    while (*first != NULL && strcmp((*first)->name, name) != 0)
        first++;
    for (*n = 0; first[*n] != NULL && strcmp(first[*n]->name, name) == 0;)
        ++*n;
    return first;
}

bool method_exists(const char *name)
{
    int n;
    rows_of(name, &n);
    return n > 0;
}

const struct method *method_find(const char *name, const struct settings *s, struct error *err)
{
    enum { MOST = 16 };
    const char *words[MOST + 1] = {NULL};
    int n, which = 0;
    const struct method *const *row = rows_of(name, &n);
    if (n == 0) {
        error_set(err, "there is no integrator \"%s\"", name);
        return NULL;
    }
    for (int i = 0; n > 1 && i < n && i < MOST; i++)
        words[i] = row[i]->select;
    return n == 1 || settings_choice(s, "select", 0, words, &which, err) ? row[which] : NULL;
}

const struct method_parameter *method_has(const struct method *m, const char *name)
{
    static const struct method_parameter select = {"select", PARAMETER_WORD, 0, 0, 0, 0, "", NULL};
    if (m->select != NULL && strcmp(name, select.name) == 0)
        return &select;
    return m->parameters != NULL ? parameter_find(m->parameters, name) : NULL;
}

static bool read(const struct method *m, const struct settings *s, void *state, struct error *err)
{
    return m->parameters == NULL ||
           (parameters_set(m->parameters, s, state, err) && (m->check == NULL || m->check(state, err)));
}

bool method_check(const struct method *m, const struct settings *s, struct error *err)
{
    void *state = mem_alloc(1, m->state_size);
    bool ok = read(m, s, state, err);
    free(state);
    return ok;
}

/* What was learnt before, if anybody has it. */
static bool recall(const struct method *m, const struct render_job *job, void *state, struct error *err)
{
    if (job->learnt == NULL || job->learnt->n == 0)
        return true;
    if (m->learnt == NULL)
        return error_set(err, "%s learns nothing, so there is nothing to go on with", m->name);
    return learnt_read(m->learnt(state), &job->scene->lights, job->of, job->learnt, "what was learnt", err);
}

static void add_note(char note[FILM_NOTE_SIZE], const char *text)
{
    size_t n = strlen(note);
    snprintf(note + n, FILM_NOTE_SIZE - n, "%s%s", n > 0 ? "; " : "", text);
}

bool method_prepare(const struct method *m, const struct render_job *job, struct preparation *out, struct error *err)
{
    struct preparation standard = {.method = m, .state = mem_alloc(1, m->state_size),
                                   .size = {0, DEFAULT_TILE_SIZE}};
    struct mis_counts bdpt = {.hit = {1, 1}, .direct = {1, 1}, .delta = {1, 1}, .connect = {1, 1}, .splat = pixel_light_count(job),
                              .power = job->power_heuristic};
    struct frozen *f = standard.state;
    *out = standard;
    f->counts = bdpt;
    f->max_depth = job->max_depth;
    f->lights = f->path_pixels = 1;
    if (!read(m, &job->scene->settings, out->state, err)) {
        free(out->state);
        return false;
    }
    if (!recall(m, job, out->state, err)) {
        method_release(out);
        return false;
    }
    if (job->caustics > 0)
        f->counts.caustics = out->caustics = caustics_new(job->scene, job->caustics);
    if (m->prepare != NULL)
        m->prepare(job, out);
    if (job->regularise > 0)
        add_note(out->note, "biased: mirrors and glass are blurred where nothing else finds a light");
    if (m->learnt != NULL && job->learnt != NULL && job->learnt->n == 0 && m->learnt(out->state)->eye.n > 0)
        learnt_write(m->learnt(out->state), job->of, job->learnt);
    return true;
}

void method_release(struct preparation *p)
{
    if (p->method->release != NULL)
        p->method->release(p->state);
    free(p->state);
    caustics_free(p->caustics);
}

void *method_scratch(const struct preparation *p)
{
    if (p->method->scratch_size == 0)
        return NULL;
    void *scratch = mem_alloc(1, p->method->scratch_size);
    if (p->method->scratch_init != NULL)
        p->method->scratch_init(scratch, p->state);
    return scratch;
}

void method_scratch_free(const struct preparation *p, void *scratch)
{
    if (scratch != NULL && p->method->scratch_free != NULL)
        p->method->scratch_free(scratch);
    free(scratch);
}
