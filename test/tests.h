/* tests.h: every test of the suite, one line each; main.c lists them in order. */
#ifndef ASBDPT_TESTS_H
#define ASBDPT_TESTS_H

#include "test.h"

void test_part(struct test *t);
void test_asbdpt(struct test *t);
void test_bins(struct test *t);
void test_asbdpt_long(struct test *t);
void test_what_is_drawn(struct test *t); /* part of test_asbdpt, quick */
void test_aov(struct test *t);
void test_alias(struct test *t);
void test_growth(struct test *t); /* of CPU time: for the course alone, which asks for it by name */
void test_bsdf(struct test *t);
void test_closed(struct test *t);
void test_conform(struct test *t);
void test_chains(struct test *t);
void test_chains_long(struct test *t);
void test_camera(struct test *t);
void test_caustic(struct test *t);
void test_devices(struct test *t);
void test_ellipse(struct test *t);
void test_sdtree(struct test *t);
void test_emission(struct test *t);
void test_equal_time(struct test *t); /* part of test_report */
void test_coverage(struct test *t); /* part of test_report */
void test_plan(struct test *t); /* part of test_report */
void test_far(struct test *t);
void test_features(struct test *t);
void test_format(struct test *t);
void test_file(struct test *t);
void test_film(struct test *t);
void test_frame(struct test *t);
void test_fuzz(struct test *t);
void test_gates(struct test *t);
void test_halves(struct test *t);
void test_halves_long(struct test *t);
void test_hdr(struct test *t);
void test_hostile(struct test *t);
void test_image(struct test *t);
void test_kdtree(struct test *t);
void test_learning(struct test *t);
void test_light(struct test *t);
void test_light_sent(struct test *t); /* part of test_light */
void test_lights(struct test *t);
void test_lobe(struct test *t);
void test_material(struct test *t);
void test_maths(struct test *t);
void test_walk(struct test *t);
void test_joint(struct test *t);
void test_formulas(struct test *t);
void test_media(struct test *t);
void test_media_long(struct test *t);
void test_medium(struct test *t);
void test_mis(struct test *t);
void test_objects(struct test *t);
void test_options(struct test *t);
void test_race(struct test *t);
void test_places(struct test *t);
void test_parser(struct test *t);
void test_pictures(struct test *t);
void test_ply(struct test *t);
void test_random(struct test *t);
void test_random_long(struct test *t);
void test_render(struct test *t);
void test_regions(struct test *t);
void test_references(struct test *t);
void test_references_long(struct test *t);
void test_report(struct test *t);
void test_rivals(struct test *t);
void test_ris(struct test *t);    /* part of test_rivals */
void test_spcbpt(struct test *t); /* the same */
void test_rivals_long(struct test *t);
void test_scenes(struct test *t);
void test_scenes_long(struct test *t);
void test_family_long(struct test *t);
void test_balance(struct test *t);
void test_strategies(struct test *t);
void test_streams(struct test *t);
void test_threads(struct test *t);
void test_verify(struct test *t);
void test_sampler(struct test *t);
void test_table(struct test *t);
void test_sheet(struct test *t);
void test_shape(struct test *t);
void test_smooth(struct test *t); /* part of test_shape */
void test_stats(struct test *t);
void test_structure(struct test *t);
void test_subdivide(struct test *t);
void test_curve(struct test *t);
void test_fourier(struct test *t);
void test_texture(struct test *t);
void test_vec(struct test *t);
void test_trace(struct test *t);
void test_zlib(struct test *t);
void test_warp(struct test *t);

#endif
