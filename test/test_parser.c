/* test_parser.c: scene files.
 *
 * Every file of test/fixtures says in its first line what must come of it: "# expect: ok", or LINE:COL and a part
 * of the message of the first error; further lines "# also: ..." name parts of the other errors and "# warn: ..." of
 * the warnings, in order. What a scene must contain is
 * checked here Then: numbers against strtod, spectra against known colours, and damaged
 * copies of all fixtures, which must be accepted or refused, never crash (run it with sanitizers).
 */
#define _POSIX_C_SOURCE 200809L

#include <dirent.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "parser/lexer.h"
#include "parser/parse.h"
#include "parser/parser.h"
#include "parser/scene_files.h"
#include "base/os.h"
#include "base/rng.h"
#include "parser/spectrum.h"
#include "parser/symbols.h"
#include "helpers.h"
#include "tests.h"

static const char FIXTURES[] = "test/fixtures";
enum { MAX_FIXTURES = 400, MAX_WARNINGS = 32, TEXT = 512 };

/* The names of the fixtures, sorted. */
struct fixtures {
    char name[MAX_FIXTURES][64];
    int n;
};

static int by_name(const void *a, const void *b) { return strcmp(a, b); }

static bool ends_in(const char *name, const char *end)
{
    size_t n = strlen(name), m = strlen(end);
    return n >= m && strcmp(name + n - m, end) == 0;
}

static void list_fixtures(struct fixtures *f)
{
    f->n = 0;
    DIR *d = opendir(FIXTURES);
    if (d == NULL)
        return;
    for (struct dirent *e = readdir(d); e != NULL && f->n < MAX_FIXTURES; e = readdir(d))
        if (ends_in(e->d_name, ".pbrt") && strlen(e->d_name) < sizeof f->name[0])
            strcpy(f->name[f->n++], e->d_name);
    closedir(d);
    qsort(f->name, (size_t)f->n, sizeof f->name[0], by_name);
}

/* Messages as they come. */
struct heard {
    char text[MAX_WARNINGS][TEXT];
    int n;
};

struct hearing {
    struct heard warnings, errors;
};

static void hear(struct heard *h, const char *text)
{
    if (h->n < MAX_WARNINGS)
        snprintf(h->text[h->n++], TEXT, "%s", text);
}

static void hear_warning(void *context, const char *text) { hear(&((struct hearing *)context)->warnings, text); }
static void hear_error(void *context, const char *text) { hear(&((struct hearing *)context)->errors, text); }

/* The comment "# KEY: value" number k at the head of the text; empty if there are fewer. */
static void head_comment(const char *text, const char *key, int k, char out[TEXT])
{
    char start[32];
    snprintf(start, sizeof start, "# %s: ", key);
    out[0] = '\0';
    for (const char *line = text; *line == '#'; line = strchr(line, '\n') + 1) {
        if (strncmp(line, start, strlen(start)) == 0 && k-- == 0) {
            snprintf(out, TEXT, "%.*s", (int)strcspn(line + strlen(start), "\n"), line + strlen(start));
            return;
        }
        if (strchr(line, '\n') == NULL)
            return;
    }
}

/* --- contents ------------------------------------------------------------------------------------------- */

/* A scene in words, as far as these tests look at it. */
struct words {
    char text[16384];
    size_t n;
};

static void put(struct words *w, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    int n = vsnprintf(w->text + w->n, sizeof w->text - w->n, format, args);
    va_end(args);
    w->n = w->n + (size_t)n < sizeof w->text ? w->n + (size_t)n : sizeof w->text - 1;
}

/* To nine digits behind the point, and no number is -0. */
static void put3(struct words *w, const char *name, double x, double y, double z)
{
    put(w, " %s %g %g %g", name, rint(x * 1e9) / 1e9 + 0, rint(y * 1e9) / 1e9 + 0, rint(z * 1e9) / 1e9 + 0);
}

/* A texture parameter: its value if that is constant, else the texture's number; nothing for -1. */
static void put_texture(struct words *w, const struct scene *s, const char *name, int id)
{
    const struct texture *t = &s->textures.texture[id];
    if (id >= 0 && t->kind == TEXTURE_CONSTANT)
        put3(w, name, t->constant.r, t->constant.g, t->constant.b);
    else if (id >= 0)
        put(w, " %s texture %d", name, id);
}

static const char *kind_name(const struct object_type *types, int kind, const char *fallback)
{
    while (types->name != NULL && types->kind != kind)
        types++;
    return types->name != NULL ? types->name : fallback;
}

static void put_options(struct words *w, const struct scene *s)
{
    const struct camera *c = &s->camera;
    const struct filter *f = &s->filter;
    put(w, "film %dx%d scale %g crop %g %g %g %g file %s\n", s->width, s->height, s->film_scale, s->crop[0], s->crop[1],
        s->crop[2], s->crop[3], s->film_filename != NULL ? s->film_filename : "none");
    vec3 world = transform_point(&c->world_to_camera, vec(0, 0, 0));
    put(w, "camera %d fov %g aspect %g lens %g %g window %d %g %g %g %g", (int)c->kind, c->fov, c->frame_aspect_ratio,
        c->lens_radius, c->focal_distance, c->has_screen_window, c->screen_window[0], c->screen_window[1],
        c->screen_window[2], c->screen_window[3]);
    put3(w, "world at", world.x, world.y, world.z);
    put(w, "\nfilter %d radius %g %g alpha %g B %g C %g tau %g\n", (int)f->kind, f->radius[0], f->radius[1], f->alpha,
        f->B, f->C, f->tau);
    put(w, "spp %d integrator %s\n", s->spp, s->integrator != NULL ? s->integrator : "none");
    for (int i = 0; i < s->settings.n; i++)
        put(w, "setting %s %s %s\n", s->settings.item[i].name, s->settings.item[i].value, s->settings.item[i].origin);
}

static void put_textures(struct words *w, const struct scene *s)
{
    for (int i = 0; i < s->textures.n_textures; i++) {
        const struct texture *t = &s->textures.texture[i];
        if (t->kind == TEXTURE_CONSTANT)
            continue;
        put(w, "texture %d %s", i, kind_name(TEXTURE_TYPES, (int)t->kind, "cubes"));
        if (t->kind == TEXTURE_IMAGEMAP)
            put(w, " image %d wrap %d scale %g gamma %d", t->image, (int)t->wrap, t->scale, t->gamma);
        else if (t->kind == TEXTURE_BILERP) {
            const rgb v[4] = {t->v00, t->v01, t->v10, t->v11};
            for (int k = 0; k < 4; k++)
                put3(w, k == 0 ? "values" : "and", v[k].r, v[k].g, v[k].b);
        } else {
            put_texture(w, s, "tex1", t->tex1);
            put_texture(w, s, "tex2", t->tex2);
        }
        if (t->kind == TEXTURE_MIX)
            put_texture(w, s, "amount", t->amount);
        put(w, " mapping %d %g %g %g %g\n", (int)t->map.kind, t->map.su, t->map.sv, t->map.du, t->map.dv);
    }
}

static const struct field *first_at(const struct field *f, size_t place)
{
    while (f->place != place)
        f++;
    return f;
}

static void put_material(struct words *w, const struct scene *s, int i)
{
    const struct material *m = s->material[i];
    put(w, "material %d %s", i, m->row->name);
    for (const struct field *f = m->row->fields; f->name != NULL; f++) {
        if (first_at(m->row->fields, f->place) != f) /* another name of what is there already */
            continue;
        const void *place = (const char *)m + f->place;
        if (f->kind == FIELD_FLOAT_TEXTURE || f->kind == FIELD_RGB_TEXTURE)
            put_texture(w, s, f->name, *(const int *)place);
        else if (f->kind == FIELD_MATERIAL)
            put(w, " %s %d", f->name, *(const int *)place);
        else if (f->kind == FIELD_SWITCH)
            put(w, " %s %d", f->name, *(const bool *)place);
    }
    put(w, "\n");
}

static void put_shapes(struct words *w, const struct scene *s)
{
    const struct geometry *geo = &s->geo;
    for (int i = 0; i < geo->n_groups; i++) {
        const struct shape_group *g = &geo->group[i];
        put(w, "group of material %d light %d flip %d N %d uv %d", g->material, g->first_light, g->flip, g->has_n,
            g->has_uv);
        put_texture(w, s, "alpha", g->alpha);
        put_texture(w, s, "shadow", g->shadow_alpha);
        put(w, "\n");
    }
    for (int i = 0; i < geo->n_quadrics; i++) {
        const struct quadric *q = &geo->quadric[i];
        vec3 at = transform_point(&q->to_world, vec(0, 0, 0));
        put(w, "quadric %d radius %g inner %g z %g %g phi %g", (int)q->kind, q->radius, q->inner_radius, q->zmin,
            q->zmax, q->phi_max);
        put3(w, "at", at.x, at.y, at.z);
        put3(w, "from", q->p1.x, q->p1.y, q->p1.z);
        put3(w, "to", q->p2.x, q->p2.y, q->p2.z);
        put(w, "\n");
    }
    put(w, "%d triangles of %d points\n", geo->n_triangles, geo->n_vertices);
    for (int i = 0; i < geo->n_vertices; i++) {
        const float *P = geo->P + 3 * i, *uv = geo->UV + 2 * i;
        put(w, "point %d: %.9g %.9g %.9g uv %g %g\n", i, (double)P[0], (double)P[1], (double)P[2], (double)uv[0],
            (double)uv[1]);
    }
    for (const uint32_t *k = geo->index; k < geo->index + 3 * geo->n_triangles; k += 3)
        put(w, "triangle %d %d %d\n", (int)k[0], (int)k[1], (int)k[2]);
}

static void put_lights(struct words *w, const struct scene *s)
{
    for (int i = 0; i < s->lights.n; i++) {
        const struct light *l = &s->lights.light[i];
        const struct light_frame none = {.to_world = transform_identity()}, *f = l->frame != NULL ? l->frame : &none;
        vec3 axis = transform_vector(&f->to_world, vec(0, 0, 1));
        put(w, "light %d %s", i, kind_name(LIGHT_DIRECTIVES[1].types, (int)l->kind, "area"));
        put3(w, "L", l->L.r, l->L.g, l->L.b);
        put3(w, "at", f->position.x, f->position.y, f->position.z);
        put3(w, "towards", f->direction.x, f->direction.y, f->direction.z);
        put3(w, "axis", axis.x, axis.y, axis.z);
        put(w, " cosines %.4f %.4f tan %.4f two-sided %d prim %d picture %d\n", f->cos_total, f->cos_falloff,
            f->tan_half, l->two_sided, l->prim, f->env != NULL || f->slide != NULL);
    }
}

/* "# has: ..." in a scene's comments are parts of its words, in their order. */
static void check_contents(struct test *t, const char *name, const char *text, const struct scene *s)
{
    struct words *w = mem_alloc(1, sizeof *w);
    put_options(w, s);
    put_textures(w, s);
    for (int i = 0; i < s->n_materials; i++)
        put_material(w, s, i);
    put_shapes(w, s);
    put_lights(w, s);
    const char *from = w->text;
    for (const char *p = strstr(text, "# has: "); p != NULL; p = strstr(p + 1, "# has: ")) {
        char want[TEXT];
        snprintf(want, sizeof want, "%.*s", (int)strcspn(p + 7, "\n"), p + 7);
        const char *found = strstr(from, want);
        if (CHECK(t, found != NULL, "%s: no \"%s\" in\n%s", name, want, from))
            from = found + strlen(want);
    }
    free(w);
}

/* --- expectations --------------------------------------------------------------------------------------- */

/* The second line of a message must be the place's line, the third a caret under its column. */
static void check_caret(struct test *t, const char *name, const char *message, const char *text, int line,
                        int column)
{
    for (int i = 1; i < line; i++)
        text = strchr(text, '\n') + 1;
    const char *shown = strchr(message, '\n'), *caret = shown != NULL ? strchr(shown + 1, '\n') : NULL;
    if (!CHECK(t, caret != NULL, "%s: the message has no line and no caret:\n%s", name, message))
        return;
    int at = (int)(strchr(caret, '^') - caret) - 1; /* column in the shown line, from 0 */
    char under = shown[1 + at], meant = text[column - 1];
    bool same = under == meant || ((under == '\n' || under == '\0') && (meant == '\n' || meant == '\0'));
    CHECK(t, same, "%s: the caret is under '%c', not '%c':\n%s", name, under, meant, message);
}

static void check_refusal(struct test *t, const char *name, const char *path, const char *text, const char *expect,
                          const char *message)
{
    char file[TEXT], where[3 * TEXT];
    int line = 0, column = 0, used = 0;
    bool other_file = sscanf(expect, "%d:%d: %n", &line, &column, &used) != 2;
    if (other_file && sscanf(expect, "%511[^:]:%d:%d: %n", file, &line, &column, &used) == 3)
        snprintf(where, sizeof where, "%s/%s:%d:%d: ", FIXTURES, file, line, column);
    else
        snprintf(where, sizeof where, "%s:%d:%d: ", path, line, column);
    CHECK(t, strncmp(message, where, strlen(where)) == 0, "%s: expected %s, got\n%s", name, where, message);
    CHECK(t, strstr(message, expect + used) != NULL, "%s: expected \"%s\", got\n%s", name, expect + used, message);
    if (!other_file)
        check_caret(t, name, message, text, line, column);
}

/* Messages from number `first` on against the lines "# KEY: ..." of the head. */
static void check_heard(struct test *t, const char *name, const char *text, const char *key, const struct heard *heard,
                        int first)
{
    char expect[TEXT];
    int i = first;
    for (; i < heard->n; i++) {
        head_comment(text, key, i - first, expect);
        CHECK(t, expect[0] != '\0' && strstr(heard->text[i], expect) != NULL, "%s: said \"%s\", expected \"%s\"", name,
              heard->text[i], expect);
    }
    head_comment(text, key, i - first, expect);
    CHECK(t, expect[0] == '\0', "%s: nothing said of \"%s\"", name, expect);
}

static void check_fixture(struct test *t, const char *name)
{
    char path[TEXT], expect[TEXT];
    snprintf(path, sizeof path, "%s/%s", FIXTURES, name);
    size_t size;
    struct error err = {.text = ""};
    char *text = text_read(path, &size, &err);
    struct scene s;
    struct hearing *heard = mem_alloc(1, sizeof *heard);
    struct message_sink sink = {hear_warning, hear_error, heard};
    bool ok = parse_scene(path, &s, &sink, &err);
    head_comment(text, "expect", 0, expect);
    if (strcmp(expect, "ok") == 0)
        CHECK(t, ok, "%s: refused:\n%s", name, err.text);
    else if (CHECK(t, !ok, "%s: accepted, but expected: %s", name, expect))
        check_refusal(t, name, path, text, expect, err.text);
    CHECK(t, ok == (heard->errors.n == 0), "%s: %d errors", name, heard->errors.n);
    CHECK(t, ok || strncmp(heard->errors.text[0], err.text, TEXT - 1) == 0, "%s: the first error is another", name);
    check_heard(t, name, text, "also", &heard->errors, 1);
    check_heard(t, name, text, "warn", &heard->warnings, 0);
    if (ok) {
        check_contents(t, name, text, &s);
        scene_free(&s);
    }
    free(heard);
    free(text);
}

/* --- pieces --------------------------------------------------------------------------------------------- */

/* Of a file that is no scene messages quote no line. */
static void check_nothing_quoted(struct test *t)
{
    struct scene s;
    struct error err = {.text = ""};
    struct hearing *heard = mem_alloc(1, sizeof *heard);
    struct message_sink sink = {hear_warning, hear_error, heard};
    CHECK(t, !parse_scene("test/fixtures/include-no-scene.pbrt", &s, &sink, &err) && heard->errors.n == 1 &&
                 strstr(err.text, "secret") == NULL, "%d errors, the first\n%s", heard->errors.n, err.text);
    free(heard);
}

/* More names than chains: all are found, the newest first, and forgotten again. */
static void check_symbols(struct test *t)
{
    enum { N = 5000 };
    struct symbols table = {0};
    char name[32];
    int wrong = 0;
    for (int i = 0; i < 2 * N; i++) {
        snprintf(name, sizeof name, "%d", i % N);
        wrong += symbols_find(&table, name) != (i < N ? -1 : i - N);
        symbols_add(&table, name, i);
    }
    symbols_forget(&table, N);
    for (int i = 0; i < N; i++) {
        snprintf(name, sizeof name, "%d", i);
        wrong += symbols_find(&table, name) != i;
    }
    symbols_free(&table);
    CHECK(t, wrong == 0 && symbols_find(&table, "0") == -1, "%d names are wrong", wrong);
}

/* One number through the lexer. */
static bool lex_number(const char *text, double *out)
{
    struct arena arena = {NULL, NULL};
    struct messages messages = {0};
    struct source_file file = {"number", text, text + strlen(text), {0}, true};
    struct lexer l = lexer_start(&file, &arena, &messages);
    return lexer_number(&l, out) && lexer_peek(&l) == TOKEN_END;
}

static void check_numbers(struct test *t)
{
    static const char *const FORMAT[] = {"%.3f", "%.6g", "%.9g", "%.17g", "%.20e", "%+.2e", "%.0f", "%.25f"};
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 1, 0);
    int wrong = 0;
    for (int i = 0; i < 40000; i++) {
        char text[512];
        double x = (rng_uniform(&r) - .5) * pow(10, floor(rng_uniform(&r) * 60) - 30), got = 0;
        snprintf(text, sizeof text, FORMAT[i % 8], x);
        if (!lex_number(text, &got) || got != strtod(text, NULL))
            if (wrong++ == 0)
                CHECK(t, false, "%s is read as %.17g", text, got);
    }
    CHECK(t, wrong == 0, "%d numbers are not read as strtod reads them", wrong);
    static const char *const BAD[] = {"", ".", "-", "+.", "1e", "1e+", "--1", "1.2.3", "0x10", "1f", "e5", "inf"};
    double got;
    for (size_t i = 0; i < sizeof BAD / sizeof BAD[0]; i++)
        CHECK(t, !lex_number(BAD[i], &got), "'%s' is not a number", BAD[i]);
    CHECK(t, lex_number("-0", &got) && got == 0 && signbit(got), "-0 keeps its sign");
}

static bool within(rgb c, double r, double g, double b, double most)
{
    return fabs(c.r - r) <= most && fabs(c.g - g) <= most && fabs(c.b - b) <= most;
}

/* Expected colours were computed with the CIE 1931 tables in steps of 1 nm, scaled to Y = 1 for a constant spectrum. */
static void check_spectra(struct test *t)
{
    double flat[1][2] = {{500, 1}}, unsorted[4][2] = {{700, .6}, {500, .9}, {600, .2}, {400, .1}};
    double mixed[4][2] = {{700, 1}, {500, 1}, {500, 0}, {400, 0}}, up[4][2] = {{400, 0}, {500, 0}, {500, 1}, {700, 1}};
    double down[4][2] = {{400, 1}, {500, 1}, {500, 0}, {700, 0}};
    rgb whole = spectrum_from_samples(flat, 1), a = spectrum_from_samples(mixed, 4), b = spectrum_from_samples(up, 4);
    CHECK(t, fabs(rgb_luminance(whole) - 1) < 1e-4, "a constant spectrum has Y = its value");
    CHECK(t, within(spectrum_blackbody(3000, 1), 0.73663, 0.35123, 0.11322, 0.01), "3000 K");
    CHECK(t, within(spectrum_blackbody(6500, 1), 0.92418, 0.87135, 0.91716, 0.01), "6500 K");
    CHECK(t, rgb_is_black(spectrum_blackbody(0, 1)), "0 K is black");
    CHECK(t, within(spectrum_from_samples(unsorted, 4), .1745, .6016, .4721, 0.01), "unsorted samples");
    CHECK(t, within(a, b.r, b.g, b.b, 0), "a step whose samples are out of order goes up");
    a = rgb_add(spectrum_from_samples(down, 4), b);
    CHECK(t, within(a, whole.r, whole.g, whole.b, 1e-9), "steps up and down are the whole");
}

/* Which of the parameters of a sphere is near, or "". */
static const char *suggested(const char *wanted)
{
    static const char *const KNOWN[] = {"radius", "zmin", "zmax", "phimax", NULL};
    struct suggestion s = suggest_start(wanted);
    for (int i = 0; KNOWN[i] != NULL; i++)
        suggest_offer(&s, KNOWN[i]);
    return s.name != NULL ? s.name : "";
}

static void check_suggestions(struct test *t)
{
    CHECK(t, strcmp(suggested("raduis"), "radius") == 0, "a swap");
    CHECK(t, strcmp(suggested("ZMIN"), "zmin") == 0, "letter case");
    CHECK(t, strcmp(suggested("colour"), "") == 0 && strcmp(suggested(""), "") == 0, "nothing near");
}

/* --- what reaches the terminal ------------------------------------------------------------------------- */

static void check_cleaning(struct test *t)
{
    static const char *const TEXTS[][2] = {
        {"plain ~", "plain ~"},
        {"\x1b[31m\x7f\a\n\r", "?[31m????"},
        {"gr\xc3\xbcn \xe2\x82\xac \xf0\x9f\x98\x80", "gr\xc3\xbcn \xe2\x82\xac \xf0\x9f\x98\x80"},
        {"latin gr\xfcn", "latin gr?n"},
        {"control \xc2\x9b" "1m, cut \xe2\x82", "control ??1m, cut ??"},
        {"overlong \xc0\x9b \xe0\x82\x9b, surrogate \xed\xa0\x80", "overlong ?? ???, surrogate ???"},
        {"beyond \xf4\x90\x80\x80 \xf8\x88\x80\x80\x80", "beyond ???? ?????"}};
    for (size_t i = 0; i < sizeof TEXTS / sizeof TEXTS[0]; i++) {
        struct error err;
        error_set(&err, "%s", TEXTS[i][0]);
        CHECK(t, strcmp(err.text, TEXTS[i][1]) == 0, "text %d is cleaned to \"%s\"", (int)i, err.text);
    }
}

/* A name in UTF-8 is quoted as it is, an escape sequence is not; in the excerpt a byte is a column. */
static void check_odd_bytes(struct test *t)
{
    static const char TEXT_OF[] = "WorldBegin\n Include \"gr\xc3\xbcn\x1b[31m\\n\xff\" # \xc3\xa9\nWorldEnd\n";
    char path[TEXT], want[2 * TEXT];
    snprintf(path, sizeof path, "%s/odd.pbrt", test_tmp(t));
    write_bytes(path, TEXT_OF, sizeof TEXT_OF - 1);
    struct error err = {.text = ""};
    struct scene s;
    CHECK(t, !parse_scene(path, &s, NULL, &err), "an odd name is accepted");
    snprintf(want, sizeof want, "%s:2:10: %s/gr\xc3\xbcn?[31m??: cannot open", path, test_tmp(t));
    CHECK(t, strncmp(err.text, want, strlen(want)) == 0, "a name of odd bytes, expected %s, got\n%s", want, err.text);
    const char *excerpt = strchr(err.text, '\n');
    snprintf(want, sizeof want, "\n   Include \"gr??n [31m\\n?\" # ??\n           ^");
    CHECK(t, excerpt != NULL && strcmp(excerpt, want) == 0, "a line of odd bytes, expected %s, got %s", want, excerpt);
}

/* What subdivision may make is counted for the whole scene. No fixture: without its first surface it takes seconds. */
static void check_subdivided(struct test *t)
{
    static const char TEXT_OF[] =
        "WorldBegin\n"
        "Shape \"loopsubdiv\" \"integer levels\" 0 \"integer indices\" [0 1 2] \"point P\" [0 0 0 1 0 0 0 1 0]\n"
        "Shape \"loopsubdiv\" \"integer levels\" 11 \"integer indices\" [0 1 2 1 0 3] "
        "\"point P\" [0 0 0 1 0 0 0 1 0 0 0 1]\nWorldEnd\n";
    char path[TEXT];
    snprintf(path, sizeof path, "%s/subdivided.pbrt", test_tmp(t));
    write_bytes(path, TEXT_OF, sizeof TEXT_OF - 1);
    struct error err = {.text = ""};
    struct scene s;
    static const char WANT[] = ":3:7: 11 levels would make 8.39e+06 triangles of 2; of this scene yet 8388607 are made";
    CHECK(t, !parse_scene(path, &s, NULL, &err) && strstr(err.text, WANT) != NULL,
          "more triangles than a scene may have: %s", err.text);
}

/* --- what a scene may repeat ---------------------------------------------------------------------------- */

/* What is no parameter of a shape is none of its material either, of whatever kind that is: no copy is made. What is
 * one makes one. */
static void check_copies(struct test *t)
{
    static const char *const KINDS[] = {"matte", "mirror", "glass", "metal", "plastic", "substrate", "uber",
                                        "translucent", "subsurface", "kdsubsurface", "disney", "mix", "none", "matte"};
    enum { LAST = sizeof KINDS / sizeof KINDS[0] - 1, SHAPES = 20 };
    for (int k = 0; k <= LAST; k++) {
        char text[4 * TEXT];
        struct scene s;
        int n = snprintf(text, sizeof text, "WorldBegin MakeNamedMaterial \"a\" \"string type\" \"matte\"\nMaterial "
                         "\"%s\" \"string namedmaterial1\" \"a\" \"string namedmaterial2\" \"a\"\n", KINDS[k]);
        for (int i = 0; i < SHAPES; i++)
            n += snprintf(text + n, sizeof text - (size_t)n, "Shape \"sphere\" \"float %s\" .%d\n",
                          k == LAST ? "sigma" : "nosuchthing", i + 1);
        snprintf(text + n, sizeof text - (size_t)n, "WorldEnd");
        if (!scene_from_text(t, text, &s))
            continue;
        CHECK(t, k == LAST ? s.n_materials > SHAPES : s.n_materials <= 3, "%s: %d materials", KINDS[k], s.n_materials);
        scene_free(&s);
    }
}

/* A matrix may be given times any number. */
static void check_matrices(struct test *t, struct rng *r)
{
    static const char THINGS[] = "Shape \"sphere\" Shape \"trianglemesh\" \"integer indices\" [0 1 2] "
                                 "\"point P\" [0 0 0 1 0 0 0 1 0] WorldEnd";
    for (int i = 0; i < 50; i++) {
        struct scene s[2];
        struct transform m = random_affine(r);
        double w = i % 3 == 0 ? -0.5 : exp(8 * rng_uniform(r) - 4);
        for (int k = 0; k < 2; k++) {
            char text[4 * TEXT];
            int n = snprintf(text, sizeof text, "WorldBegin %s [", i % 2 ? "Transform" : "ConcatTransform");
            for (int c = 0; c < 16; c++)
                n += snprintf(text + n, sizeof text - (size_t)n, "%.17g ", m.m[c % 4][c / 4] * (k == 0 ? 1 : w));
            snprintf(text + n, sizeof text - (size_t)n, "] %s", THINGS);
            if (!scene_from_text(t, text, &s[k]))
                return;
        }
        for (int prim = 0; prim < 2; prim++) {
            float lo[2][3], hi[2][3];
            for (int k = 0; k < 2; k++)
                shape_bounds(&s[k].geo, prim ? FIRST_QUADRIC : 0, lo[k], hi[k]);
            for (int k = 0; k < 3; k++)
                CHECK(t, fabsf(lo[0][k] - lo[1][k]) + fabsf(hi[0][k] - hi[1][k]) < 1e-5f * (hi[0][k] - lo[0][k] + 1),
                      "a matrix times %g: %s from %g to %g, not from %g to %g", w, prim ? "sphere" : "mesh",
                      (double)lo[1][k], (double)hi[1][k], (double)lo[0][k], (double)hi[0][k]);
        }
        scene_free(&s[0]);
        scene_free(&s[1]);
    }
}

/* A world of n times `line`, in which "@" stands for another way each to write "", is parsed. */
static bool parse_repeated(struct test *t, const char *line, int n, struct error *err)
{
    char path[TEXT];
    size_t room = 64 + (size_t)n * (strlen(line) + 2 * (size_t)n);
    char *text = mem_alloc(room, 1);
    size_t used = (size_t)sprintf(text, "WorldBegin\n");
    for (int i = 0; i < n; i++) {
        for (const char *p = line; *p != '\0'; p++)
            if (*p != '@')
                text[used++] = *p;
            else
                for (int k = 0; k < i; k++)
                    used += (size_t)sprintf(text + used, "./");
        text[used++] = '\n';
    }
    used += (size_t)sprintf(text + used, "WorldEnd\n");
    snprintf(path, sizeof path, "%s/repeated.pbrt", test_tmp(t));
    write_bytes(path, text, used);
    free(text);
    struct scene s;
    bool ok = parse_scene(path, &s, NULL, err);
    if (ok)
        scene_free(&s);
    return ok;
}

/* What comes first of a file, and a comment that makes it a megabyte. */
static void put_megabyte(struct test *t, const char *name, const char *begin)
{
    enum { MEGABYTE = 1 << 20 };
    char path[TEXT], *text = mem_alloc(MEGABYTE, 1);
    memset(text, '#', MEGABYTE);
    memcpy(text, begin, strlen(begin));
    snprintf(path, sizeof path, "%s/%s", test_tmp(t), name);
    write_bytes(path, text, MEGABYTE);
    free(text);
}

/* A megabyte may be read 64 times again; so may what it holds, under whatever name. */
static void check_repeated(struct test *t)
{
    static const char LIGHTS[] = "more than 4096 infinite lights", AGAIN[] = "more than 64 MB have been read again";
    static const struct {
        const char *line;
        int most;
        const char *want;
    } CASE[] = {
        {"LightSource \"infinite\"", 4096, LIGHTS},
        {"Include \"text\"", 65, AGAIN},
        {"Include \"@text\"", 65, AGAIN},
        {"LightSource \"point\" \"spectrum I\" \"@spectrum\"", 65, AGAIN},
        {"Shape \"plymesh\" \"string filename\" \"mesh\"", 65, AGAIN},
        {"Texture \"t\" \"float\" \"imagemap\" \"string filename\" \"@picture\"", 65, AGAIN}};
    put_megabyte(t, "text", "");
    put_megabyte(t, "spectrum", "500 1\n");
    put_megabyte(t, "picture", "P5 1024 1023 255 ");
    put_megabyte(t, "mesh",
                 "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                 "element face 1\nproperty list int int vertex_indices\nend_header\n0 0 0 1 0 0 0 1 0 3 0 1 2 ");
    for (size_t i = 0; i < sizeof CASE / sizeof CASE[0]; i++) {
        struct error err = {.text = ""};
        CHECK(t, parse_repeated(t, CASE[i].line, CASE[i].most, &err), "%s: %s", CASE[i].line, err.text);
        CHECK(t, !parse_repeated(t, CASE[i].line, CASE[i].most + 1, &err), "%s is accepted",
              CASE[i].line);
        CHECK(t, strstr(err.text, CASE[i].want) != NULL, "%s: %s", CASE[i].line, err.text);
    }
}

/* Pictures of small files may take so much together, those of large ones anything; what is too much is the end. */
static void check_unpacked(struct test *t)
{
    uint8_t pixel = 0;
    uint64_t content = 0;
    struct scene_files f = {.scene_path = "", .content = &content};
    struct image small = {.width = 8192, .height = 8192, .channels = 1, .u8 = &pixel, .content = 1};
    struct image large = small;
    large.content = 2;
    large.file_size = 1 << 21;
    struct error err = {.text = ""};
    bool ok = true;
    for (int i = 0; i < 3; i++) {
        small.content = 3 + (uint64_t)i;
        ok = ok && scene_files_picture(&f, &small, 0, &err);
    }
    ok = ok && scene_files_picture(&f, &large, 0, &err);
    CHECK(t, ok, "192 MB of pictures: %s", err.text);
    small.content++;
    CHECK(t, !scene_files_picture(&f, &small, 0, &err) && strstr(err.text, "more than 192 MB") != NULL, "%s", err.text);
    CHECK(t, scene_files_path(&f, "a.png", &err) == NULL && strstr(err.text, "a.png: not read") != NULL, "%s",
          err.text);
    symbols_free(&f.known);
}

/* No more errors than are told are looked for. */
static void check_many_errors(struct test *t)
{
    struct hearing *heard = mem_alloc(1, sizeof *heard);
    struct message_sink sink = {hear_warning, hear_error, heard};
    struct error err = {.text = ""};
    char path[TEXT];
    parse_repeated(t, "Shpae", 1000, &err);
    snprintf(path, sizeof path, "%s/repeated.pbrt", test_tmp(t));
    struct scene s;
    CHECK(t, !parse_scene(path, &s, &sink, &err), "unknown directives are accepted");
    CHECK(t, strstr(heard->errors.text[heard->errors.n - 1], "and 19 more errors") != NULL, "the last error is %s",
          heard->errors.text[heard->errors.n - 1]);
    free(heard);
}

/* A scene names files: not standard input, no pipe and no device. */
static void check_no_files(struct test *t)
{
    static const char *const NAMES[][2] = {
        {"fifo", "scenes name files, not devices or pipes"}, {"/dev/null", "scenes name files, not devices or pipes"},
        {"directory", "scenes name files, not directories"}, {"-", "No such file"}};
    char path[TEXT], line[TEXT];
    snprintf(path, sizeof path, "%s/fifo", test_tmp(t));
    CHECK(t, mkfifo(path, 0600) == 0, "cannot make a pipe");
    snprintf(path, sizeof path, "%s/directory", test_tmp(t));
    CHECK(t, os_make_directory(path), "cannot make a directory");
    static const char *const LINES[] = {"Include \"%s\"", "LightSource \"infinite\" \"string mapname\" \"%s\"",
                                        "LightSource \"point\" \"spectrum I\" \"%s\"",
                                        "Shape \"plymesh\" \"string filename\" \"%s\""};
    for (int i = 0; i < 16; i++) {
        struct error err = {.text = ""};
        snprintf(line, sizeof line, LINES[i / 4], NAMES[i % 4][0]);
        CHECK(t, !parse_repeated(t, line, 1, &err) && strstr(err.text, NAMES[i % 4][1]) != NULL, "%s: %s", line,
              err.text);
    }
}

/* --- damaged files -------------------------------------------------------------------------------------- */

/* Bytes that mean something to the parser, and some that do not. */
static char odd_byte(struct rng *r)
{
    static const char BYTES[] = "\"[]#\\-+.eE019 \n\tZ";
    int k = (int)(rng_uniform(r) * 20);
    return k < (int)sizeof BYTES ? BYTES[k] : (char)(rng_uniform(r) * 256 - 128);
}

/* Cut, change, remove, double or replace a part of the text in place; returns the new size (room for twice `size`).
 */
static size_t damage(struct rng *r, char *text, size_t size)
{
    size_t at = (size_t)(rng_uniform(r) * (double)size), n = 1 + (size_t)(rng_uniform(r) * 12);
    if (at + n > size)
        n = size - at;
    switch ((int)(rng_uniform(r) * 5)) {
    case 0: return at;
    case 1: text[at] = odd_byte(r); return size;
    case 2: memmove(text + at, text + at + n, size - at - n); return size - n;
    case 3: memmove(text + at + n, text + at, size - at); return size + n;
    default:
        for (size_t i = 0; i < n; i++)
            text[at + i] = odd_byte(r);
        return size;
    }
}

static void check_damaged(struct test *t, const struct fixtures *f, int rounds)
{
    char path[TEXT], from[TEXT];
    size_t n = strlen(top_directory(from, sizeof from));
    snprintf(from + n, sizeof from - n, "%s/parts", FIXTURES);
    snprintf(path, sizeof path, "%s/parts", test_tmp(t));
    if (!CHECK(t, symlink(from, path) == 0, "cannot make a link"))
        return;
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 2, 0);
    int accepted = 0, refused = 0, first_ok = 0, n_ok = 0;
    for (int i = 0; i < f->n; i++)
        if (strncmp(f->name[i], "ok-", 3) == 0 && n_ok++ == 0)
            first_ok = i;
    if (!CHECK(t, n_ok > 0, "no fixture is ok"))
        return;
    for (int i = 0; i < rounds; i++) {
        struct error err = {.text = ""};
        size_t size;
        int pick = i % 2 == 0 ? i / 2 % f->n : first_ok + i / 2 % n_ok; /* every other one was whole before */
        snprintf(from, sizeof from, "%s/%s", FIXTURES, f->name[pick]);
        char *text = text_read(from, &size, &err);
        text = realloc(text, 2 * size + 64);
        size = damage(&r, text, size);
        if (i % 3 == 0 && size > 0)
            size = damage(&r, text, size);
        snprintf(path, sizeof path, "%s/damaged.pbrt", test_tmp(t));
        remove(path); /* a new file is cheaper than an old one cut to nothing */
        write_bytes(path, text, size);
        free(text);
        struct scene s;
        if (parse_scene(path, &s, NULL, &err)) {
            accepted++;
            scene_free(&s);
        } else {
            refused++;
            CHECK(t, strchr(err.text, ':') != NULL, "a refusal without a place: %s", err.text);
            struct error clean = err;
            error_clean(clean.text);
            size_t k = 0;
            while (err.text[k] != '\0' && (err.text[k] == clean.text[k] || err.text[k] == '\n'))
                k++;
            CHECK(t, err.text[k] == '\0', "a refusal holds the byte %02x", (unsigned)(unsigned char)err.text[k]);
        }
    }
    CHECK(t, accepted > rounds / 100 && refused > rounds / 2, "%d accepted, %d refused", accepted, refused);
}

void test_parser(struct test *t)
{
    struct fixtures *f = mem_alloc(1, sizeof *f);
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 0, 0);
    list_fixtures(f);
    if (CHECK(t, f->n >= 170, "only %d fixtures in %s: run the tests at the top of the tree", f->n, FIXTURES)) {
        for (int i = 0; i < f->n; i++)
            check_fixture(t, f->name[i]);
        check_damaged(t, f, 2000);
    }
    free(f);
    check_symbols(t);
    check_nothing_quoted(t);
    check_numbers(t);
    check_spectra(t);
    check_suggestions(t);
    check_cleaning(t);
    check_odd_bytes(t);
    check_subdivided(t);
    check_copies(t);
    check_matrices(t, &r);
    check_repeated(t);
    check_unpacked(t);
    check_many_errors(t);
    check_no_files(t);
    struct error err;
    struct scene s;
    CHECK(t,
          !parse_scene("test/fixtures/none.pbrt", &s, NULL, &err) &&
              strstr(err.text, "none.pbrt: cannot open") != NULL,
          "a missing file");
    CHECK(t,
          !parse_scene("test/fixtures", &s, NULL, &err) && !parse_scene("test/fixtures/none.pbrt", &s, NULL, NULL),
          "a directory; nobody listens");
}
