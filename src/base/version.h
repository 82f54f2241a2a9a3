/* version.h: what the program calls itself, and which pictures it makes.
 *
 * ESTIMATOR is raised by every change that is meant to give other pictures of the same scene: films of programs with
 * another number are not continued or added up, see render/part.h. `make hashes` checks it: it writes no other
 * checksums of pictures under the same number. */
#ifndef ASBDPT_VERSION_H
#define ASBDPT_VERSION_H

#define VERSION "asbdpt 0.9"
#define ESTIMATOR 23

#endif
