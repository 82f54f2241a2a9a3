/* version.h: what the program calls itself. Films of another version are not continued, see render/part.h. */
#ifndef ASBDPT_VERSION_H
#define ASBDPT_VERSION_H

#define VERSION "asbdpt 0.1"

#endif
