/* test_lobe.c: the parts of a BSDF: Fresnel's equations, the facet distribution, delta lobes. Everything here is exact
 * or a quadrature; the statistics are in test_bsdf.c. */
#include "material/lobe.h"

#include <math.h>

#include "material/bsdf.h"
#include "material/burley.h"
#include "material/microfacet.h"
#include "base/number.h"
#include "base/rng.h"
#include "suites.h"

static bool near(double a, double b, double tolerance) { return fabs(a - b) <= tolerance; }

static vec3 direction(double cos_theta, double phi)
{
    double s = safe_sqrt(1 - cos_theta * cos_theta);
    return vec(s * cos(phi), s * sin(phi), cos_theta);
}

/* --- Fresnel ----------------------------------------------------------------------------------------- */

static void fresnel_values(struct test *t)
{
    const double critical = sqrt(1 - sqr(1 / 1.5)), perpendicular = (1 - 2.25) / (1 + 2.25);
    const struct {
        double cos_i, eta_b, want, tolerance;
    } cases[] = {
        {1, 1.5, 0.04, 1e-15}, {-1, 1.5, 0.04, 1e-15}, /* normal incidence, from both sides */
        {1e-9, 1.5, 1, 1e-7},                          /* grazing */
        {0.3, 1, 0, 1e-15},                            /* no boundary */
        {-critical + 1e-9, 1.5, 1, 0}, {-critical - 1e-3, 1.5, 0.8, 0.1}, /* total reflection, and just not */
        {1 / sqrt(1 + 2.25), 1.5, 0.5 * sqr(perpendicular), 1e-15}, /* Brewster's angle: no parallel part */
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        double F = fresnel_dielectric(cases[i].cos_i, 1, cases[i].eta_b);
        CHECK(t, near(F, cases[i].want, cases[i].tolerance), "cos %g: %g, not %g", cases[i].cos_i, F, cases[i].want);
    }
    for (double c = 0.02; c < 1; c += 0.07) {
        double F = fresnel_dielectric(c, 1, 1.5), cos_t = sqrt(1 - (1 - c * c) / 2.25);
        CHECK(t, near(F, fresnel_dielectric(-cos_t, 1, 1.5), 1e-14), "the same from both sides");
        CHECK(t, near(fresnel_conductor(c, rgb_grey(1.5), rgb_black()).g, F, 1e-13), "metal that absorbs nothing");
    }
    /* Copper: ((n-1)^2 + k^2) / ((n+1)^2 + k^2) at normal incidence. */
    rgb n = rgb_make(0.200438, 0.924033, 1.102212), k = rgb_make(3.912949, 2.452848, 2.142188);
    rgb copper = fresnel_conductor(1, n, k);
    CHECK(t, near(copper.r, (sqr(n.r - 1) + sqr(k.r)) / (sqr(n.r + 1) + sqr(k.r)), 1e-14), "red: %g", copper.r);
    CHECK(t, near(copper.r, 0.952, 1e-3) && near(copper.g, 0.620, 1e-3) && near(copper.b, 0.511, 1e-3),
          "copper: %.6f %.6f %.6f", copper.r, copper.g, copper.b);
    CHECK(t, near(fresnel_conductor(0, n, k).r, 1, 1e-12), "copper, grazing");
    /* From 0 to 1 for any index, even one that is no boundary, at any angle. */
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 31, 0);
    for (int i = 0; i < 100000; i++) {
        double c = i % 5 == 0 ? 0 : pow(rng_uniform(&r), 1 + i % 9);
        double eta = i % 3 == 0 ? 1 : exp(8 * rng_uniform(&r) - 4), absorbed = i % 2 == 0 ? 0 : exp(8 * rng_uniform(&r) - 6);
        double F = fresnel_conductor(c, rgb_grey(eta), rgb_grey(absorbed)).r;
        CHECK(t, F >= 0 && F <= 1 + 1e-12, "eta %g, k %g reflect %g at cosine %g", eta, absorbed, F, c);
    }
}

/* --- sampling maps: density = 1 / |Jacobian| --------------------------------------------------------- */

static struct lobe facet_lobe(enum lobe_kind kind, double alpha_x, double alpha_y)
{
    struct lobe l = {.kind = kind, .fresnel = FRESNEL_DIELECTRIC, .eta_a = 1, .eta_b = 1.5};
    l.scale = l.R = l.T = rgb_grey(1);
    l.alpha_x = alpha_x;
    l.alpha_y = alpha_y;
    return l;
}

static struct lobe coat_lobe(double gloss)
{
    struct lobe l = facet_lobe(LOBE_FORM, 0, 0);
    l.form = &form_coat;
    l.of.gloss = gloss;
    return l;
}

/* The area on the sphere that a small square around (u1,u2) is mapped to, per area of the square. Negative if some
 * corner is absorbed. */
static double stretch(const struct lobe *l, vec3 wo, double u1, double u2)
{
    const double h = 1e-5;
    vec3 ng = vec(0, 0, 1), corner[4];
    static const double DU[4][2] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
    for (int i = 0; i < 4; i++) {
        double u[3] = {0.3, u1 + h * DU[i][0], u2 + h * DU[i][1]};
        if (!lobe_sample(l, wo, ng, u, &corner[i]))
            return -1;
    }
    return length(cross(sub(corner[1], corner[0]), sub(corner[3], corner[2]))) / (4 * h * h);
}

/* The largest relative difference between `claimed`'s pdf and the map of `sampled`; unlike a chi-square test this
 * works for the narrowest lobes. */
static double jacobian_error(const struct lobe *sampled, const struct lobe *claimed, vec3 wo)
{
    double worst = 0;
    for (int i = 1; i < 12; i++)
        for (int j = 1; j < 12; j++) {
            double u[3] = {0.3, i / 12.0 + 0.003, j / 12.0 + 0.003}, area = stretch(sampled, wo, u[1], u[2]);
            vec3 wi;
            if (area < 0 || !lobe_sample(sampled, wo, vec(0, 0, 1), u, &wi))
                continue;
            if ((wo.z * wi.z > 0) != (sampled->kind != LOBE_MICROFACET_TRANSMISSION))
                continue; /* through the facet but not through the surface: absorbed */
            double pdf = lobe_eval(claimed, wo, wi, wo.z * wi.z > 0, RADIANCE).pdf;
            worst = most_of(worst, fabs(pdf * area - 1));
        }
    return worst;
}

static void narrow_lobes(struct test *t)
{
    static const double ALPHA[][2] = {{0.001, 0.001}, {0.01, 0.03}, {0.2, 0.1}, {0.7, 0.7}};
    static const double COS[] = {0.999, 0.6, 0.1, -0.8, -0.2};
    static const enum lobe_kind KIND[] = {LOBE_MICROFACET_REFLECTION, LOBE_MICROFACET_TRANSMISSION};
    for (int k = 0; k < 2; k++)
        for (int a = 0; a < 4; a++)
            for (int c = 0; c < 5; c++) {
                struct lobe l = facet_lobe(KIND[k], ALPHA[a][0], ALPHA[a][1]);
                vec3 wo = direction(COS[c], 0.7);
                double e = jacobian_error(&l, &l, wo);
                CHECK(t, e < 1e-3, "kind %d, alpha %g %g, cos %g: pdf off by %g", k, ALPHA[a][0], ALPHA[a][1],
                      COS[c], e);
                CHECK(t, k == 1 || a > 0 || stretch(&l, wo, 0.4, 0.4) >= 0, "no sample is drawn, cos %g", COS[c]);
                CHECK(t, k == 1 || (stretch(&l, wo, 1 - 3e-5, 0.4) != 0 && stretch(&l, wo, 0.4, 1 - 3e-5) != 0),
                      "last numbers: all u above some number below 1 give one and the same direction");
                if (k == 1 && COS[c] == -0.2)
                    continue; /* (almost) everything is totally reflected */
                if (ALPHA[a][0] != ALPHA[a][1]) {
                    struct lobe swapped = facet_lobe(KIND[k], ALPHA[a][1], ALPHA[a][0]);
                    CHECK(t, jacobian_error(&l, &swapped, wo) > 0.1, "swapped alphas must show");
                }
                if (k == 1) {
                    struct lobe other = l;
                    other.eta_b = 1.45;
                    CHECK(t, jacobian_error(&l, &other, wo) > 0.01, "a wrong index must show");
                }
            }
}

/* The clear coat's facets: they project to the area of the surface, and are drawn with the claimed density. */
static void clear_coat(struct test *t)
{
    static const double ALPHA[] = {0.1, 0.03, 0.001}, COS[] = {0.999, 0.6, 0.1, -0.8};
    enum { STEPS = 20000 };
    for (int a = 0; a < 3; a++) {
        struct lobe l = coat_lobe(ALPHA[a]), other = l;
        double down = 0, last = 0;
        other.of.gloss *= 1.5;
        for (int i = 1; i <= STEPS; i++) { /* by tan(theta), as many steps in every decade */
            double tan_theta = pow(10, 12.0 * i / STEPS - 6), cos_theta = 1 / sqrt(1 + sqr(tan_theta));
            double middle = sqrt(last * tan_theta), c = 1 / sqrt(1 + sqr(middle));
            vec3 wh = direction(c, 1);
            down += 4 * lobe_eval(&l, wh, wh, true, RADIANCE).pdf * 2 * PI * (1 / sqrt(1 + sqr(last)) - cos_theta);
            last = tan_theta;
        }
        CHECK(t, near(down, 1, 1e-3), "coat of alpha %g: facets project to %g of the surface", ALPHA[a], down);
        for (int c = 0; c < 4; c++) {
            double e = jacobian_error(&l, &l, direction(COS[c], 0.7));
            CHECK(t, e < 2e-3, "coat of alpha %g, cos %g: pdf off by %g", ALPHA[a], COS[c], e);
            CHECK(t, jacobian_error(&l, &other, direction(COS[c], 0.7)) > 0.1, "another gloss must show");
        }
    }
}

/* Values of pbrt-v3's formulas, worked out by hand for wo and wi at 60 degrees from the normal, opposite each other. */
static void disney_values(struct test *t)
{
    struct lobe l = {.kind = LOBE_FORM, .form = &form_disney, .scale = rgb_grey(1), .of.disney.roughness = 0.5};
    vec3 wo = direction(0.5, 0.4), wi = direction(0.5, 0.4 + PI), up = vec(0, 0, 1);
    const double s = pow(0.5, 5), f = 1 - 0.875 * s; /* Schlick's weight; and what the flat look makes of it */
    const struct {
        double base, flat, retro, sheen, want;
    } cases[] = {{1, 0, 0, 0, INV_PI * sqr(1 - s / 2)},
                 {0, 1, 0, 0, INV_PI * 1.25 * (f * f * 0.5 + 0.5)},
                 {0, 0, 1, 0, INV_PI * 0.25 * (2 * s + s * s * -0.75)},
                 {0, 0, 0, 1, s}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        l.R = rgb_grey(cases[i].base);
        l.of.disney.flat = rgb_grey(cases[i].flat);
        l.of.disney.retro = rgb_grey(cases[i].retro);
        l.of.disney.sheen = rgb_grey(cases[i].sheen);
        double value = lobe_eval(&l, wo, wi, true, RADIANCE).f.g;
        CHECK(t, near(value, cases[i].want, 1e-12), "part %d: %g, not %g", (int)i, value, cases[i].want);
    }
    CHECK(t, near(fresnel_disney(1, 1, 1.5, rgb_grey(0.5), 0.5).g, 0.27, 1e-12), "half a metal, at normal incidence");
    CHECK(t, near(fresnel_disney(1e-9, 1, 1.5, rgb_grey(0.5), 0.5).g, 1, 1e-6), "half a metal, grazing");
    struct lobe coat = coat_lobe(0.1);
    double d = 0.99 / (-PI * log(0.01) * 0.01), g = 1 / (0.5 + sqrt(0.0625 + 0.9375 * 0.25));
    double want = d * (0.04 + 0.96 * s) * g * g / 4, value = lobe_eval(&coat, wo, wi, true, RADIANCE).f.g;
    CHECK(t, near(value, want, 1e-9), "coat: %g, not %g", value, want);
    struct lobe apart = facet_lobe(LOBE_MICROFACET_REFLECTION, 0.5, 0.5), together = apart;
    apart.separate = true;
    double lambda = microfacet_lambda(wo, 0.5, 0.5), ratio = lobe_eval(&apart, wo, wi, true, RADIANCE).f.g /
                                                             lobe_eval(&together, wo, wi, true, RADIANCE).f.g;
    CHECK(t, near(ratio, (1 + 2 * lambda) / sqr(1 + lambda), 1e-12), "masked one by one: %g", ratio);
    CHECK(t, rgb_is_black(lobe_eval(&coat, wo, up, false, RADIANCE).f), "nothing goes through a coat");
}

/* --- delta lobes ------------------------------------------------------------------------------------- */

/* Glass chooses by Fresnel's share. What a delta lobe says of the way back, and of importance, is in test_mis.c by the
 * oracle. */
static void glass(struct test *t)
{
    struct lobe l = facet_lobe(LOBE_FRESNEL_SPECULAR, 0, 0);
    struct bsdf_sample reflected, refracted;
    for (double c = -0.975; c < 1; c += 0.07) {
        vec3 wo = direction(c, 1);
        double F = fresnel_dielectric(c, 1, 1.5);
        CHECK(t, lobe_sample_delta(&l, wo, 0, IMPORTANCE, &reflected), "reflects");
        CHECK(t, near(reflected.pdf, F, 1e-12) && near(reflected.f.g * fabs(c), F, 1e-12), "Fresnel's share");
        CHECK(t, length(sub(reflected.wi, vec(-wo.x, -wo.y, wo.z))) == 0, "mirror direction");
        if (F == 1) {
            CHECK(t, lobe_sample_delta(&l, wo, 0.999999, IMPORTANCE, &refracted) && refracted.wi.z * c > 0,
                  "total reflection leaves no choice");
            continue;
        }
        CHECK(t, lobe_sample_delta(&l, wo, 0.999999, IMPORTANCE, &refracted), "refracts");
        CHECK(t, near(reflected.pdf + refracted.pdf, 1, 1e-12), "choice probabilities sum to 1");
        CHECK(t, near(refracted.f.g * fabs(refracted.wi.z), 1 - F, 1e-12), "and the rest");
    }
    l.R = rgb_black(); /* all samples go where there is something */
    CHECK(t, lobe_sample_delta(&l, direction(0.2, 1), 0, RADIANCE, &refracted) && refracted.wi.z < 0 &&
                 refracted.pdf == 1 && !lobe_sample_delta(&l, direction(-0.2, 1), 0, RADIANCE, &refracted),
          "glass that does not reflect, not even under total reflection");
    l.R = rgb_grey(1);
    l.T = rgb_black();
    CHECK(t, lobe_sample_delta(&l, direction(0.9, 1), 0.99, RADIANCE, &reflected) && reflected.wi.z > 0,
          "opaque glass");
}

/* --- closed forms ------------------------------------------------------------------------------------ */

/* Oren-Nayar as printed, with its angles, against the form without them. */
static void oren_nayar_as_printed(struct test *t)
{
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 21, 0);
    struct lobe l = facet_lobe(LOBE_OREN_NAYAR, 0, 0);
    l.of.oren_nayar.A = 0.8;
    l.of.oren_nayar.B = 0.3;
    for (int i = 0; i < 500; i++) {
        double theta_o = 1.5 * rng_uniform(&r), theta_i = 1.5 * rng_uniform(&r), phi = 7 * rng_uniform(&r);
        double alpha = fmax(theta_o, theta_i), beta = fmin(theta_o, theta_i);
        double expected = INV_PI * (0.8 + 0.3 * fmax(0, cos(phi)) * sin(alpha) * tan(beta));
        rgb f = lobe_eval(&l, direction(cos(theta_o), 0.4), direction(cos(theta_i), 0.4 + phi), true, RADIANCE).f;
        CHECK(t, near(f.r, expected, 1e-12), "Oren-Nayar: %g, printed form %g", f.r, expected);
    }
}

/* Facets as printed [Walter 2007], with tangents, angles and Fresnel's amplitudes: above the surface and below it,
 * where much is totally reflected. Isotropic: alpha is one number. */
static double facets_at(vec3 h, double alpha)
{
    double tangent2 = (sqr(h.x) + sqr(h.y)) / sqr(h.z);
    return alpha * alpha / (PI * pow(h.z, 4) * sqr(alpha * alpha + tangent2));
}

static double shadowed(vec3 w, double alpha) { return (sqrt(1 + sqr(alpha * tan(acos(fabs(w.z))))) - 1) / 2; }

/* The reflected share at the angle acos(c), from the side of index n1 to that of n2. */
static double reflected(double c, double n1, double n2)
{
    double angle = acos(fmin(c, 1)), sine = n1 / n2 * sin(angle);
    if (sine >= 1)
        return 1;
    double other = asin(sine), parallel = tan(angle - other) / tan(angle + other);
    return (sqr(parallel) + sqr(sin(angle - other) / sin(angle + other))) / 2;
}

/* Two directions above the surface: any; or, for lobes down to a roughness of a thousandth, the second about where
 * a mirror would send the first, or far from it; the first may lie a ten-thousandth above the surface. */
static void two_directions(struct rng *r, bool narrow, double alpha, vec3 *wo, vec3 *wi)
{
    *wo = direction(narrow ? pow(10, -4 * rng_uniform(r)) : 0.05 + 0.9 * rng_uniform(r), 7 * rng_uniform(r));
    do {
        double u = rng_uniform(r);
        vec3 h = direction(1 / sqrt(1 + sqr(alpha * u / (1 - u))), 7 * rng_uniform(r));
        *wi = narrow && u < 0.75 ? sub(mul(h, 2 * dot(*wo, h)), *wo)
                     : direction(0.05 + 0.9 * rng_uniform(r), 7 * rng_uniform(r));
    } while (wi->z < 1e-5);
}

static void facets_as_printed(struct test *t)
{
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 23, 0);
    int total = 0, met = 0;
    for (int i = 0; i < 4000; i++) {
        bool through = i % 2 == 1, narrow = !through && i % 8 >= 4;
        double alpha = narrow ? pow(10, -3 * rng_uniform(&r)) : 0.2 + 0.5 * rng_uniform(&r);
        double index = 1.2 + 0.6 * rng_uniform(&r);
        struct lobe l = facet_lobe(through ? LOBE_MICROFACET_TRANSMISSION : LOBE_MICROFACET_REFLECTION, alpha, alpha);
        l.eta_b = index;
        l.R = l.T = rgb_grey(0.7);
        vec3 wo, wi;
        two_directions(&r, narrow, alpha, &wo, &wi);
        double side = i % 4 < 2 ? 1 : -1, no = side > 0 ? 1 : index, ni = side > 0 ? index : 1;
        wo = mul(wo, side);
        wi = mul(wi, through ? -side : side);
        vec3 h = normalize(through ? neg(add(mul(wo, no), mul(wi, ni))) : add(wo, wi));
        h = h.z < 0 ? neg(h) : h;
        double o = dot(wo, h), in = dot(wi, h), F = reflected(fabs(o), no, ni), want = 0;
        double DG = facets_at(h, alpha) / (1 + shadowed(wo, alpha) + shadowed(wi, alpha));
        if (!through)
            want = F * DG / (4 * fabs(wo.z * wi.z));
        else if (o * wo.z > 0 && in * wi.z > 0) /* for importance; eq. 21 is for radiance that goes the other way */
            want = fabs(o * in / (wo.z * wi.z)) * ni * ni * (1 - F) * DG / sqr(no * o + ni * in);
        struct bsdf_value here = lobe_eval(&l, wo, wi, !through, IMPORTANCE);
        double f = here.f.g;
        CHECK(t, near(f, 0.7 * want, (narrow ? 1e-6 : 1e-9) * (1 + want)),
              "%s, %s, alpha %g: %.12g, printed form %.12g", through ? "transmission" : "reflection",
              side > 0 ? "above" : "below", alpha, f, 0.7 * want);
        double quarter = facets_at(h, alpha) / 4, there = quarter / ((1 + shadowed(wo, alpha)) * fabs(wo.z)),
               back = quarter / ((1 + shadowed(wi, alpha)) * fabs(wi.z));
        CHECK(t, through || (near(here.pdf, there, 1e-6 * there) && near(here.pdf_rev, back, 1e-6 * back)),
              "alpha %g: pdf %g and pdf_rev %g, printed form %g and %g", alpha, here.pdf, here.pdf_rev, there, back);
        struct bsdf_value not = lobe_eval(&l, wo, wi, through, IMPORTANCE);
        CHECK(t, rgb_is_black(not.f) && near(not.pdf, here.pdf, 1e-12 * here.pdf),
              "absorbed: where the geometric normal says otherwise f is %g, pdf %g, not 0 and %g", not.f.g, not.pdf,
              here.pdf);
        total += !through && side < 0 && F >= 1;
        met += through && want > 0;
    }
    CHECK(t, total > 200 && met > 200, "%d are totally reflected, %d come through", total, met);
}

/* The two layers of a substrate as printed [Ashikhmin & Shirley 2000], on facets as above. */
static void substrate_as_printed(struct test *t)
{
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 24, 0);
    for (int i = 0; i < 500; i++) {
        double alpha = 0.1 + 0.6 * rng_uniform(&r), Rd = rng_uniform(&r), Rs = rng_uniform(&r);
        struct lobe l = facet_lobe(LOBE_FRESNEL_BLEND, alpha, alpha);
        l.R = rgb_grey(Rd);
        l.of.coat = rgb_grey(Rs);
        double side = i % 2 == 0 ? 1 : -1, o = 0.05 + 0.9 * rng_uniform(&r), in = 0.05 + 0.9 * rng_uniform(&r);
        vec3 wo = direction(side * o, 7 * rng_uniform(&r)), wi = direction(side * in, 7 * rng_uniform(&r));
        vec3 h = normalize(add(wo, wi));
        double c = dot(wi, h), below = 1 - pow(1 - in / 2, 5), above = 1 - pow(1 - o / 2, 5);
        double want = 28 * Rd / (23 * PI) * (1 - Rs) * below * above +
                      facets_at(h, alpha) / (4 * c * fmax(o, in)) * (Rs + (1 - Rs) * pow(1 - c, 5));
        double f = lobe_eval(&l, wo, wi, true, RADIANCE).f.g;
        CHECK(t, near(f, want, 1e-9 * (1 + want)), "substrate: %.12g, printed form %.12g", f, want);
    }
}

void test_lobe(struct test *t)
{
    substrate_as_printed(t);
    facets_as_printed(t);
    fresnel_values(t);
    narrow_lobes(t);
    clear_coat(t);
    disney_values(t);
    glass(t);
    oren_nayar_as_printed(t);
}
