/* rows.c: the methods of asbdpt; see job.h. A new method is a new line here, or, if it is only to be compared with
 * these, in the laboratory's table, test/lab/rows.c. */
#include "render/job.h"

extern const struct method method_pt, method_lt, method_bdpt, method_bins, method_pool, method_vertices,
    method_subspaces;

const struct method *const method_rows[] = {&method_pt,   &method_lt,   &method_bdpt,     &method_subspaces,
                                            &method_bins, &method_pool, &method_vertices, NULL};

const char *const method_elsewhere[] = {
    "caustics", "cbdpt",  "ellipse", "lvc",      "mbdpt", "mlt", "mmlt",   "pathgraph", "pcbdpt", "ppg", "pssmlt",
    "regularise", "restir", "restirgi", "ris", "ris2", "spcbpt", "vcm", NULL};
