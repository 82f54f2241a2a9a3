/* test_bsdf.c: bsdf_sample draws directions with the density and the values that bsdf_eval states.
 *
 * For every kind of lobe and some sums of lobes, from both sides, steep and grazing, with the geometric and the
 * shading normal together and apart:
 *   - chi-square of the drawn directions against the pdf integrated over a grid on the sphere, the absorbed samples
 *     being one more cell, so that the missing part of the integral is tested as well;
 *   - a sample's numbers equal bsdf_eval's; pdf_rev is the pdf of the swapped pair; radiance and importance are
 *     adjoint;
 *   - no more energy comes out than goes in.
 * The companions that must be rejected: a dropped or doubled cosine, exchanged roughnesses, a wrong index, wrong
 * lobe choice, lost samples not accounted for, a medium's asymmetry that is another's, a cosine in a medium.
 */
#include "material/bsdf.h"

#include <math.h>
#include <string.h>

#include "base/rng.h"
#include "lab/stats.h"
#include "material/burley.h"
#include "material/fourier.h"
#include "helpers.h"
#include "suites.h"

enum {
    ROWS = 20,
    COLUMNS = 32,
    CELLS = ROWS * COLUMNS,
    FINE_Z = 40,
    COARSE_Z = 10,
    FINE_PHI = 5,
    SAMPLES = 30000,
    MAX_LOBES = 4
};

/* --- what is tested ---------------------------------------------------------------------------------- */

static struct lobe lobe(enum lobe_kind kind, double R, double T)
{
    struct lobe l = {.kind = kind, .scale = rgb_grey(1), .R = rgb_grey(R), .T = rgb_grey(T)};
    if (kind == LOBE_OREN_NAYAR) {
        l.of.oren_nayar.A = 0.85;
        l.of.oren_nayar.B = 0.25;
    }
    l.alpha_x = l.alpha_y = 0.3;
    return l;
}

static struct lobe rough_glass(enum lobe_kind kind, double alpha_x, double alpha_y, double eta)
{
    struct lobe l = lobe(kind, kind == LOBE_MICROFACET_REFLECTION, kind == LOBE_MICROFACET_TRANSMISSION);
    l.fresnel = FRESNEL_DIELECTRIC;
    l.alpha_x = alpha_x;
    l.alpha_y = alpha_y;
    l.eta_a = 1;
    l.eta_b = eta;
    return l;
}

static struct lobe copper(double alpha_x, double alpha_y)
{
    struct lobe l = rough_glass(LOBE_MICROFACET_REFLECTION, alpha_x, alpha_y, 1);
    l.fresnel = FRESNEL_CONDUCTOR;
    l.of.conductor.eta = rgb_make(0.2, 0.92, 1.1);
    l.of.conductor.k = rgb_make(3.9, 2.45, 2.14);
    return l;
}

static struct lobe dimmed(struct lobe l)
{
    l.scale = rgb_grey(0.4);
    return l;
}

struct specimen {
    const char *name;
    int n;
    struct lobe lobe[MAX_LOBES];
};

struct specimens {
    int n;
    struct specimen of[40];
};

/* Every kind of lobe that is not delta has one, which test/tree/specimens.sh checks. */
static struct specimens specimens(const struct fourier_table *table)
{
    struct lobe diffuse = lobe(LOBE_LAMBERT_REFLECTION, 0.5, 0), through = lobe(LOBE_LAMBERT_TRANSMISSION, 0, 0.4);
    struct lobe mirror = lobe(LOBE_SPECULAR_REFLECTION, 0.3, 0);
    struct lobe reflect = rough_glass(LOBE_MICROFACET_REFLECTION, 0.3, 0.3, 1.5);
    struct lobe refract = rough_glass(LOBE_MICROFACET_TRANSMISSION, 0.3, 0.3, 1.5);
    struct lobe coat = rough_glass(LOBE_MICROFACET_REFLECTION, 0.2, 0.2, 1 / 1.5), faint = reflect, weak = refract;
    coat.R = rgb_grey(0.4);
    faint.R = weak.T = rgb_grey(0.1);
    weak.scale = rgb_make(0.5, 0.7, 0.9);
    struct lobe disney = lobe(LOBE_FORM, 0.5, 0), metal = copper(0.4, 0.2), glass = refract;
    struct lobe gloss = lobe(LOBE_FORM, 1, 0);
    disney.form = &form_disney;
    gloss.form = &form_coat;
    disney.of.disney.flat = rgb_grey(0.2);
    disney.of.disney.retro = rgb_grey(0.5);
    disney.of.disney.sheen = rgb_make(0.1, 0.2, 0);
    disney.of.disney.roughness = 0.85;
    metal.fresnel = FRESNEL_DISNEY;
    metal.of.tinted.normal = rgb_make(0.9, 0.5, 0.2);
    metal.of.tinted.metallic = 0.6;
    metal.eta_b = 1.5;
    gloss.of.gloss = 0.1;
    metal.separate = glass.separate = true;
    struct lobe coated = lobe(LOBE_FRESNEL_BLEND, 0.5, 0);
    coated.of.coat = rgb_grey(0.4);
    struct lobe layered = lobe(LOBE_FORM, 1, 0);
    layered.form = &form_fourier;
    layered.of.table = table;
    struct lobe forward = lobe(LOBE_PHASE, 1, 0), backward = forward;
    forward.of.g = 0.6;
    backward.of.g = -0.3;
    const struct specimen all[] = {
        {"lambert", 1, {diffuse}},
        {"lambert transmission", 1, {through}},
        {"oren-nayar", 1, {lobe(LOBE_OREN_NAYAR, 0.8, 0)}},
        {"copper", 1, {copper(0.25, 0.25)}},
        {"brushed copper", 1, {copper(0.5, 0.15)}},
        {"rough dielectric, reflection", 1, {reflect}},
        {"rough dielectric, transmission", 1, {refract}},
        {"brushed dielectric, transmission", 1, {rough_glass(LOBE_MICROFACET_TRANSMISSION, 0.5, 0.2, 1.3)}},
        {"substrate", 1, {coated}},
        {"rough glass", 2, {reflect, refract}},
        {"plastic", 2, {diffuse, coat}},
        {"translucent", 4, {diffuse, through, faint, weak}},
        {"half a mirror", 2, {diffuse, mirror}},
        {"disney's diffuse part", 1, {disney}},
        {"disney's facets", 1, {metal}},
        {"disney's glass", 1, {glass}},
        {"clear coat", 1, {gloss}},
        {"fourier", 1, {layered}},
        {"disney", 4, {dimmed(disney), dimmed(metal), gloss, dimmed(glass)}},
        {"medium, forward", 1, {forward}},
        {"medium, backward", 1, {backward}},
    };
    struct specimens out = {.n = sizeof all / sizeof all[0]};
    memcpy(out.of, all, sizeof all);
    return out;
}

static struct specimen named(const struct specimens *s, const char *name)
{
    const struct specimen *one = s->of;
    while (strcmp(one->name, name) != 0)
        one++;
    return *one;
}

/* A BSDF of the specimen with a slanted shading frame; the geometric normal is tilted from it by `tilt` radians. */
static struct bsdf mount(struct specimen *s, double tilt)
{
    vec3 ns = normalize(vec(0.3, -0.5, 0.7));
    struct frame f = frame_from_tangent(ns, vec(1, 0.2, 0));
    struct bsdf b;
    bsdf_make(&b, s->lobe, s->n);
    b.shading = f;
    b.ng = to_world(&f, vec(sin(tilt) * 0.6, sin(tilt) * 0.8, cos(tilt)));
    return b;
}

static vec3 direction(double cos_theta, double phi)
{
    double s = safe_sqrt(1 - cos_theta * cos_theta);
    return vec(s * cos(phi), s * sin(phi), cos_theta);
}

/* --- counting and integrating ------------------------------------------------------------------------ */

/* Cells of equal solid angle in the shading frame, and one more for samples that are absorbed or delta. */
struct histogram {
    double cell[CELLS + 1];
};

static int cell_of(const struct bsdf *b, vec3 w)
{
    vec3 l = to_local(&b->shading, w);
    int row = (int)((l.z + 1) / 2 * ROWS), column = (int)((atan2(l.y, l.x) / (2 * PI) + 0.5) * COLUMNS);
    row = row < 0 ? 0 : row >= ROWS ? ROWS - 1 : row;
    column = column < 0 ? 0 : column >= COLUMNS ? COLUMNS - 1 : column;
    return row * COLUMNS + column;
}

static void count_samples(const struct bsdf *b, vec3 wo, enum transport mode, struct rng *r, struct histogram *h,
                          int *inconsistent)
{
    memset(h, 0, sizeof *h);
    for (int i = 0; i < SAMPLES; i++) {
        double u[3] = {rng_uniform(r), rng_uniform(r), rng_uniform(r)};
        struct bsdf_sample s;
        if (!bsdf_sample(b, wo, u, mode, &s) || s.delta) {
            h->cell[CELLS]++;
            continue;
        }
        h->cell[cell_of(b, s.wi)]++;
        struct bsdf_value v = bsdf_eval(b, wo, s.wi, mode);
        bool same = v.pdf == s.pdf && v.pdf_rev == s.pdf_rev && v.f.r == s.f.r && v.f.b == s.f.b;
        *inconsistent += !same || !(s.pdf > 0) || !rgb_is_finite(s.f) || fabs(length(s.wi) - 1) > 1e-12;
    }
}

/* What a density may be falsified into. */
enum fault { HONEST, TIMES_COS, PER_COS, NOTHING_LOST };

struct integral {
    struct histogram expected;
    double pdf;    /* integral of pdf over the sphere */
    double energy; /* integral of f |cos| (brightest channel) */
};

/* Rough refraction ends abruptly where facets stand upright, along a parallel of the sphere: hence its finer steps
 * in z. */
static int steps_in_z(const struct bsdf *b)
{
    bool abrupt = false;
    for (int i = 0; i < b->n_lobes; i++)
        abrupt = abrupt || b->lobe[i].kind == LOBE_MICROFACET_TRANSMISSION;
    return abrupt ? FINE_Z : COARSE_Z;
}

static void integrate(const struct bsdf *b, vec3 wo, enum transport mode, enum fault fault, struct integral *out)
{
    memset(out, 0, sizeof *out);
    const int fine_z = steps_in_z(b);
    const double solid_angle = 4 * PI / CELLS / (fine_z * FINE_PHI);
    for (int y = 0; y < ROWS * fine_z; y++)
        for (int x = 0; x < COLUMNS * FINE_PHI; x++) {
            vec3 l =
                direction((y + 0.5) / (ROWS * fine_z) * 2 - 1, ((x + 0.5) / (COLUMNS * FINE_PHI) - 0.5) * 2 * PI);
            struct bsdf_value v = bsdf_eval(b, wo, to_world(&b->shading, l), mode);
            double pdf = v.pdf * solid_angle;
            if (fault == TIMES_COS)
                pdf *= 1.5 * fabs(l.z);
            if (fault == PER_COS)
                pdf *= 0.5 / fabs(l.z);
            out->expected.cell[y / fine_z * COLUMNS + x / FINE_PHI] += SAMPLES * pdf;
            out->pdf += pdf;
            out->energy += rgb_max(v.f) * fabs(l.z) * solid_angle;
        }
    out->expected.cell[CELLS] = SAMPLES * (1 - out->pdf);
    for (int i = 0; i <= CELLS; i++) {
        if (fault == NOTHING_LOST)
            out->expected.cell[i] = i < CELLS ? out->expected.cell[i] / out->pdf : 0;
        /* A cell of which the density covers but a corner may be missed by all steps: nowhere is quite impossible.
         */
        out->expected.cell[i] = fmax(out->expected.cell[i], 0.01);
    }
}

/* p-value of samples of `drawn` against the density of `claimed`; *in: its integral, *inconsistent: samples whose
 * numbers are not bsdf_eval's. */
static double chi2_p(const struct bsdf *drawn, const struct bsdf *claimed, vec3 wo, enum transport mode,
                     enum fault fault, struct rng *r, struct integral *in, int *inconsistent)
{
    struct histogram h;
    *inconsistent = 0;
    count_samples(drawn, wo, mode, r, &h, inconsistent);
    integrate(claimed, wo, mode, fault, in);
    return stats_chi2_test(h.cell, in->expected.cell, CELLS + 1);
}

static void samples_follow_pdf(struct test *t, struct specimen *one)
{
    static const double COS[] = {0.95, 0.5, 0.15, -0.7, -0.2}, TILT[] = {0, 0.35};
    struct rng r = stream_of(t, one->name, 0);
    for (int n = 0; n < 10; n++) {
        int c = n / 2, k = n % 2, inconsistent;
        enum transport mode = (c + k) % 2 ? IMPORTANCE : RADIANCE;
        struct bsdf b = mount(one, TILT[k]);
        vec3 wo = to_world(&b.shading, direction(COS[c], 0.9));
        struct integral in;
        double p = chi2_p(&b, &b, wo, mode, HONEST, &r, &in, &inconsistent);
        TEST_ACCEPT(t, p, "%s, cos %g, tilt %g: chi-square", one->name, COS[c], TILT[k]);
        CHECK(t, inconsistent == 0, "%s, cos %g: %d samples differ from bsdf_eval", one->name, COS[c], inconsistent);
        CHECK(t, in.pdf < 1.003 && (mode == RADIANCE || in.energy < 1.003),
              "%s, cos %g, tilt %g: pdf integrates to %g, albedo %g", one->name, COS[c], TILT[k], in.pdf, in.energy);
        if (one->n == 1 && one->lobe[0].kind == LOBE_LAMBERT_REFLECTION)
            CHECK(t, fabs(in.energy - 0.5) < 2e-3, "lambert keeps its albedo whatever the normals: %g", in.energy);
    }
}

/* A hypothesis that must be rejected. */
static void reject(struct test *t, const struct bsdf *drawn, const struct bsdf *claimed, double cosine,
                   enum fault fault, const char *what)
{
    struct rng r = stream_of(t, what, 1);
    struct integral in;
    int inconsistent;
    vec3 wo = to_world(&drawn->shading, direction(cosine, 0.9));
    TEST_REJECT(t, chi2_p(drawn, claimed, wo, RADIANCE, fault, &r, &in, &inconsistent), "%s", what);
}

static void planted_faults(struct test *t, const struct specimens *s)
{
    struct specimen diffuse = named(s, "lambert"), copper = named(s, "brushed copper"), rough = named(s, "rough glass"),
                    fog = named(s, "medium, forward"), smoke = named(s, "medium, backward"), other = copper;
    struct bsdf lambert = mount(&diffuse, 0), brushed = mount(&copper, 0), glass = mount(&rough, 0);
    reject(t, &lambert, &lambert, 0.5, TIMES_COS, "lambert, one cosine too many");
    reject(t, &lambert, &lambert, 0.5, PER_COS, "lambert, a cosine missing");
    reject(t, &brushed, &brushed, 0.5, TIMES_COS, "brushed copper, one cosine too many");
    reject(t, &glass, &glass, -0.2, NOTHING_LOST, "rough glass, absorbed samples not accounted for");
    other.lobe[0].alpha_x = copper.lobe[0].alpha_y;
    other.lobe[0].alpha_y = copper.lobe[0].alpha_x;
    struct bsdf claimed = mount(&other, 0);
    reject(t, &brushed, &claimed, 0.5, HONEST, "brushed copper, roughnesses exchanged");
    other = rough;
    other.lobe[1].eta_b = 1.4;
    claimed = mount(&other, 0);
    reject(t, &glass, &claimed, 0.5, HONEST, "rough glass, wrong index");
    other = rough;
    claimed = mount(&other, 0);
    other.lobe[0].choice += 0.05;
    other.lobe[1].choice -= 0.05;
    reject(t, &glass, &claimed, 0.5, HONEST, "rough glass, wrong lobe choice");
    claimed = mount(&diffuse, 0.35);
    reject(t, &lambert, &claimed, 0.5, HONEST, "lambert, wrong geometric normal");
    struct bsdf forward = mount(&fog, 0), backward = mount(&smoke, 0);
    static const struct {
        double g;
        const char *what;
    } WRONG[] = {{-0.6, "medium, forward, said to be backward"}, {0.55, "medium, forward, said to be less so"},
                 {0, "medium, forward, said to be even"}};
    for (int i = 0; i < 3; i++) {
        other = fog;
        other.lobe[0].of.g = WRONG[i].g;
        claimed = mount(&other, 0);
        reject(t, &forward, &claimed, 0.5, HONEST, WRONG[i].what);
    }
    reject(t, &forward, &forward, 0.5, TIMES_COS, "medium, forward, a cosine, as of a plane");
    reject(t, &backward, &forward, 0.5, HONEST, "medium, backward, a density that is forward");
}

/* --- pairs of directions ----------------------------------------------------------------------------- */

/* Equal but for rounding. The absolute term is for half vectors nearly orthogonal to a direction, where values around
 * 1e-11 keep five digits only. */
static bool agree(double a, double b) { return fabs(a - b) <= 1e-6 * (fabs(a) + fabs(b)) + 1e-15; }

/* Random pairs, most of them with a value: half of them are drawn by the BSDF. */
static void swapped_pairs(struct test *t, struct specimen *one)
{
    struct rng stream = stream_of(t, one->name, 2), *r = &stream;
    int bad_pdf = 0, bad_f = 0, bad_eta = 0, black_pdf = 0, met = 0;
    for (int k = 0; k < 3000; k++) {
        struct bsdf b = mount(one, k % 3 == 0 ? 0.35 : 0);
        vec3 wo = direction(2 * rng_uniform(r) - 1, 7 * rng_uniform(r)),
             wi = direction(2 * rng_uniform(r) - 1, 0.3);
        double u[3] = {rng_uniform(r), rng_uniform(r), rng_uniform(r)};
        struct bsdf_sample sample;
        if (k % 2 == 0 && bsdf_sample(&b, wo, u, RADIANCE, &sample) && !sample.delta)
            wi = sample.wi;
        struct bsdf_value there = bsdf_eval(&b, wo, wi, RADIANCE), back = bsdf_eval(&b, wi, wo, RADIANCE);
        struct bsdf_value there_i = bsdf_eval(&b, wo, wi, IMPORTANCE),
                          back_i = bsdf_eval(&b, wi, wo, IMPORTANCE);
        met += !rgb_is_black(there.f);
        bad_pdf += !agree(there.pdf, back.pdf_rev) || !agree(there.pdf_rev, back.pdf) ||
                   !agree(there.pdf, there_i.pdf);
        bad_f += !agree(there.f.r, back_i.f.r) || !agree(there_i.f.b, back.f.b);
        bool reflected = dot(wo, b.ng) * dot(wi, b.ng) > 0;
        if (one->lobe[0].form == &form_fourier)
            continue; /* symmetric as its table is: test_fourier.c */
        if (reflected || one->lobe[0].kind == LOBE_LAMBERT_TRANSMISSION)
            bad_eta += !agree(there.f.g, back.f.g) || !agree(there.f.g, there_i.f.g);
        else if (one->lobe[0].kind == LOBE_MICROFACET_TRANSMISSION && there.f.g > 0) {
            double eta = one->lobe[0].eta_b / one->lobe[0].eta_a;
            eta = dot(wo, b.shading.n) > 0 ? eta : 1 / eta;
            bad_eta += !agree(there_i.f.g, there.f.g * eta * eta);
        }
        black_pdf += rgb_is_black(there.f) && (there.pdf != 0 || there.pdf_rev != 0);
    }
    CHECK(t, met > 500, "%s: only %d pairs are not black", one->name, met);
    CHECK(t, bad_pdf == 0, "%s: %d pairs whose pdf_rev is not the swapped pair's pdf", one->name, bad_pdf);
    CHECK(t, bad_f == 0, "%s: %d pairs where radiance and importance are not adjoint", one->name, bad_f);
    CHECK(t, bad_eta == 0, "%s: %d pairs not symmetric up to eta^2", one->name, bad_eta);
    CHECK(t, black_pdf == 0, "%s: %d black pairs with a density", one->name, black_pdf);
}

/* --- delta lobes among others ------------------------------------------------------------------------ */

/* Lobe choice of an uber-like material: each delta direction is drawn as often as its pdf says, and f |cos| / pdf
 * averages to the lobes' shares. */
static void choice_among_lobes(struct test *t)
{
    enum { N = 20000 };
    struct specimen s = {"uber",
                         4,
                         {lobe(LOBE_LAMBERT_REFLECTION, 0.3, 0), lobe(LOBE_SPECULAR_REFLECTION, 0.2, 0),
                          lobe(LOBE_SPECULAR_TRANSMISSION, 0, 0.4), lobe(LOBE_FRESNEL_SPECULAR, 0.1, 0.1)}};
    s.lobe[1].fresnel = FRESNEL_NONE;
    s.lobe[2].eta_a = s.lobe[2].eta_b = s.lobe[3].eta_a = 1;
    s.lobe[3].eta_b = 1.5;
    struct bsdf b = mount(&s, 0);
    CHECK(t, b.n_smooth == 1, "one lobe of four is smooth");
    double sum = 0;
    for (int i = 0; i < 4; i++) {
        sum += s.lobe[i].choice;
        CHECK(t, s.lobe[i].choice > 0.03, "lobe %d is chosen with %g", i, s.lobe[i].choice);
    }
    CHECK(t, fabs(sum - 1) < 1e-12, "choices sum to %g", sum);
    vec3 wo = to_world(&b.shading, direction(0.6, 1));
    double mass = 0, energy = 0, last = 0;
    for (int i = 0; i < N; i++) {
        double u[3] = {(i + 0.5) / N, 0.4, 0.6};
        struct bsdf_sample d;
        if (!CHECK(t, bsdf_sample(&b, wo, u, IMPORTANCE, &d), "nothing is absorbed"))
            continue;
        if (d.delta) {
            energy += d.f.g * abs_dot(d.wi, b.shading.n) / d.pdf / N;
            mass += fabs(d.pdf - last) > 1e-12 ? d.pdf : 0; /* each branch once, they follow each other in u */
            last = d.pdf;
        }
    }
    CHECK(t, fabs(mass + s.lobe[0].choice - 1) < 1e-9, "probabilities of all branches sum to %g",
          mass + s.lobe[0].choice);
    CHECK(t, fabs(energy - (0.2 + 0.4 + 0.1)) < 1e-3, "delta lobes send on %g", energy);
    CHECK(t, bsdf_eval(&b, wo, to_world(&b.shading, direction(0.6, 1 + PI)), RADIANCE).f.g == 0.3 * INV_PI,
          "bsdf_eval leaves delta lobes out");
}

void test_bsdf(struct test *t)
{
    struct fourier_table table;
    struct error err = {.text = ""};
    if (!CHECK(t, fourier_read("scenes/features/layered.bsdf", &table, &err), "%s", err.text))
        return;
    struct specimens all = specimens(&table);
    for (int i = 0; i < all.n; i++) {
        samples_follow_pdf(t, &all.of[i]);
        swapped_pairs(t, &all.of[i]);
    }
    planted_faults(t, &all);
    choice_among_lobes(t);
    fourier_free(&table);
}
