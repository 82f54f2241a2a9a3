/* test_media.c: the scenes of scenes/media by all methods that render media: each has the expectation of bdpt, and a
 * planted fault is found. test_medium.c has closed forms, test_strategies.c one strategy after another. */
#include "agree.h"
#include "suites.h"

/* `spp` of bdpt bring the noise down so far that what is `planted` is seen. Light sub-paths alone do not show what is
 * behind glass; eye sub-paths do not find a thread of light before long, nor chains of mmlt a lamp behind glass. */
#define POOLED "asbdpt, asbdpt select=pool, asbdpt select=vertices, lvc, cbdpt, mbdpt"
static const struct {
    const char *name;
    int depth, spp;
    double planted;
    const char *quick, *pooled, *chains; /* methods, and pt, in place of quick ones where there are none: */
    int pt;                              /* so many times the samples */
} SCENES[] = {{"scenes/media/fog-cornell", 6, 12, 0.3, "lt, asbdpt", "lt, " POOLED, "pssmlt, mmlt", 4},
              {"scenes/media/laser", 5, 8, 0.5, "lt, asbdpt", "lt, " POOLED, "pssmlt, mmlt", 0},
              {"scenes/media/milk-ball", 8, 8, 0.25, "asbdpt", POOLED, "pssmlt", 4},
              {"scenes/media/murky-water", 8, 16, 0.8, "", POOLED, "pssmlt", 4},
              {"scenes/media/nested", 6, 4, 0.3, "", "lt, " POOLED, "pssmlt, mmlt", 4},
              {"scenes/media/inside", 6, 8, 0.8, "", "lt, " POOLED, "pssmlt, mmlt", 4}};

/* Batches of a Markov chain are few and far from normal: nothing is planted. */
static void test_all(struct test *t, bool quick)
{
    enum { SIZE = 16, BATCHES = 12 };
    for (size_t i = 0; i < sizeof SCENES / sizeof SCENES[0]; i++) {
        struct agreement a = {SCENES[i].name, SIZE, SIZE, SCENES[i].depth, "bdpt", quick ? SCENES[i].quick
                              : SCENES[i].pooled, SCENES[i].spp, SCENES[i].spp, BATCHES, quick ? SIZE : SIZE / 2, false,
                              SCENES[i].planted};
        check_agreements(t, &a, a.ways[0] != '\0', quick ? 1 : 4);
        bool by_pt = !quick || a.ways[0] == '\0';
        a.ways = "pt";
        a.spp *= SCENES[i].pt;
        check_agreements(t, &a, by_pt && a.spp > 0, quick ? 1 : 4);
        a.ways = SCENES[i].chains;
        a.spp = SCENES[i].spp;
        a.planted = 0;
        check_agreements(t, &a, !quick, 4);
    }
}

void test_media(struct test *t) { test_all(t, true); }
void test_media_long(struct test *t) { test_all(t, false); }
