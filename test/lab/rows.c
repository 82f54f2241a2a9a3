/* rows.c: the methods of asbdpt-lab: the renderer's (src/render/rows.c), and those that they are compared with. */
#include "render/job.h"

extern const struct method method_pt, method_lt, method_bdpt, method_bins, method_pool, method_vertices,
    method_subspaces, method_lvc, method_cbdpt, method_mbdpt, method_pcbdpt, method_ris, method_ris2, method_spcbpt,
    method_restir, method_restirgi, method_pathgraph, method_ellipse, method_ppg,
    method_vcm, method_pssmlt, method_mmlt, method_mlt,
    method_caustics, method_regularise;

const struct method *const method_rows[] = {
    &method_pt,     &method_lt,     &method_bdpt,     &method_subspaces, &method_bins,   &method_pool,
    &method_vertices, &method_lvc,  &method_cbdpt,    &method_mbdpt,     &method_pcbdpt, &method_ris,
    &method_ris2,   &method_spcbpt, &method_restir, &method_restirgi, &method_pathgraph, &method_pssmlt, &method_mmlt,
    &method_mlt,    &method_ellipse, &method_ppg, &method_vcm, &method_caustics, &method_regularise, NULL};

const char *const method_elsewhere[] = {NULL};
