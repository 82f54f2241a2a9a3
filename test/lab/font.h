/* font.h: letters for labelled pictures, drawn in font.c as they look: 5 x 7 pixels and a row for descenders.
 *
 * Tests: test_sheet.c.
 */
#ifndef ASBDPT_FONT_H
#define ASBDPT_FONT_H

#include <stdbool.h>

enum { FONT_WIDTH = 5, FONT_HEIGHT = 8, FONT_ADVANCE = FONT_WIDTH + 1 };

/* font_pixel: is pixel (x,y) of a letter ink? (0,0) is the top left one. Letters other than printable ASCII are drawn
 * as '?'. */
bool font_pixel(char letter, int x, int y);

#endif
