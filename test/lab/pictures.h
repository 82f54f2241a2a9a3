/* pictures.h: the pictures of a scene on one sheet: what each method made of the scene, below each its errors as a heat
 * map, and the reference.
 *
 * Columns are labelled with the root mean square of the errors of all 8-bit values, and with that of means over 8x8
 * pixels. The heat maps share one scale, so that they can be compared: dark is no error, bright is the 99th percentile
 * of all their errors, and more. Errors are those of the displayed 8-bit values, as in the tables.
 *
 * Tests: test_report.c, test/run/cli.sh.
 */
#ifndef ASBDPT_PICTURES_H
#define ASBDPT_PICTURES_H

#include "lab/results.h"
#include "lab/sheet.h"

enum { COLUMN_GAP = 24, COLUMN_LABEL = 60, COLUMN_WIDTH = 480, PICTURES_PERCENTILE = 99 };
enum { PICTURES_MOST = 6 }; /* methods; more have report.html alone */

/* pictures_sheet: the sheet, to be released with sheet_free. pictures_write: the same as
 * images/SCENE.png; false with a message. */
struct sheet pictures_sheet(const struct scene_results *s);
bool pictures_write(const struct scene_results *s, struct error *err);

#endif
