/* mesh.h: shapes that are made of triangles. Each is one file and one row; the table of all is mesh_rows.c.
 *
 * Tests: test_parser.c, test_format.c.
 */
#ifndef ASBDPT_MESH_H
#define ASBDPT_MESH_H

#include "base/field.h"
#include "geometry/shape.h"

/* Triangles that subdivided surfaces, curves and the like may have in all of a scene. */
enum { MESH_MAX_SUBDIVIDED = 1 << 23 };

/* Who wants a mesh. */
struct mesh_task {
    const char *shape; /* what its row is called */
    int room;          /* of MESH_MAX_SUBDIVIDED, what is left; makers take from it */
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

/* mesh_take_room: so many triangles of the task's room; false with a message if there are none. */
bool mesh_take_room(struct mesh_task *task, int64_t triangles);

#endif
