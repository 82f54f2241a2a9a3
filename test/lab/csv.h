/* csv.h: comma-separated values, whatever a scene is called. */
#ifndef ASBDPT_CSV_H
#define ASBDPT_CSV_H

#include <stdio.h>

/* csv_text: one field of a line: in quotes where it has to be. */
void csv_text(FILE *f, const char *text);

#endif
