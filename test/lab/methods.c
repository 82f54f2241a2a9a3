/* methods.c: see methods.h. */
#include "lab/methods.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "chains/chain.h"
#include "library/job_options.h"
#include "render/job.h"

/* Set the parameters after the colons. False with a message if something there is no NAME=VALUE. */
static bool set_pairs(const char *text, struct settings *out, struct error *err)
{
    for (const char *p = strchr(text, ':'); p != NULL; p = strchr(p, ':')) {
        char name[64], value[METHOD_TEXT];
        if (sscanf(++p, "%63[^=:]=%191[^:]", name, value) != 2)
            return error_set(err, "%s: expected NAME=VALUE after each colon", text);
        settings_set(out, name, value, text);
    }
    return true;
}

bool measured_biased(const struct measured *m)
{
    return strstr(method_named(m->integrator)->help, "; biased") != NULL;
}

struct settings measured_settings(const struct measured *m, const struct settings *base)
{
    struct settings out = {0};
    struct error err;
    for (const struct setting *b = base != NULL ? base->item : NULL; b != NULL && b < base->item + base->n; b++)
        if (isnan(b->number))
            settings_set(&out, b->name, b->value, b->origin);
        else
            settings_set_number(&out, b->name, b->number, b->origin);
    set_pairs(m->text, &out, &err); /* which has been read before */
    return out;
}

bool method_is_chain(const struct method *m) { return m->render == chain_render; }
bool method_merges(const struct method *m)
{
    return strcmp(m->name, "pathgraph") == 0 || strcmp(m->name, "ppg") == 0;
}

bool method_observable(const struct method *m, struct error *err)
{
    return !method_is_chain(m) ||
           error_set(err, "%s goes from sample to sample over the whole picture: no pixel has one to tell of", m->name);
}

const char *method_why(const struct method *m)
{
    static const struct {
        const char *name, *why;
    } REASONS[] = {
        {"bins", "one of a few kept light sub-paths, as in the dissertation.\n"
                 "  A bin of the pixel has two, of which one is taken with probability beta_e^2 / (beta_0^2 + "
                 "beta_1^2). No factor makes up for that"},
        {"pool", "one light sub-path of a shared pool, by an alias table.\n"
                 "  Of the tile's K sub-paths, number k with q_k = (1 - delta) I_k / sum I + delta / K, by its "
                 "importance I_k. It counts 1 / (K q_k) times"},
        {"vertices", "single light vertices, by how much light they can send to the camera.\n"
                     "  C draws for each eye vertex from the tile's K light sub-paths, with q_v in proportion to "
                     "luminance(beta) h(x). Each counts 1 / (C K q_v) times"},
        {"subspaces", "single light vertices, chosen for the region of the eye vertex.\n"
                      "  C draws for each eye vertex from the tile's K light sub-paths, with P in proportion to "
                      "luminance(beta) h(e,l), of the regions e of the eye and l of the light vertex. Each counts 1 "
                      "/ (C K P) times"},
        {"cbdpt", "all connections with some light sub-paths of neighbouring pixels.\n"
                  "  M of the tile's K light sub-paths, in random order, all used equally often. Each counts 1 / M "
                  "times"},
        {"lvc", "light vertices of a shared cache, all equally likely.\n"
                "  C draws for each eye vertex from the V light vertices of the tile's K light sub-paths. Each "
                "counts V / (C K) times"},
        {"mbdpt", "pairs of sorted sub-paths, spread evenly.\n"
                  "  For each strategy one of the tile's K light sub-paths, by a shifted lattice over eye and light "
                  "sub-paths sorted by length or throughput, each equally likely. It counts once"},
        {"pcbdpt", "light vertices by what was useful nearby.\n"
                   "  C draws for each eye vertex from the tile's K light sub-paths, with P the mean of the "
                   "probabilities of the records nearby and of the uniform choice. Each counts 1 / (C K P) times"},
        {"ris", "light vertices resampled by what was useful nearby.\n"
                "  One draw for each eye vertex from the tile's K light sub-paths, with probability P by one of the "
                "records nearby or uniformly. It counts 1 / (K P) times"},
        {"ris2", "the same in two stages, by power first.\n"
                 "  Light vertices are drawn in proportion to luminance(beta), which gives them a factor u. Of "
                 "these one is drawn for each eye vertex, with probability P by one of the records nearby or "
                 "uniformly. It counts u / (K P) times"},
        {"spcbpt", "regions of eye and light vertices, our reconstruction of a paper.\n"
                   "  C draws for each eye vertex: a region l of light vertices by Gamma(e,l), with e the region of "
                   "the eye vertex, then one of its vertices in proportion to luminance(beta). Each counts 1 / (C K "
                   "P) times"},
        {"vcm", "bdpt, which also merges vertices that are close.\n"
                "  All of the tile's light vertices within the radius r, besides the pixel's own light sub-path, "
                "which counts once. A merge counts 1 / (K pi r^2) times"}};
    for (size_t i = 0; i < sizeof REASONS / sizeof *REASONS; i++)
        if (strcmp(REASONS[i].name, m->select != NULL ? m->select : m->name) == 0)
            return REASONS[i].why;
    return m->build != NULL ? m->help : NULL;
}

const struct method *method_named(const char *name)
{
    const struct settings none = {0};
    return method_find(name, &none, NULL);
}

const struct method *method_of(const struct scene *scene, const char *name)
{
    return method_find(name, &scene->settings, NULL);
}

bool render_by(const struct scene *scene, const struct render_job *o, struct film *film, struct error *err)
{
    struct render_job job = *o;
    struct prepared prepared;
    if (!job_settle(&job, scene, &prepared, err))
        return false;
    bool ok = render_scene(&job, &prepared, film, err);
    method_release(&prepared);
    return ok;
}

bool render_prepare(const struct scene *scene, const struct render_job *options, struct pixel_rect rect,
                    struct render_job *job, struct prepared *prepared, struct error *err)
{
    *job = *options;
    if (!job_settle(job, scene, prepared, err))
        return false;
    job->film_rect = rect;
    job_prepare(job, prepared);
    return true;
}

/* Are the parameters valid? */
static bool valid(const struct method *m, const struct scene *scene, struct error *err)
{
    struct prepared p;
    bool ok = method_read(m, scene, &p, err);
    if (ok)
        method_release(&p);
    return ok;
}

/* Is there such an integrator, and has it these parameters, with such values? */
static bool check(const struct measured *m, struct error *err)
{
    struct scene none = {.settings = {0}};
    struct settings *s = &none.settings;
    bool ok = set_pairs(m->text, s, err);
    const struct method *row = ok ? method_find(m->integrator, s, err) : NULL;
    for (int i = 0; row != NULL && ok && i < s->n; i++)
        if (field_find(job_common(), s->item[i].name) == NULL && method_has(row, s->item[i].name) == NULL)
            ok = error_set(err, "%s: there is no parameter \"%s\"", m->text, s->item[i].name);
    ok = ok && row != NULL && valid(row, &none, err);
    settings_clear(s);
    return ok;
}

static bool add_one(struct methods *list, const char *text, struct error *err)
{
    if (list->n == METHODS_MAX)
        return error_set(err, "more than %d methods", METHODS_MAX);
    struct measured *m = &list->item[list->n];
    m->halves = 0;
    snprintf(m->label, sizeof m->label, "%s", method_short(text));
    snprintf(m->text, sizeof m->text, "%s", text);
    snprintf(m->file, sizeof m->file, "%s", text);
    snprintf(m->integrator, sizeof m->integrator, "%.*s", (int)strcspn(text, ":"), text);
    for (char *c = m->file; *c != '\0'; c++)
        *c = isalnum((unsigned char)*c) || *c == '.' ? *c : '-';
    if (methods_find(list, text) >= 0)
        return error_set(err, "%s is given twice", text);
    list->n++;
    return check(m, err);
}

/* One method for each of the values that slashes divide; the first such list leads on to the others. */
static bool add_all(struct methods *list, const char *text, struct error *err)
{
    size_t begin = strcspn(text, "/"), end, n;
    if (text[begin] == '\0')
        return add_one(list, text, err);
    while (begin > 0 && strchr(":=", text[begin - 1]) == NULL)
        begin--;
    end = begin + strcspn(text + begin, ":");
    for (size_t at = begin; at < end; at += n + 1) {
        char one[METHOD_TEXT];
        n = strcspn(text + at, "/:");
        snprintf(one, sizeof one, "%.*s%.*s%s", (int)begin, text, (int)n, text + at, text + end);
        if (!add_all(list, one, err))
            return false;
    }
    return true;
}

bool methods_read(const char *text, struct methods *out, struct error *err)
{
    out->n = 0;
    for (const char *p = text;; p++) {
        char one[METHOD_TEXT];
        size_t n = strcspn(p, ",");
        if (n == 0 || n >= sizeof one)
            return error_set(err, "%s: expected methods, like bdpt,asbdpt:select=pool", text);
        snprintf(one, sizeof one, "%.*s", (int)n, p);
        if (!add_all(out, one, err))
            return false;
        p += n;
        if (*p == '\0')
            return true;
    }
}

void methods_all(char out[METHODS_TEXT])
{
    int n = snprintf(out, METHODS_TEXT, "%s", METHOD_REFERENCE);
    for (const struct method *const *m = method_rows; *m != NULL && n < METHODS_TEXT; m++)
        if (strcmp((*m)->name, METHOD_REFERENCE) != 0)
            n += snprintf(out + n, (size_t)(METHODS_TEXT - n), ",%s%s%s", (*m)->name,
                          (*m)->select != NULL ? ":select=" : "", (*m)->select != NULL ? (*m)->select : "");
}

/* Services are parameters that several methods have, some all of them: how they are off and on. */
static const struct {
    const char *name, *value[N_HALVES];
} SERVICES[] = {{"guide", {"off", "on"}}, {"emission", {"1", "0.2"}}, {"tile", {"16", "32"}},
                {"spread", {"1", "4"}}, {"race", {"off", "on"}}, {"lightpoints", {"1", "2"}}, {"later", {"-1", "1"}},
                {"credits", {"off", "on"}}, {"bound", {"off", "on"}}};

const char *const HALVES[N_HALVES] = {"The choice alone", "With all services"};

/* A method as it is in a half: its text, and each service that it has and that was not given. */
static void in_half(const char *text, enum half half, char out[METHOD_TEXT])
{
    struct settings s = {0};
    char integrator[32];
    snprintf(integrator, sizeof integrator, "%.*s", (int)strcspn(text, ":"), text);
    set_pairs(text, &s, NULL);
    const struct method *row = method_find(integrator, &s, NULL);
    int n = snprintf(out, METHOD_TEXT, "%s", text);
    for (size_t i = 0; row != NULL && i < sizeof SERVICES / sizeof SERVICES[0]; i++)
        if (method_has(row, SERVICES[i].name) != NULL && settings_find(&s, SERVICES[i].name) == NULL &&
            n < METHOD_TEXT)
            n += snprintf(out + n, (size_t)(METHOD_TEXT - n), ":%s=%s", SERVICES[i].name, SERVICES[i].value[half]);
    settings_clear(&s);
}

bool methods_add_halves(const char *text, unsigned halves, struct methods *out, struct error *err)
{
    struct methods given;
    out->n = 0;
    if (!methods_read(text, &given, err))
        return false;
    for (int h = 0; h < N_HALVES; h++)
        for (int i = 0; i < given.n; i++) {
            char own[METHOD_TEXT];
            in_half(given.item[i].text, (enum half)h, own);
            int known = methods_find(out, own);
            if ((halves >> h & 1) == 0)
                continue;
            if (known < 0 && !add_one(out, own, err))
                return false;
            struct measured *m = &out->item[known < 0 ? out->n - 1 : known];
            m->halves |= 1u << h;
            snprintf(m->label, sizeof m->label, "%s", given.item[i].label);
        }
    return true;
}

int methods_find_half(const struct methods *list, const char *text, enum half half)
{
    char own[METHOD_TEXT];
    in_half(text, half, own);
    int found = methods_find(list, own), as_given = methods_find(list, text);
    return found < 0 && as_given >= 0 && list->item[as_given].halves == 0 ? as_given : found;
}

const char *method_short(const char *text)
{
    const char *select = strstr(text, "select=");
    return select != NULL ? select + strlen("select=") : text;
}

int methods_find(const struct methods *list, const char *text)
{
    for (int i = 0; i < list->n; i++)
        if (strcmp(list->item[i].text, text) == 0)
            return i;
    return -1;
}
