/* test_material.c: which lobes a material makes, mixing, and bump mapping.
 * The lobes themselves are tested in test_lobe.c and test_bsdf.c; here, how walks leave the surfaces they make. */
#include "material/material.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/warp.h"
#include "helpers.h"
#include "material/burley.h"
#include "material/lobe_list.h"
#include "suites.h"
#include "transport/path.h"

struct bench {
    struct texture_set textures;
    struct arena arena;
    struct surface at;
    int grey[11]; /* constant textures 0, 0.1 ... 1 */
};

static void set_up(struct bench *b)
{
    memset(b, 0, sizeof *b);
    for (int i = 0; i <= 10; i++)
        b->grey[i] = texture_add_constant(&b->textures, rgb_grey(i / 10.0));
    b->at.ng = b->at.ns = vec(0, 0, 1);
    b->at.dpdu = vec(2, 0, 0);
    b->at.dpdv = vec(0, 1, 0);
    b->at.u = b->at.v = 0.25;
}

static void tear_down(struct bench *b)
{
    arena_free(&b->arena);
    texture_set_free(&b->textures);
}

/* Where a parameter of a material lies. */
static void *place(struct material *m, const char *name)
{
    return (char *)m + field_find(m->row->fields, name)->place;
}

static void set(struct material *m, const char *name, int value) { *(int *)place(m, name) = value; }

/* A material whose every texture is the given one, but the bump map, which it has none of. */
static struct material *all_same(const struct material_row *row, int texture)
{
    struct material *m = material_new(row);
    for (const struct field *f = row->fields; f->name != NULL; f++)
        if (f->kind == FIELD_FLOAT_TEXTURE || f->kind == FIELD_RGB_TEXTURE)
            set(m, f->name, texture);
    m->bump = -1;
    return m;
}

static const struct material_row *row_of(const char *name)
{
    const struct material_row *const *row = material_rows;
    while (strcmp((*row)->name, name) != 0)
        row++;
    return *row;
}

static void free_all(struct material **m, int n)
{
    while (n > 0)
        free(m[--n]);
}

static struct bsdf make(struct bench *b, struct material **materials, int id)
{
    struct bsdf out;
    material_settle(materials[id], materials);
    material_bsdf(materials, id, &b->textures, &b->at, &b->arena, &out);
    return out;
}

/* The kinds of the lobes in words, for comparison. */
enum { KINDS_TEXT = 32 * MATERIAL_MAX_LOBES };
static const char *kinds(const struct bsdf *b, char text[KINDS_TEXT])
{
    static const char *const NAME[] = {[LOBE_LAMBERT_REFLECTION] = "lambert",
                                       [LOBE_LAMBERT_TRANSMISSION] = "through",
                                       [LOBE_OREN_NAYAR] = "oren-nayar",
                                       [LOBE_SPECULAR_REFLECTION] = "mirror",
                                       [LOBE_SPECULAR_TRANSMISSION] = "refraction",
                                       [LOBE_FRESNEL_SPECULAR] = "smooth-glass",
                                       [LOBE_MICROFACET_REFLECTION] = "facets",
                                       [LOBE_MICROFACET_TRANSMISSION] = "facets-through",
                                       [LOBE_FRESNEL_BLEND] = "substrate",
                                       [LOBE_PHASE] = "medium"};
    size_t used = 0;
    text[0] = '\0';
    for (int i = 0; i < b->n_lobes; i++) {
        const struct lobe *l = &b->lobe[i];
        const char *form = l->form == &form_disney ? "disney" : l->form == &form_coat ? "clearcoat" : "fourier";
        used += (size_t)snprintf(text + used, KINDS_TEXT - used, "%s%s", i > 0 ? " " : "",
                                 l->kind == LOBE_FORM ? form : NAME[l->kind]);
    }
    return text;
}

static bool any_delta(const struct bsdf *b)
{
    bool any = false;
    for (int i = 0; i < b->n_lobes; i++)
        any = any || lobe_is_delta(b->lobe[i].kind);
    return any;
}

static void lobes_of_materials(struct test *t)
{
    static const struct {
        const char *name, *lobes, *black;
    } cases[] = {{"matte", "oren-nayar", ""},
                 {"mirror", "mirror", ""},
                 {"glass", "facets facets-through", ""},
                 {"metal", "facets", "facets"},
                 {"plastic", "lambert facets", ""},
                 {"substrate", "substrate", ""},
                 {"uber", "refraction lambert facets mirror refraction", "refraction"},
                 {"translucent", "lambert through facets facets-through", ""},
                 {"disney", "disney refraction facets clearcoat facets-through", "facets"}};
    struct bench b;
    set_up(&b);
    char text[KINDS_TEXT];
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const struct material_row *row = row_of(cases[i].name);
        struct material *m[2] = {all_same(row, b.grey[5]), all_same(row, b.grey[0])};
        struct bsdf bsdf = make(&b, m, 0);
        CHECK(t, strcmp(kinds(&bsdf, text), cases[i].lobes) == 0, "%s has lobes %s, not %s", row->name, text,
              cases[i].lobes);
        CHECK(t, m[0]->most_lobes >= bsdf.n_lobes, "%s: %d lobes", row->name, m[0]->most_lobes);
        CHECK(t, row->may_be_delta || !any_delta(&bsdf), "%s says that it is never a mirror", row->name);
        const char *index = field_find(row->fields, "index") != NULL ? "index" : "eta";
        if (strcmp(row->name, "metal") != 0 && field_find(row->fields, index) != NULL)
            set(m[1], index, b.grey[5]);
        bsdf = make(&b, m, 1);
        CHECK(t, strcmp(kinds(&bsdf, text), cases[i].black) == 0, "black %s has lobes %s", row->name, text);
        free_all(m, 2);
    }
    struct material *m[4] = {all_same(row_of("matte"), b.grey[5]), all_same(row_of("glass"), b.grey[8]),
                             all_same(row_of("glass"), b.grey[3]), all_same(row_of("metal"), -1)};
    set(m[0], "sigma", b.grey[0]);
    set(m[1], "uroughness", b.grey[0]);
    set(m[1], "vroughness", b.grey[0]);
    set(m[2], "index", b.grey[10]);
    struct bsdf bsdf = make(&b, m, 0);
    CHECK(t, strcmp(kinds(&bsdf, text), "lambert") == 0 && bsdf.lobe[0].R.g == 0.5, "matte without sigma is Lambert's");
    bsdf = make(&b, m, 1);
    CHECK(t, strcmp(kinds(&bsdf, text), "smooth-glass") == 0 && bsdf.n_smooth == 0, "smooth glass");
    for (int i = 0; i < 2; i++) {
        set(m[1], i == 0 ? "uroughness" : "vroughness", b.grey[2]);
        bsdf = make(&b, m, 1);
        CHECK(t, strcmp(kinds(&bsdf, text), "facets facets-through") == 0, "glass that is rough along one axis alone");
        set(m[1], i == 0 ? "uroughness" : "vroughness", b.grey[0]);
    }
    bsdf = make(&b, m, 2);
    CHECK(t, strcmp(kinds(&bsdf, text), "smooth-glass") == 0, "glass of index 1 does not scatter");
    struct material *disney = all_same(row_of("disney"), b.grey[5]);
    set(disney, "eta", b.grey[10]);
    bsdf = make(&b, &disney, 0);
    CHECK(t, strcmp(kinds(&bsdf, text), "disney refraction facets clearcoat refraction") == 0, "disney of index 1: %s",
          text);
    free_all(&disney, 1);
    set(m[0], "Kd", texture_add_constant(&b.textures, rgb_make(-1, -2, 0)));
    bsdf = make(&b, m, 0);
    CHECK(t, bsdf.n_lobes == 0, "negative colours are black");
    set(m[3], "uroughness", b.grey[1]);
    set(m[3], "vroughness", b.grey[1]);
    bsdf = make(&b, m, 3);
    CHECK(t, bsdf.lobe[0].of.conductor.eta.b == 1.099876 && bsdf.lobe[0].of.conductor.k.r == 3.904638, "copper");
    free_all(m, 4);
    tear_down(&b);
}

static void roughness(struct test *t)
{
    CHECK(t, fabs(roughness_to_alpha(1) - 1.62142) < 1e-9, "roughness 1");
    CHECK(t, fabs(roughness_to_alpha(0.1) - 0.46176003) < 1e-7, "roughness 0.1: %.9g", roughness_to_alpha(0.1));
    CHECK(t, roughness_to_alpha(0) == roughness_to_alpha(1e-3) && roughness_to_alpha(0) > 0, "roughness 0");
    struct bench b;
    set_up(&b);
    struct material *m = all_same(row_of("substrate"), b.grey[1]);
    set(m, "vroughness", b.grey[0]);
    struct bsdf raw = make(&b, &m, 0);
    CHECK(t, raw.lobe[0].alpha_x == 0.1 && raw.lobe[0].alpha_y == 1e-3, "roughness as it is, but never 0");
    *(bool *)place(m, "remaproughness") = true;
    struct bsdf mapped = make(&b, &m, 0);
    CHECK(t, mapped.lobe[0].alpha_x == roughness_to_alpha(0.1) && mapped.lobe[0].alpha_y == roughness_to_alpha(0),
          "roughness remapped");
    free(m);
    tear_down(&b);
}

/* What Disney's parameters become: colours tinted, dimmed and shared out, roughness squared and stretched. */
static void disney(struct test *t)
{
    struct bench b;
    char text[KINDS_TEXT];
    set_up(&b);
    rgb c = rgb_make(0.4, 0.6, 0.2), tint = rgb_scale(c, 1 / rgb_luminance(c));
    struct material *m = all_same(row_of("disney"), b.grey[5]);
    set(m, "color", texture_add_constant(&b.textures, c));
    set(m, "eta", texture_add_constant(&b.textures, rgb_grey(1.5)));
    set(m, "metallic", b.grey[2]);
    struct bsdf solid = make(&b, &m, 0);
    CHECK(t, strcmp(kinds(&solid, text), "disney refraction facets clearcoat facets-through") == 0, "lobes %s", text);
    const struct lobe *l = solid.lobe;
    CHECK(t, l[0].scale.g == 0.4 && l[0].R.g == 0 && l[0].of.disney.retro.r == 0.4 && l[0].of.disney.roughness == 0.5,
          "base of scattered light");
    CHECK(t, fabs(l[0].of.disney.sheen.r - 0.25 * (1 + tint.r)) < 1e-12, "sheen");
    CHECK(t, l[1].T.g == 1 && l[1].eta_b == 1.5, "beneath");
    double plain = 0.04 * 0.5 * (1 + tint.b), aspect = sqrt(1 - 0.45);
    CHECK(t, l[2].fresnel == FRESNEL_DISNEY && l[2].separate && l[2].of.tinted.metallic == 0.2 &&
                 fabs(l[2].of.tinted.normal.b - (0.8 * plain + 0.2 * c.b)) < 1e-12, "facets");
    CHECK(t, fabs(l[2].alpha_x - 0.25 / aspect) < 1e-12 && fabs(l[2].alpha_y - 0.25 * aspect) < 1e-12, "brushed");
    CHECK(t, l[3].R.g == 0.5 && fabs(l[3].of.gloss - 0.0505) < 1e-12, "clear coat");
    CHECK(t, l[4].T.r == 0.5 * sqrt(0.4) && l[4].separate && l[4].alpha_x == l[2].alpha_x, "glass");
    *(bool *)place(m, "thin") = true;
    set(m, "flatness", b.grey[3]);
    struct bsdf thin = make(&b, &m, 0);
    CHECK(t, strcmp(kinds(&thin, text), "disney facets clearcoat facets-through through") == 0, "lobes %s", text);
    l = thin.lobe;
    CHECK(t, fabs(l[0].R.g - 0.6 * 0.75 * 0.7) < 1e-12 && fabs(l[0].of.disney.flat.g - 0.6 * 0.75 * 0.3) < 1e-12,
          "flat");
    CHECK(t, !l[3].separate && fabs(l[3].alpha_x - sqr(0.625 * 0.5) / aspect) < 1e-12, "thin glass scatters less");
    CHECK(t, l[4].T.g == 0.25 * 0.6, "light from behind");
    free(m);
    tear_down(&b);
}

/* What materials make of their parameters, which are all different: the colours of the lobes, as pbrt-v3 has them. */
static void colours(struct test *t)
{
    static const char *const NAME[] = {"transmit", "reflect", "opacity", "Kt", "Kr", "Ks", "Kd"}; /* from 0.3 on */
    static const struct {
        const char *name;
        int n;
        double R[5], T[5];
    } cases[] = {{"matte", 1, {.9}, {0}},
                 {"glass", 2, {.7, 0}, {0, .6}},
                 {"mirror", 1, {.7}, {0}},
                 {"plastic", 2, {.9, .8}, {0}},
                 {"translucent", 4, {.4 * .9, 0, .4 * .8, 0}, {0, .3 * .9, 0, .3 * .8}},
                 {"uber", 5, {0, .5 * .9, .5 * .8, .5 * .7, 0}, {.5, 0, 0, 0, .5 * .6}}};
    struct bench b;
    set_up(&b);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct material *m = all_same(row_of(cases[i].name), b.grey[2]);
        for (int k = 0; k < 7; k++)
            if (field_find(m->row->fields, NAME[k]) != NULL)
                set(m, NAME[k], b.grey[3 + k]);
        struct bsdf bsdf = make(&b, &m, 0);
        double R = 0, T = 0, R_wanted = 0, T_wanted = 0; /* sums of squares: lobes may be in any order */
        for (int k = 0; k < bsdf.n_lobes; k++) {
            R += sqr(bsdf.lobe[k].R.g * bsdf.lobe[k].scale.g);
            T += sqr(bsdf.lobe[k].T.g * bsdf.lobe[k].scale.g);
        }
        for (int k = 0; k < 5; k++) {
            R_wanted += sqr(cases[i].R[k]);
            T_wanted += sqr(cases[i].T[k]);
        }
        CHECK(t, bsdf.n_lobes == cases[i].n && fabs(R - R_wanted) < 1e-12 && fabs(T - T_wanted) < 1e-12,
              "%s: colours of %d lobes have squares of %g and %g, not %g and %g", cases[i].name, bsdf.n_lobes, R, T,
              R_wanted, T_wanted);
        free(m);
    }
    tear_down(&b);
}

static struct material *mix_of(int first, int second, int amount)
{
    struct material *m = all_same(row_of("mix"), amount);
    set(m, "namedmaterial1", first);
    set(m, "namedmaterial2", second);
    return m;
}

/* The value of a mix is the mix of the values, however deep. */
static void mixing(struct test *t)
{
    struct bench b;
    set_up(&b);
    enum { MATTE, PLASTIC, SUBSTRATE, INNER, OUTER, ONLY_FIRST, N };
    struct material *m[N] = {all_same(row_of("matte"), b.grey[6]),     all_same(row_of("plastic"), b.grey[4]),
                             all_same(row_of("substrate"), b.grey[3]), mix_of(PLASTIC, SUBSTRATE, b.grey[2]),
                             mix_of(MATTE, INNER, b.grey[7]),          mix_of(MATTE, PLASTIC, b.grey[10])};
    vec3 wo = normalize(vec(0.3, 0.2, 0.9)), wi = normalize(vec(-0.5, 0.1, 0.6));
    double f[N];
    for (int i = 0; i < N; i++) {
        struct bsdf bsdf = make(&b, m, i);
        f[i] = bsdf_eval(&bsdf, wo, wi, RADIANCE).f.g;
    }
    double inner = 0.2 * f[PLASTIC] + 0.8 * f[SUBSTRATE], outer = 0.7 * f[MATTE] + 0.3 * inner;
    CHECK(t, f[PLASTIC] > 0 && f[SUBSTRATE] > 0, "something to mix");
    CHECK(t, fabs(f[INNER] / inner - 1) < 1e-12, "mix: %g, should be %g", f[INNER], inner);
    CHECK(t, fabs(f[OUTER] / outer - 1) < 1e-12, "mix in a mix: %g, should be %g", f[OUTER], outer);
    struct bsdf first = make(&b, m, ONLY_FIRST);
    CHECK(t, first.n_lobes == 1 && f[ONLY_FIRST] == f[MATTE], "a share of 0 drops the lobes");
    free_all(m, N);
    tear_down(&b);
}

/* Of mixes of mixes all lobes are counted, and there is room for them. */
static void too_many(struct test *t)
{
    struct bench b;
    set_up(&b);
    struct material *tower[6];
    for (int i = 0; i < 6; i++) {
        tower[i] = i == 0 ? all_same(row_of("uber"), b.grey[5]) : mix_of(i - 1, i - 1, b.grey[5]);
        struct bsdf bsdf = make(&b, tower, i);
        CHECK(t, tower[i]->most_lobes == 5 << i && bsdf.n_lobes == 5 << i, "%d mixes: %d of %d lobes", i, bsdf.n_lobes,
              tower[i]->most_lobes);
    }
    free_all(tower, 6);
    tear_down(&b);
}

/* A ramp d = 0.6 u + 0.4 v on a plane has a normal that school geometry gives. */
static void bump(struct test *t)
{
    struct bench b;
    set_up(&b);
    struct texture ramp = {.kind = TEXTURE_BILERP, .v01 = rgb_grey(0.4), .v10 = rgb_grey(0.6), .v11 = rgb_grey(1)};
    ramp.map.su = ramp.map.sv = 1;
    int id = texture_add(&b.textures, ramp);
    vec3 tilted = normalize(cross(vec(2, 0, 0.6), vec(0, 1, 0.4)));
    struct material *m[3] = {all_same(row_of("matte"), b.grey[5]), all_same(row_of("matte"), b.grey[5]),
                             mix_of(0, 1, b.grey[5])};
    m[0]->bump = id;
    struct bsdf bsdf = make(&b, m, 0);
    CHECK(t, length(sub(bsdf.shading.n, tilted)) < 1e-9, "normal of a ramp");
    CHECK(t, length(sub(bsdf.shading.s, normalize(vec(2, 0, 0.6)))) < 1e-9, "tangent of a ramp");
    CHECK(t, bsdf.ng.z == 1, "the geometric normal stays");
    b.at.ng = vec(0, 0, -1);
    CHECK(t, length(add(bump_frame(&b.textures, id, &b.at).n, tilted)) < 1e-9,
          "on the side of the geometric normal");
    b.at.ng = vec(0, 0, 1);
    b.at.dndu = vec(1, 0, 0); /* a curved surface: the displacement stretches it by 1 + d/2 */
    double d = 0.6 * 0.25 + 0.4 * 0.25;
    vec3 curved = normalize(cross(vec(2 + d, 0, 0.6), vec(0, 1, 0.4)));
    CHECK(t, length(sub(bump_frame(&b.textures, id, &b.at).n, curved)) < 1e-9, "ramp on a curved surface");
    b.at.dpdu = b.at.dpdv = b.at.dndu = vec(0, 0, 0);
    CHECK(t, bump_frame(&b.textures, id, &b.at).n.z == 1, "no partials, no bump");
    b.at.dpdu = vec(2, 0, 0);
    b.at.dpdv = vec(0, 1, 0);
    bsdf = make(&b, m, 2);
    CHECK(t, length(sub(bsdf.shading.n, tilted)) < 1e-9, "a mix shades like its first material");
    free_all(m, 3);
    tear_down(&b);
}

/* --- walks -------------------------------------------------------------------------------------------- */

enum { WALKS = 20000 };

/* A walk that leaves a surface into the sky carries, on average, what uniform directions find that is scattered. */
static void check_walks(struct test *t, const char *material)
{
    struct scene scene;
    struct counts counts = {.s0 = {1, 1}, .tables = &NO_TABLES};
    struct arena arena = {0}, kept = {0};
    struct vertex path[3], first[3];
    struct rng r = stream_of(t, material, 0), s = stream_of(t, material, 1);
    if (!scene_from_format(t, &scene, "LookAt 3 0 2  0 0 0  0 0 1 Camera \"perspective\" WorldBegin\n"
                           "MakeNamedMaterial \"a\" \"string type\" \"matte\"\n"
                           "MakeNamedMaterial \"b\" \"string type\" \"metal\" \"float roughness\" .3\n"
                           "LightSource \"infinite\" Material %s Shape \"disk\" \"float radius\" 5 WorldEnd", material))
        return;
    struct batches walked = batches_new(WALKS, 1, false), uniform = batches_new(WALKS, 1, false);
    for (int i = 0; i < WALKS; i++) {
        struct sampler sampler = sampler_start(rng_u32(&s), RNG_EYE, (uint64_t)i, 0);
        struct walk w = {&scene, &counts, i == 0 ? &kept : &arena, &sampler, 0};
        struct vertex *v = i == 0 ? first : path;
        arena_reset(&arena);
        int n = path_eye(&w, scene.width / 2.0, scene.height / 2.0, v, 3);
        walked.value[i] = n == 3 ? rgb_luminance(v[2].beta) : 0;
        vec3 wi = warp_sphere(rng_uniform(&r), rng_uniform(&r));
        rgb f = bsdf_eval(&first[1].bsdf, first[1].wo, wi, RADIANCE).f;
        uniform.value[i] = rgb_luminance(f) * scatter_cosine(&first[1], wi, RADIANCE) * 4 * PI;
    }
    TEST_ACCEPT(t, batches_smallest_p(&walked, &uniform), "%s: walks carry %.4f, uniform directions %.4f", material,
                batches_mean(&walked, NULL), batches_mean(&uniform, NULL));
    batches_free(&walked);
    batches_free(&uniform);
    arena_free(&arena);
    arena_free(&kept);
    scene_free(&scene);
}

/* Every row of materials has a specimen here, in which nothing is a mirror; so `mirror` has none. */
static void walks(struct test *t)
{
    static const char *const MATERIALS[] = {
        "\"matte\"", "\"matte\" \"float sigma\" 40", "\"substrate\" \"float uroughness\" .3 \"float vroughness\" .2",
        "\"plastic\" \"float roughness\" .3", "\"metal\" \"float roughness\" .3",
        "\"translucent\" \"float roughness\" .4", "\"uber\" \"float roughness\" .3 \"rgb opacity\" [1 1 1]",
        "\"disney\" \"float metallic\" .4 \"float sheen\" .5 \"float clearcoat\" 1 \"float clearcoatgloss\" .1",
        "\"disney\" \"bool thin\" \"true\" \"float spectrans\" .5 \"float flatness\" .5",
        "\"glass\" \"float uroughness\" .4 \"float vroughness\" .3",
        "\"subsurface\" \"float uroughness\" .4 \"float vroughness\" .3",
        "\"kdsubsurface\" \"float uroughness\" .4 \"float vroughness\" .3",
        "\"mix\" \"string namedmaterial1\" \"a\" \"string namedmaterial2\" \"b\"",
        "\"fourier\" \"string bsdffile\" \"%sscenes/features/layered.bsdf\""};
    int missing = 0;
    for (const struct material_row *const *row = material_rows; *row != NULL; row++) {
        bool found = strcmp((*row)->name, "mirror") == 0;
        for (size_t i = 0; i < sizeof MATERIALS / sizeof MATERIALS[0]; i++) {
            char name[64], top[512], text[1024];
            snprintf(name, sizeof name, "\"%s\"", (*row)->name);
            if (strncmp(MATERIALS[i], name, strlen(name)) != 0)
                continue;
            snprintf(text, sizeof text, MATERIALS[i], top_directory(top, sizeof top));
            check_walks(t, text);
            found = true;
        }
        missing += !found;
    }
    CHECK(t, missing == 0, "%d materials have no specimen", missing);
}

void test_material(struct test *t)
{
    walks(t);
    lobes_of_materials(t);
    roughness(t);
    colours(t);
    disney(t);
    mixing(t);
    too_many(t);
    bump(t);
}
