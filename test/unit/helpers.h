/* helpers.h: what several tests need: files, scenes from text, renders in batches, comparison of two renders. */
#ifndef ASBDPT_TEST_HELPERS_H
#define ASBDPT_TEST_HELPERS_H

#include "base/file.h"
#include "base/rng.h"
#include "geometry/mesh.h"
#include "image/image.h"
#include "integrators/method.h"
#include "lab/methods.h"
#include "lab/sides.h"
#include "lab/verify.h"
#include "render/render.h"
#include "scene/scene.h"
#include "test.h"

/* QUAD: of a scene's text: two triangles, by the corners around them, "x y z  x y z  x y z  x y z". */
#define QUAD(corners)                                                                                                  \
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" [" corners "]\n"

/* write_bytes: make a file of n bytes. If that fails there is none, as the test will notice. */
void write_bytes(const char *path, const void *data, size_t n);

/* top_directory: the path of the source tree, where tests are run, with a slash at its end. */
const char *top_directory(char *path, size_t size);

/* A reader of a picture format (image/image.h).
 * read_exactly: call it on a copy that ends where its memory ends.
 * accepts: is the file a picture? If not, *err says why. */
typedef bool reader(const uint8_t *data, size_t size, const struct budget *memory, struct image *out,
                    struct error *err);
bool read_exactly(reader *read, const uint8_t *data, size_t n, struct image *out, struct error *err);
bool accepts(reader *read, const uint8_t *data, size_t n, struct error *err);

/* check_no_picture: is the file refused in one line that holds this message?
 * check_spoilt: every proper beginning of the file is refused, or some hundred of a longer one; changed bytes are
 * survived. Returns how many changed files are accepted. */
void check_no_picture(struct test *t, reader *read, const uint8_t *data, size_t n, const char *message);
int check_spoilt(struct test *t, const char *what, reader *read, const uint8_t *data, size_t n);

/* scene_from_text: parse and prepare a scene given as text. A failure is a failed check; returns false. */
bool scene_from_text(struct test *t, const char *text, struct scene *out);

/* scene_from_format: the same, of a format and what follows it. */
bool scene_from_format(struct test *t, struct scene *out, const char *format, ...);

/* scene_path: "scenes/FOLDER/NAME" as it is, or, if that is in a list (lists.h), where it lies as a file: in the test's
 * own directory, beside all that it names. */
const char *scene_path(struct test *t, const char *path, char out[512]);

/* scene_from_structure: the same of a generated scene (random_structure.h), at the given resolution. */
bool scene_from_structure(struct test *t, uint64_t number, int width, int height, struct scene *out);

/* scene_from_file: the same for such a path, at the given resolution (0: as it is) with a box filter. */
bool scene_from_file(struct test *t, const char *path, int width, int height, struct scene *out);

/* What a Shape directive says of a shape of triangles, all zeros at first.
 * shape_fields_set: the field of that name, of so many bytes. shape_fields_mesh: its mesh, which may use so many bytes;
 * releases the fields. */
struct shape_fields {
    const struct shape_row *row;
    char *fields;
};
struct shape_fields shape_fields_of(const char *shape);
void shape_fields_set(struct shape_fields *f, const char *name, const void *value, size_t size);
bool shape_fields_mesh(struct shape_fields *f, double bytes, struct mesh *out, struct error *err);

/* stream_of: random numbers of a specimen's own, by its name and a purpose: what else a test has does not change them. */
struct rng stream_of(const struct test *t, const char *name, uint64_t purpose);

/* near3: are two points, or directions, no farther from each other? on_sphere: a direction, uniform. */
bool near3(vec3 a, vec3 b, double tolerance);
vec3 on_sphere(struct rng *r);

/* group_of: what shapes of this material have in common. surface_at: a point of a triangle or quadric. */
struct shape_group group_of(int material, int first_light);
struct surface surface_at(const struct geometry *geo, int prim, double b1, double b2);

/* random_affine: a transform of uneven scale and shear, half of them mirrors, with some translation; no direction
 * becomes more than some ten times as long as another. */
struct transform random_affine(struct rng *r);

/* filter_of: the filter of that name, as pbrt has it, prepared. */
struct filter filter_of(const char *name);

/* set_method: choose by "asbdpt select=bins restart=16", say, whose parameters replace all settings of the scene.
 * Returns the integrator's name, which the next call overwrites. */
const char *set_method(struct scene *scene, const char *way);
const struct method *set_row(struct scene *scene, const char *way);

/* method_name: such words for a method with all its defaults, which the next call overwrites. */
const char *method_name(const struct method *m);

/* render_film: render into a fresh film of the scene's crop window, to be given to film_free. */
void render_film(struct test *t, const struct scene *scene, const struct render_job *o, struct film *film);

/* render_pixels: render and develop: out is [pixels * 3]. */
void render_pixels(struct test *t, const struct scene *scene, const struct render_job *o, float *out);

/* films_equal: the sums of all pixels of two films of one size, to the last bit. */
bool films_equal(const struct film *a, const struct film *b);

/* same_picture: do two ways (set_method) make the same film, to the last bit, with these options? */
bool same_picture(struct test *t, struct scene *scene, const char *one, const char *other, struct render_job o);

/* render_batches: render `n_batches` times with `spp` samples, times the effort, and average over square tiles of
 * `tile` pixels. Powers of two are best: low-discrepancy points lie evenly then. Batches are parts of one long render,
 * so far apart that their numbers have nothing in common (sampler.h), by what was learnt before it, once. */
struct batches render_batches(struct test *t, const struct scene *scene, const char *integrator, int max_depth, int spp,
                              int n_batches, int tile, uint64_t seed);

/* Of a path's length, in scene units (caustics/derived.h): all from `begin` to below `end`; its end 0: all. */
struct gate {
    double begin, end;
};

/* pixels_all: of a tile alone. */
static inline struct tile_pixels pixels_all(struct pixel_rect r) { return (struct tile_pixels){r, 1, 1, 0, 0}; }

/* render_gated: as render_batches, of light whose paths have such lengths. */
struct batches render_gated(struct test *t, const struct scene *scene, const char *integrator, int max_depth,
                            struct gate gate, int spp, int n_batches, int tile, uint64_t seed);

/* independent_batches: the same by renders with seeds of their own, which share nothing that was found before the first
 * sample either: the brightness of a chain's picture, above all. */
struct batches independent_batches(struct test *t, const struct scene *scene, const char *integrator, int max_depth,
                                   long spp, int n_batches, int tile, uint64_t seed);

/* read_reference: a stored picture, NAME.pfm, with its errors. A failure is a failed check; returns false. */
bool read_reference(struct test *t, const char *path, struct side *out);

/* load_reference: the picture ref/NAME.pfm with its errors, averaged over square tiles. A failure is a failed check. */
bool load_reference(struct test *t, const char *name, int tile, int *width, int *height, struct batches *out);

/* batches_scale: multiply all by a factor, as a fault would. */
void batches_scale(struct batches *b, double factor);

/* batches_p: batches_smallest_p, and in *ratio the mean of a over the mean of b. */
double batches_p(const struct batches *a, const struct batches *b, double *ratio);

/* batches_paired_p: the same for batches that are not independent, as those of one seed, which share eye sub-paths and
 * with them most of their noise: by Student's t over the differences, of every value and of the mean. */
double batches_paired_p(const struct batches *a, const struct batches *b, double *ratio);

/* text_of: the content of a file in a directory (scene_path), to be freed; an empty text after a failed check. */
char *text_of(struct test *t, const char *directory, const char *name);

/* remove_tree: a directory and all that is in it. False if something is left. */
bool remove_tree(const char *path);

/* mean_p: two-sided p-value of "the expectation is `expected`" for the batches' overall mean, by Student's t. */
double mean_p(const struct batches *b, double expected);

#endif
