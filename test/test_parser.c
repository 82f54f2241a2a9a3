/* test_parser.c: scene files.
 *
 * Every file of test/fixtures says in its first line what must come of it: "# expect: ok", or LINE:COL and a part
 * of the message of the first error; further lines "# also: ..." name parts of the other errors and "# warn: ..." of
 * the warnings, in order. What a scene must contain is
 * checked here for the fixtures ok-*. Then: numbers against strtod, spectra against known colours, and damaged
 * copies of all fixtures, which must be accepted or refused, never crash (run it with sanitizers).
 */
#define _POSIX_C_SOURCE 200809L

#include <dirent.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "parser/lexer.h"
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
    struct error err = {""};
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
    if (ok)
        scene_free(&s);
    free(heard);
    free(text);
}

/* --- contents ------------------------------------------------------------------------------------------- */

/* Parse an ok-fixture; the caller frees the scene. */
static bool open_scene(struct test *t, const char *name, struct scene *s)
{
    char path[TEXT];
    struct error err = {""};
    snprintf(path, sizeof path, "%s/ok-%s.pbrt", FIXTURES, name);
    return CHECK(t, parse_scene(path, s, NULL, &err), "%s", err.text);
}

static bool near(double a, double b) { return fabs(a - b) <= 1e-9 * fmax(1, fabs(b)); }
static bool same3(vec3 a, double x, double y, double z) { return near(a.x, x) && near(a.y, y) && near(a.z, z); }
static bool same_rgb(rgb a, double r, double g, double b) { return near(a.r, r) && near(a.g, g) && near(a.b, b); }

static bool is_constant(const struct scene *s, int texture, double r, double g, double b)
{
    const struct texture *x = &s->textures.texture[texture];
    return texture >= 0 && x->kind == TEXTURE_CONSTANT && same_rgb(x->constant, r, g, b);
}

static bool is_grey(const struct scene *s, int texture, double v) { return is_constant(s, texture, v, v, v); }

static void check_options(struct test *t)
{
    struct scene s;
    if (!open_scene(t, "minimal", &s))
        return;
    CHECK(t, s.width == 1280 && s.height == 720 && s.spp == 0 && s.integrator == NULL && s.film_filename == NULL,
          "defaults without directives");
    CHECK(t, s.camera.fov == 90 && s.filter.kind == FILTER_BOX && s.filter.radius[0] == 0.5,
          "default camera, filter");
    scene_free(&s);
    if (!open_scene(t, "options", &s))
        return;
    CHECK(t, s.width == 200 && s.height == 100 && s.film_scale == 2, "film");
    CHECK(t, s.crop[0] == .25 && s.crop[1] == .75 && s.crop[2] == 0 && s.crop[3] == .5,
          "crop window is put in order");
    CHECK(t, strcmp(s.film_filename, "image.exr") == 0, "film name %s", s.film_filename);
    CHECK(t,
          s.camera.fov == 40 && s.camera.frame_aspect_ratio == 1.5 && s.camera.lens_radius == .1 &&
              s.camera.focal_distance == 5,
          "camera");
    CHECK(t, s.camera.has_screen_window && s.camera.screen_window[0] == -1 && s.camera.screen_window[3] == 2,
          "screen window");
    CHECK(t, same3(transform_point(&s.camera.world_to_camera, vec(0, 0, 0)), 0, 0, 5), "world to camera");
    CHECK(t,
          s.filter.kind == FILTER_MITCHELL && s.filter.radius[0] == 3 && s.filter.radius[1] == 2.5 &&
              s.filter.B == .5 && s.filter.C == .25,
          "filter");
    CHECK(t, s.spp == 24 && s.settings.n == 5, "samples per pixel");
    CHECK(t, strcmp(s.integrator, "bdpt") == 0, "integrator");
    static const char *const WANT[][2] = {{"maxdepth", "7"},
                                          {"visualize", "true"},
                                          {"threshold", "0.1"},
                                          {"select", "vertices"},
                                          {"pixelbounds", "0"}};
    for (int i = 0; i < 5; i++)
        CHECK(t, strcmp(settings_text(&s.settings, WANT[i][0], ""), WANT[i][1]) == 0, "setting %s is %s",
              WANT[i][0], settings_text(&s.settings, WANT[i][0], "absent"));
    CHECK(t, ends_in(s.settings.item[0].origin, "ok-options.pbrt:3:19"), "origin %s", s.settings.item[0].origin);
    scene_free(&s);
    if (!open_scene(t, "filters", &s))
        return;
    CHECK(t,
          s.filter.kind == FILTER_GAUSSIAN && s.filter.radius[0] == 1.5 && s.filter.radius[1] == 2 &&
              s.filter.alpha == 3 && s.camera.fov == 30,
          "the last filter counts; halffov");
    scene_free(&s);
}

static vec3 centre(const struct scene *s, int quadric)
{
    return transform_point(&s->geo.quadric[quadric].to_world, vec(0, 0, 0));
}

static void check_transforms(struct test *t)
{
    static const double WANT[][3] = {{0, 0, 0}, {1, 2, 3}, {3, 2, 3}, {0, 1, 0}, {0, 0, 0},   {3, 2, 3},
                                     {5, 6, 7}, {6, 7, 8}, {0, 0, 0}, {9, 9, 9}, {-1, -2, -3}};
    enum { N = sizeof WANT / sizeof WANT[0] };
    struct scene s;
    if (!open_scene(t, "transforms", &s))
        return;
    if (CHECK(t, s.geo.n_quadrics == N, "%d spheres", s.geo.n_quadrics))
        for (int i = 0; i < N; i++) {
            vec3 c = centre(&s, i);
            CHECK(t, length(sub(c, vec(WANT[i][0], WANT[i][1], WANT[i][2]))) < 1e-12,
                  "sphere %d is at %g %g %g, not %g %g %g", i, c.x, c.y, c.z, WANT[i][0], WANT[i][1], WANT[i][2]);
        }
    scene_free(&s);
    if (!open_scene(t, "motion", &s))
        return;
    CHECK(t, same3(centre(&s, 0), 0, 0, 0) && same3(centre(&s, 1), 0, 1, 0), "end-time transforms are ignored");
    scene_free(&s);
    if (!open_scene(t, "objects", &s))
        return;
    if (CHECK(t, s.geo.n_quadrics == 2 && s.geo.n_triangles == 2, "two instances of two shapes"))
        CHECK(t,
              same3(centre(&s, 0), 1, 5, 0) && same3(centre(&s, 1), 2, 5, 0) && s.geo.P[9] == 2 && s.geo.P[10] == 5,
              "instances are placed by instance transform times object transform");
    scene_free(&s);
}

static void check_values(struct test *t)
{
    struct scene s;
    if (!open_scene(t, "values", &s))
        return;
    const struct light *l = s.lights.light;
    CHECK(t, same_rgb(l[0].L, 1, 2, 3) && same_rgb(l[1].L, 1, 2, 3), "rgb, color");
    CHECK(t, rgb_max(rgb_sub(l[2].L, rgb_grey(1))) < 1e-3, "xyz of white is white: %g %g %g", l[2].L.r, l[2].L.g,
          l[2].L.b);
    rgb black = spectrum_blackbody(6500, 2);
    CHECK(t, same_rgb(l[3].L, black.r, black.g, black.b), "blackbody");
    double flat[1][2] = {{500, 1}};
    rgb equal = spectrum_from_samples(flat, 1);
    CHECK(t, same_rgb(l[4].L, equal.r, equal.g, equal.b) && same_rgb(l[5].L, equal.r, equal.g, equal.b), "spectra");
    CHECK(t, same_rgb(l[6].L, 2, 2, 2) && same3(l[6].position, 1, 2, 3), "scale, from");
    CHECK(t, s.lights.n == 8 && !l[7].two_sided && s.geo.n_triangles == 1, "the last area light counts");
    CHECK(t, is_grey(&s, s.material[s.geo.group[0].material].sigma, .5), "a quoted name");
    CHECK(t, s.geo.group[0].has_uv && s.geo.UV[2] == 1 && s.geo.UV[5] == 1, "st");
    scene_free(&s);
    if (!open_scene(t, "numbers", &s))
        return;
    static const float P[9] = {0, 1.74846e-7f, 3, .5f, -.25f, 1, 100, .01f, 123456789.125f};
    for (int i = 0; i < 9; i++)
        CHECK(t, s.geo.P[i] == P[i], "number %d is %.9g, not %.9g", i, (double)s.geo.P[i], (double)P[i]);
    CHECK(t, s.geo.quadric[0].radius == 0.1, "a comment may touch a number");
    scene_free(&s);
}

/* Texture coordinates for more points than there are serve those that there are; for fewer, none. */
static void check_uv(struct test *t)
{
    struct scene s;
    if (!open_scene(t, "mesh-uv", &s))
        return;
    CHECK(t, s.geo.n_groups == 2 && s.geo.group[0].has_uv && s.geo.UV[5] == 1 && !s.geo.group[1].has_uv,
          "4 and 2 uv of 3 points");
    scene_free(&s);
}

static void check_shapes(struct test *t)
{
    struct scene s;
    if (!open_scene(t, "shapes", &s))
        return;
    const struct shape_group *g = s.geo.group;
    if (!CHECK(t, s.geo.n_triangles == 15 && s.geo.n_quadrics == 7 && s.geo.n_groups == 11,
               "alpha 0 and material none are left out")) {
        scene_free(&s);
        return;
    }
    CHECK(t, g[0].has_n && g[0].has_uv && g[0].alpha >= 0 && is_grey(&s, g[0].shadow_alpha, 0), "mesh group");
    CHECK(t, !g[1].has_n && g[1].has_uv && g[1].alpha == -1 && g[1].shadow_alpha == g[0].alpha, "ply group");
    CHECK(t, !g[2].flip && g[3].flip && g[0].first_light == -1 && g[2].material == 1, "quadric groups");
    const struct quadric *q = s.geo.quadric;
    CHECK(t, q[0].kind == QUADRIC_SPHERE && q[0].zmin == -2 && q[0].zmax == 1 && near(q[0].phi_max, PI), "sphere");
    CHECK(t, q[1].kind == QUADRIC_DISK && q[1].zmin == 1 && q[1].inner_radius == 1 && near(q[1].phi_max, PI / 2),
          "disk");
    CHECK(t, q[2].kind == QUADRIC_CYLINDER && q[2].zmin == -1 && q[2].zmax == 2 && near(q[2].phi_max, 2 * PI),
          "cylinder");
    CHECK(t, q[3].kind == QUADRIC_CONE && q[3].radius == 2 && q[3].zmin == 0 && q[3].zmax == 3 &&
                 near(q[3].phi_max, PI / 2), "cone");
    CHECK(t, q[4].kind == QUADRIC_PARABOLOID && q[4].radius == 2 && q[4].zmin == 1 && q[4].zmax == 3, "paraboloid");
    CHECK(t, q[5].kind == QUADRIC_HYPERBOLOID && same3(q[5].p1, 3, 0, 0) && same3(q[5].p2, 1, 2, 3) && q[5].zmax == 3,
          "hyperboloid: from the end at height 0");
    CHECK(t, same3(q[6].p1, 0, 0, 0) && same3(q[6].p2, 1, 1, 1) && near(q[6].radius, sqrt(2)), "default hyperboloid");
    CHECK(t, g[9].has_n && !g[9].has_uv && g[10].first_prim - g[9].first_prim == 8, "one level of subdivision");
    const int first = s.geo.n_vertices - 6;
    const float *P = s.geo.P + 3 * (first + 3), *uv = s.geo.UV + 2 * (first + 3);
    const uint32_t *last = s.geo.index + 3 * (s.geo.n_triangles - 1);
    CHECK(t, P[0] == 0 && P[1] == 1 && P[2] == 13 && uv[0] == 0 && uv[1] == 1, "a point of the heightfield");
    CHECK(t, last[0] == (uint32_t)first + 1 && last[1] == (uint32_t)first + 5 && last[2] == (uint32_t)first + 4,
          "its last triangle");
    scene_free(&s);
}

/* pbrt-v3's default of each parameter; NaN: the kind has none. */
static void check_material_defaults(struct test *t, const struct scene *s)
{
    const double no = nan("");
    const struct {
        enum material_kind kind;
        double Kd, Ks, Kr, Kt, sigma, index, roughness, opacity, reflect, transmit;
    } WANT[] = {{MATERIAL_MATTE, .5, no, no, no, 0, no, no, no, no, no},
                {MATERIAL_MIRROR, no, no, .9, no, no, no, no, no, no, no},
                {MATERIAL_GLASS, no, no, 1, 1, no, 1.5, 0, no, no, no},
                {MATERIAL_METAL, no, no, no, no, no, no, .01, no, no, no},
                {MATERIAL_PLASTIC, .25, .25, no, no, no, no, .1, no, no, no},
                {MATERIAL_SUBSTRATE, .5, .5, no, no, no, no, .1, no, no, no},
                {MATERIAL_UBER, .25, .25, 0, 0, no, 1.5, .1, 1, no, no},
                {MATERIAL_TRANSLUCENT, .25, .25, no, no, no, no, .1, no, .5, .5}};
    for (int i = 0; i < 8; i++) {
        const struct material *m = &s->material[i + 1];
        const double want[] = {WANT[i].Kd,      WANT[i].Ks,      WANT[i].Kr,        WANT[i].Kt,
                               WANT[i].sigma,   WANT[i].index,   WANT[i].roughness, WANT[i].roughness,
                               WANT[i].opacity, WANT[i].reflect, WANT[i].transmit};
        const int is[] = {m->Kd,         m->Ks,         m->Kr,      m->Kt,      m->sigma,   m->index,
                          m->uroughness, m->vroughness, m->opacity, m->reflect, m->transmit};
        bool ok = m->kind == WANT[i].kind && m->bump == -1 && m->remap_roughness && m->mix1 == -1;
        for (int k = 0; k < 11; k++)
            ok = ok && (isnan(want[k]) ? is[k] == -1 : is_grey(s, is[k], want[k]));
        CHECK(t, ok, "defaults of material %d", i);
    }
    CHECK(t, is_constant(s, s->material[4].eta, 0.199990, 0.922086, 1.099876), "metal is copper");
}

static void check_materials(struct test *t)
{
    struct scene s;
    if (!open_scene(t, "materials", &s))
        return;
    check_material_defaults(t, &s);
    const struct material *m = s.material;
    CHECK(t, is_constant(&s, m[9].Kd, .1, .2, .3) && is_grey(&s, m[9].sigma, 20), "matte");
    CHECK(t, m[11].kind == MATERIAL_MIX && m[11].mix1 == 9 && m[11].mix2 == 10 && is_grey(&s, m[11].amount, .2),
          "mix");
    CHECK(t,
          is_constant(&s, m[12].Kt, 1, 0, 0) && is_grey(&s, m[12].index, 1.33) &&
              is_grey(&s, m[12].uroughness, .1) && is_grey(&s, m[12].vroughness, .3) &&
              m[12].bump == m[12].vroughness && !m[12].remap_roughness,
          "glass");
    CHECK(t, is_grey(&s, m[13].eta, 1) && is_grey(&s, m[13].uroughness, .2) && is_grey(&s, m[13].vroughness, .4),
          "metal: roughness for both, vroughness for one");
    CHECK(t, is_grey(&s, m[14].vroughness, .5) && !m[14].remap_roughness, "plastic");
    CHECK(t, is_grey(&s, m[15].uroughness, .2) && is_grey(&s, m[15].vroughness, .3), "substrate");
    CHECK(t, is_grey(&s, m[16].uroughness, .3) && is_grey(&s, m[16].index, 1.2) && is_grey(&s, m[16].opacity, .5),
          "uber");
    CHECK(t, is_grey(&s, m[17].uroughness, .7) && is_grey(&s, m[17].reflect, 1) && is_grey(&s, m[17].transmit, 0),
          "translucent");
    CHECK(t, s.geo.n_quadrics == 1 && s.geo.group[0].material == 9,
          "named material; shapes of \"none\" are left out");
    scene_free(&s);
    if (!open_scene(t, "scopes", &s))
        return;
    const struct shape_group *g = s.geo.group;
    CHECK(t,
          m != NULL && s.material[g[0].material].kind == MATERIAL_GLASS &&
              s.material[g[1].material].kind == MATERIAL_MATTE &&
              s.material[g[2].material].kind == MATERIAL_MIRROR && is_grey(&s, s.material[g[3].material].sigma, 10),
          "names and material return at AttributeEnd");
    scene_free(&s);
}

/* Shapes that change parameters of their material. */
static void check_changed_materials(struct test *t)
{
    struct scene s;
    if (!open_scene(t, "changed", &s))
        return;
    const struct shape_group *g = s.geo.group;
    const struct material *m[5];
    for (int i = 0; i < 5; i++)
        m[i] = &s.material[g[i].material];
    CHECK(t, is_constant(&s, m[0]->Kd, 1, 0, 0) && is_grey(&s, m[0]->sigma, 0), "of the material at the start");
    CHECK(t, is_constant(&s, m[1]->Kd, 0, 0, 1) && is_grey(&s, m[1]->sigma, 10), "a colour for a texture");
    CHECK(t, s.textures.texture[m[2]->Kd].kind == TEXTURE_SCALE, "what the material does not have changes nothing");
    CHECK(t, s.textures.texture[m[3]->Kd].kind == TEXTURE_SCALE && is_grey(&s, m[3]->sigma, 20), "of a named one");
    CHECK(t, is_grey(&s, m[4]->uroughness, 0.5) && m[4]->eta == m[4][-1].eta, "of one with a colour from a file");
    CHECK(t, s.geo.quadric[1].radius == 2, "the shape's own parameters remain its own");
    scene_free(&s);
}

/* The k-th texture that is not a plain constant. */
static const struct texture *texture_number(const struct scene *s, int k)
{
    for (int i = 0; i < s->textures.n_textures; i++)
        if (s->textures.texture[i].kind != TEXTURE_CONSTANT && k-- == 0)
            return &s->textures.texture[i];
    return NULL;
}

static void check_textures(struct test *t)
{
    struct scene s;
    if (!open_scene(t, "textures", &s))
        return;
    const struct texture *x[8];
    bool all = true;
    for (int i = 0; i < 8; i++)
        all = (x[i] = texture_number(&s, i)) != NULL && all;
    if (CHECK(t, all, "eight textures that are not constant")) {
        CHECK(t,
              x[0]->kind == TEXTURE_SCALE && is_constant(&s, x[0]->tex1, .1, .2, .3) &&
                  is_grey(&s, x[0]->tex2, 2),
              "scale");
        CHECK(t,
              x[1]->kind == TEXTURE_MIX && is_grey(&s, x[1]->tex1, 1) &&
                  is_grey(&s, x[1]->amount, .25),
              "mix");
        const struct mapping *m = &x[2]->map;
        CHECK(t,
              x[2]->kind == TEXTURE_CHECKERBOARD && is_grey(&s, x[2]->tex2, 0) && m->su == 4 &&
                  m->sv == 2 && m->du == .5 && m->dv == .25,
              "checkerboard and mapping");
        CHECK(t, x[3]->wrap == WRAP_CLAMP && x[3]->scale == 2 && !x[3]->gamma,
              "pfm");
        CHECK(t,
              x[4]->wrap == WRAP_BLACK && x[4]->gamma && !x[5]->gamma &&
                  x[5]->wrap == WRAP_REPEAT,
              "tga is decoded unless told otherwise");
        CHECK(t, s.textures.n_images == 2 && x[4]->image == x[5]->image, "images are shared");
        CHECK(t,
              same_rgb(x[6]->v00, 1, 0, 0) && same_rgb(x[6]->v01, 1, 1, 1) &&
                  same_rgb(x[6]->v10, 0, 0, 0) && x[7]->v01.r == 3,
              "bilerp");
    }
    scene_free(&s);
}

static void check_cameras(struct test *t)
{
    struct scene s;
    if (open_scene(t, "orthographic", &s)) {
        CHECK(t, s.camera.kind == CAMERA_ORTHOGRAPHIC && s.camera.has_screen_window && s.camera.screen_window[3] == 4 &&
                     s.camera.lens_radius == 0, "orthographic camera");
        scene_free(&s);
    }
    if (open_scene(t, "environment", &s)) {
        CHECK(t, s.camera.kind == CAMERA_ENVIRONMENT && s.camera.lens_radius == 0, "environment camera");
        scene_free(&s);
    }
}

static void check_lights(struct test *t)
{
    struct scene s;
    if (!open_scene(t, "lights", &s))
        return;
    const struct light *l = s.lights.light;
    if (CHECK(t, s.lights.n == 12, "%d lights", s.lights.n)) {
        CHECK(t, l[0].kind == LIGHT_POINT && same3(l[0].position, 1, 2, 3) && same_rgb(l[0].L, 1, 2, 3), "point");
        CHECK(t,
              l[1].kind == LIGHT_SPOT && same3(transform_vector(&l[1].to_world, vec(0, 0, 1)), 0, 1, 0) &&
                  near(l[1].cos_total, .5) && near(l[1].cos_falloff, sqrt(.5)),
              "spot");
        CHECK(t, l[2].kind == LIGHT_DISTANT && same3(l[2].direction, 0, 1, 0) && same_rgb(l[2].L, 2, 2, 2),
              "distant");
        CHECK(t, l[3].kind == LIGHT_INFINITE && l[3].env == NULL && same_rgb(l[3].L, .5, .5, .5), "infinite");
        CHECK(t, l[4].kind == LIGHT_INFINITE && l[4].env != NULL && l[4].env == s.lights.picture[0].env,
              "environment map");
        CHECK(t,
              l[5].kind == LIGHT_AREA && l[5].two_sided && same_rgb(l[5].L, 6, 4, 2) && l[5].prim == 0 &&
                  l[6].prim == 1 && l[7].prim == FIRST_QUADRIC,
              "one area light per primitive");
        CHECK(t,
              s.geo.group[0].first_light == 5 && s.geo.group[1].first_light == 7 &&
                  s.geo.group[3].first_light == -1 && s.geo.n_groups == 4,
              "groups know their lights; AttributeEnd ends the area light");
        CHECK(t, s.geo.group[2].first_light == 8 && s.geo.group[2].material == -1 && s.geo.group[3].material >= 0,
              "a light of material none stays, without a material");
        CHECK(t, l[9].kind == LIGHT_GONIOMETRIC && same3(l[9].position, 1, 2, 3) && same_rgb(l[9].L, 1, 2, 3) &&
                     l[9].slide == NULL, "goniometric");
        CHECK(t, l[10].kind == LIGHT_PROJECTION && same_rgb(l[10].L, 2, 4, 6) && near(l[10].tan_half, 1) &&
                     l[10].slide != NULL, "projection");
        CHECK(t, near(l[11].tan_half, tan(PI / 8)) && l[11].slide == NULL, "default projection");
    }
    scene_free(&s);
}

/* --- pieces --------------------------------------------------------------------------------------------- */

/* Of a file that is no scene messages quote no line. */
static void check_nothing_quoted(struct test *t)
{
    struct scene s;
    struct error err = {""};
    struct hearing *heard = mem_alloc(1, sizeof *heard);
    struct message_sink sink = {hear_warning, hear_error, heard};
    CHECK(t, !parse_scene("test/fixtures/include-no-scene.pbrt", &s, &sink, &err) && heard->errors.n == 1 &&
                 strstr(err.text, "secret") == NULL, "%d errors, the first\n%s", heard->errors.n, err.text);
    free(heard);
}

/* As many chains as names: all are found, the newest first, and forgotten again. */
static void check_symbols(struct test *t)
{
    enum { N = 5000 };
    struct symbols table = {0};
    char name[32];
    int wrong = symbols_find(&table, "0") != -1;
    for (int i = 0; i < 2 * N; i++) {
        snprintf(name, sizeof name, "%d", i % N);
        symbols_add(&table, name, i);
    }
    for (int half = 1; half >= 0; half--) {
        for (int i = 0; i < N; i++) {
            snprintf(name, sizeof name, "%d", i);
            wrong += symbols_find(&table, name) != half * N + i;
        }
        symbols_forget(&table, N);
    }
    symbols_forget(&table, 0);
    CHECK(t, wrong == 0 && symbols_find(&table, "0") == -1, "%d names are wrong", wrong);
    symbols_free(&table);
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

static void check_spectra(struct test *t)
{
    double flat[1][2] = {{500, 2}};
    CHECK(t,
          near(rgb_luminance(spectrum_from_samples(flat, 1)), 2) ||
              fabs(rgb_luminance(spectrum_from_samples(flat, 1)) - 2) < 1e-4,
          "a constant spectrum has Y = its value");
    /* Colours computed with the CIE 1931 tables in steps of 1 nm, scaled to Y = 1 for a constant spectrum. */
    static const struct {
        double kelvin, r, g, b;
    } WANT[] = {{3000, 0.73663, 0.35123, 0.11322}, {6500, 0.92418, 0.87135, 0.91716}};
    for (int i = 0; i < 2; i++) {
        rgb c = spectrum_blackbody(WANT[i].kelvin, 1);
        double off = rgb_max(rgb_make(fabs(c.r - WANT[i].r), fabs(c.g - WANT[i].g), fabs(c.b - WANT[i].b)));
        CHECK(t, off < 0.01, "%g K: %g %g %g", WANT[i].kelvin, c.r, c.g, c.b);
    }
    double steps[4][2] = {{700, .6}, {500, .9}, {600, .2}, {400, .1}};
    rgb c = spectrum_from_samples(steps, 4);
    CHECK(t, fabs(c.r - .1745) < .01 && fabs(c.g - .6016) < .01 && fabs(c.b - .4721) < .01,
          "unsorted samples: %g %g %g", c.r, c.g, c.b);
    double mixed[4][2] = {{700, 1}, {500, 1}, {500, 0}, {400, 0}}, up[4][2] = {{400, 0}, {500, 0}, {500, 1}, {700, 1}};
    double down[4][2] = {{400, 1}, {500, 1}, {500, 0}, {700, 0}}, one[1][2] = {{500, 1}};
    rgb a = spectrum_from_samples(mixed, 4), b = spectrum_from_samples(up, 4);
    CHECK(t, a.r == b.r && a.g == b.g && a.b == b.b, "a step whose samples are out of order goes up");
    rgb rest = rgb_sub(spectrum_from_samples(one, 1), rgb_add(spectrum_from_samples(down, 4), b));
    CHECK(t, same_rgb(rest, 0, 0, 0), "steps up and down are the whole: %g %g %g", rest.r, rest.g, rest.b);
    CHECK(t, rgb_is_black(spectrum_blackbody(0, 1)), "0 K is black");
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
    struct error err = {""};
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
    struct error err = {""};
    struct scene s;
    static const char WANT[] = ":3:7: 11 levels would make 8.39e+06 triangles of 2; of this scene yet 8388607 are made";
    CHECK(t, !parse_scene(path, &s, NULL, &err) && strstr(err.text, WANT) != NULL,
          "more triangles than a scene may have: %s", err.text);
}

/* --- what a scene may repeat ---------------------------------------------------------------------------- */

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
        struct error err = {""};
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
    struct error err = {""};
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
    struct error err = {""};
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
        {"parts", "scenes name files, not directories"}, {"-", "No such file"}};
    char path[TEXT], line[TEXT];
    snprintf(path, sizeof path, "%s/fifo", test_tmp(t));
    CHECK(t, mkfifo(path, 0600) == 0, "cannot make a pipe");
    snprintf(path, sizeof path, "%s/parts", test_tmp(t));
    CHECK(t, os_make_directory(path), "cannot make a directory");
    static const char *const LINES[] = {"Include \"%s\"", "LightSource \"infinite\" \"string mapname\" \"%s\"",
                                        "LightSource \"point\" \"spectrum I\" \"%s\"",
                                        "Shape \"plymesh\" \"string filename\" \"%s\""};
    for (int i = 0; i < 16; i++) {
        struct error err = {""};
        snprintf(line, sizeof line, LINES[i / 4], NAMES[i % 4][0]);
        CHECK(t, !parse_repeated(t, line, 1, &err) && strstr(err.text, NAMES[i % 4][1]) != NULL, "%s: %s", line,
              err.text);
    }
}

/* --- damaged files -------------------------------------------------------------------------------------- */

static void copy_file(const char *from, const char *to)
{
    struct error err;
    size_t size;
    char *text = text_read(from, &size, &err);
    if (text != NULL)
        write_bytes(to, text, size);
    free(text);
}

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
    static const char *const PARTS[] = {"triangle.ply", "broken.ply",   "map.pfm",  "grey.tga",
                                        "equal.spd",    "broken.spd",   "box.pbrt", "options.pbrt",
                                        "wrong.pbrt",   "through.pbrt", "a.pbrt",   "b.pbrt"};
    char path[TEXT], from[TEXT];
    snprintf(path, sizeof path, "%s/parts", test_tmp(t));
    if (!CHECK(t, os_make_directory(path), "cannot make a directory"))
        return;
    for (size_t i = 0; i < sizeof PARTS / sizeof PARTS[0]; i++) {
        snprintf(from, sizeof from, "%s/parts/%s", FIXTURES, PARTS[i]);
        snprintf(path, sizeof path, "%s/parts/%s", test_tmp(t), PARTS[i]);
        copy_file(from, path);
    }
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 2, 0);
    int accepted = 0, refused = 0, first_ok = 0, n_ok = 0;
    for (int i = 0; i < f->n; i++)
        if (strncmp(f->name[i], "ok-", 3) == 0 && n_ok++ == 0)
            first_ok = i;
    if (!CHECK(t, n_ok > 0, "no fixture is ok"))
        return;
    for (int i = 0; i < rounds; i++) {
        struct error err = {""};
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
    list_fixtures(f);
    if (CHECK(t, f->n >= 170, "only %d fixtures in %s: run the tests at the top of the tree", f->n, FIXTURES)) {
        for (int i = 0; i < f->n; i++)
            check_fixture(t, f->name[i]);
        check_damaged(t, f, 4000);
    }
    free(f);
    check_options(t);
    check_transforms(t);
    check_values(t);
    check_shapes(t);
    check_uv(t);
    check_materials(t);
    check_changed_materials(t);
    check_textures(t);
    check_cameras(t);
    check_lights(t);
    check_symbols(t);
    check_nothing_quoted(t);
    check_numbers(t);
    check_spectra(t);
    check_suggestions(t);
    check_cleaning(t);
    check_odd_bytes(t);
    check_subdivided(t);
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
