/* fourier.h: layered materials as pbrt-v3's .bsdf files have them [Jakob 2014]: for pairs of cosines to the
 * normal a Fourier series in the difference of azimuths, between them splines.
 *
 * wo and wi are unit vectors in the shading frame, away from the surface.
 *
 * Tests: test_fourier.c, test_bsdf.c.
 */
#ifndef ASBDPT_FOURIER_H
#define ASBDPT_FOURIER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/error.h"
#include "material/lobe.h"

struct fourier_table {
    uint64_t content;   /* hash_content of the file */
    size_t file_size;
    int n_mu, channels; /* channels: 1 (luminance) or 3 (luminance, red, blue) */
    double eta;         /* index below over index above */
    double *mu;         /* [n_mu] cosines, rising from -1 to 1 at most */
    uint32_t *first;    /* [n_mu][n_mu] of wo and of -wi: where in a the series begins */
    uint32_t *length;   /* [n_mu][n_mu] its coefficients in each channel */
    double *a;          /* the coefficients of f |cos(wi)| */
    float *cdf;         /* [n_mu][(n_mu - 1)*FOURIER_AZIMUTHS + 1] to draw -wi by, for each cosine of wo: of all cells
                         * between cosines and azimuths up to pi, from 0 to 1; all 0 where nothing is scattered */
};

enum { FOURIER_AZIMUTHS = 32 };

/* fourier_read: a table, to be given to fourier_free. Returns false with a message if there is none, or it is damaged
 * or of a kind that pbrt-v3 does not read either. */
bool fourier_read(const char *path, struct fourier_table *out, struct error *err);
void fourier_free(struct fourier_table *t);

/* form_fourier: wi is drawn about as radiance goes from there to wo, nowhere with density 0. */
extern const struct lobe_form form_fourier;

#endif
