/* random_scene.h: a scene from a number, for tests that ask whether all methods see the same.
 *
 * Everything is drawn: the camera and what is before it, film, filter, crop, unit of length, where all that is, shapes,
 * instances, lights, materials, textures, and linear maps (turns, uneven scales, shears, mirrors) around each. Three
 * families:
 *
 *     furnaces   every ray sees the same, by theory: walls of albedo a that shine, or a sky over one convex thing
 *     direct     a patch lit by a delta light, seen from so near that the picture is one number, which is computed
 *                here without the program's help: pbrt-v3's rules for spots, distant lights and vertex normals
 *     any        nothing is known but that all methods must agree; a third of them have media: about all things,
 *                with a bound or without, within one closed shape, and in boxes that stand on the ground and share a
 *                face
 *
 * The sizes are such that pictures are neither black nor governed by rare bright samples: lights and camera stay away
 * from surfaces, rough lobes are broad, walls and lamps large.
 *
 * Tests: test_random.c, test_hostile.c. `build/test --scene N` prints scene N.
 */
#ifndef ASBDPT_TEST_RANDOM_SCENE_H
#define ASBDPT_TEST_RANDOM_SCENE_H

#include <stdbool.h>
#include <stdint.h>

struct random_scene {
    char *text; /* owned */
    const char *family;
    int max_depth;
    double unit;      /* how long a unit is in the world: things lie within 8 of them, about the eye */
    bool known;       /* does every pixel show a value from low to high? */
    bool one_ray;     /* family "direct": all rays hit the same place, and path tracing alone has a chance */
    double low, high;
    bool delta_light; /* some light is met by no ray */
    bool placed;      /* surfaces lie in one place, and most of the light comes from there if they shine */
    bool media, fog;  /* are there any (scene/medium.h), and about the lens as well? Joining a point in fog to a point
                         light, or to the lens, has no variance unless it is weighed against other ways */
    bool specular;    /* some surface reflects or transmits in single directions, so that pt cannot join what is
                         behind it to a delta light, and lt cannot join it to the lens */
    bool rare;        /* a layered material has spikes of grazing light: some tiles get much of theirs by few samples */
};

/* random_scene: scene number `number`.
 *   top   the path of the source tree, with a slash at its end unless it is empty; stands before names of pictures
 *   evil  some numbers are ones that no scene should have; nothing is known then
 * To be given to free(): text. */
struct random_scene random_scene(uint64_t number, const char *top, bool evil);

/* random_scene_moved: the same, without evil, moved with its camera so many units away from the origin, up to 1e8. Half
 * of those of random_scene are moved, too, by as many as are drawn. */
struct random_scene random_scene_moved(uint64_t number, const char *top, double away);

#endif
