/* mesh.h: shapes that are made of triangles or of curves. Each is one file and one row of the table in mesh.c.
 *
 * Tests: test_parser.c, test_format.c.
 */
#ifndef ASBDPT_MESH_H
#define ASBDPT_MESH_H

#include "base/file.h"
#include "base/field.h"
#include "geometry/shape.h"

/* Who wants a mesh. */
struct mesh_task {
    const char *shape; /* what its row is called */
    const struct budget *memory; /* that may be used */
    const char *about; /* the parameter that messages are about; NULL: all of the shape */
    struct error err;  /* why there is no mesh */
    void (*warn)(const struct mesh_task *task, const char *format, ...); /* and what is no reason for that */
    void *context;     /* of warn */
};

struct shape_row {
    const char *name;           /* Shape "name" */
    const struct field *fields; /* ended by one without a name */
    size_t size;                /* of the struct to be filled */
    bool may_shine;             /* can it be an area light? */
    /* Fill *out, which is empty, from the fields. False with a message. What it leaves empty is left out. */
    bool (*mesh)(const void *fields, struct mesh_task *task, struct mesh *out);
};

/* All rows, ended by NULL. */
extern const struct shape_row *const shape_rows[];

/* mesh_triangles: points and triangles between them; where there are none, or an index is wrong, only a
 * warning. */
void mesh_triangles(struct field_list P, struct field_list indices, struct mesh_task *task, struct mesh *out);

/* mesh_fits: is there memory to make so many triangles, and to place them? False with a message if not. */
bool mesh_fits(struct mesh_task *task, double triangles);

#endif
