/* random_parts.h: what random scenes are made of (random_scene.h): textures, materials, shapes, lights. */
#ifndef ASBDPT_TEST_RANDOM_PARTS_H
#define ASBDPT_TEST_RANDOM_PARTS_H

#include "random_writer.h"

/* put_textures: definitions of a few. put_material: a material; `lamp`: one that suits a light. */
void put_textures(struct writer *w);
void put_material(struct writer *w, bool lamp);

/* put_media: definitions of two, "fog" and "milk", and what the camera is in, if the scene has any. put_bound: an
 * interface around all things, with nothing outside; or none, so that the medium has no bound. put_milk: a closed shape
 * about the origin with the other medium in it, of any material or none, which may shine; no lamp is in it. put_boxes:
 * on the ground, z = -1.6, one or two boxes of media that share a face.
 *   unit  how long a unit is in the world */
void put_media(struct writer *w, double unit);
void put_bound(struct writer *w);
void put_milk(struct writer *w);
void put_boxes(struct writer *w);

/* put_shape: a shape of about radius 1 about the origin, of the current material; `lamp`: one that may be a light. */
void put_shape(struct writer *w, bool lamp);

/* put_area_light: a shape that shines. */
void put_area_light(struct writer *w);

/* put_light: a light two units and more from the origin that shines towards it, or at infinity.
 *   unit  how long a unit is in the world, by which the strength of delta lights is to be measured */
void put_light(struct writer *w, double unit);

#endif
