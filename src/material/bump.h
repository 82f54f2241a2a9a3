/* bump.h: a surface displaced by a texture, for shading only.                                      [Blinn 1978]
 * Used by: material. Tests: test_material.c.
 */
#ifndef ASBDPT_BUMP_H
#define ASBDPT_BUMP_H

#include "base/frame.h"
#include "geometry/surface.h"
#include "material/texture.h"

/* bump_frame: the shading frame of the surface p + d(u,v) ns, as pbrt-v3 finds it.
 *   displacement  float texture number, world units
 *   at            its dpdu, dpdv are the partials that shading uses
 * The normal lies on ng's side. Falls back to the smooth frame where the displaced surface has no normal. */
struct frame bump_frame(const struct texture_set *textures, int displacement, const struct surface *at);

#endif
