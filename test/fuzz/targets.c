/* targets.c: see targets.h. */
#define _POSIX_C_SOURCE 200809L
#define _XOPEN_SOURCE 700 /* symlink, on NetBSD */

#include "targets.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/mem.h"
#include "geometry/ply.h"
#include "hostile.h"
#include "lists.h"
#include "image/image.h"
#include "image/zlib.h"
#include "lab/files.h"
#include "lab/store.h"
#include "parser/parser.h"
#include "lab/methods.h"
#include "render/job.h"
#include "render/part.h"
#include "render/render.h"

/* A broken promise: whoever runs the target reports it with the input. */
static void broken(const char *what)
{
    fprintf(stderr, "BROKEN: %s\n", what);
    abort();
}

/* --- files ---------------------------------------------------------------------------------------------- */

/* A path for a file of the target; to be given to free(). */
static char *path_in(const char *directory, const char *name)
{
    size_t room = strlen(directory) + strlen(name) + 2;
    char *path = mem_alloc(room, 1);
    snprintf(path, room, "%s/%s", directory, name);
    return path;
}

/* The data as a file of that name; to be given to free(). */
static char *put_file(const char *directory, const char *name, const void *data, size_t size)
{
    char *path = path_in(directory, name);
    FILE *f = fopen(path, "wb");
    if (f == NULL || fwrite(data, 1, size, f) != size || fclose(f) != 0)
        broken("the directory for files cannot be written");
    return path;
}

/* --- pictures ------------------------------------------------------------------------------------------- */

typedef bool (*picture_reader)(const uint8_t *data, size_t size, const struct budget *memory, struct image *out,
                               struct error *err);

/* What reads can be used: every sample is there, and it can be written by every format. */
static void read_picture(picture_reader read, const uint8_t *data, size_t size, const char *directory)
{
    static const char *const FORMATS[] = {"o.pfm", "o.exr", "o.ppm", "o.png"};
    struct image img;
    struct error err = {.text = ""};
    memset(&img, 0, sizeof img);
    const struct budget memory = budget_new(256e6, "");
    if (!read(data, size, &memory, &img, &err)) {
        if (err.text[0] == '\0' || img.u8 != NULL || img.f32 != NULL)
            broken("a picture is refused without a message, or something is left of it");
        return;
    }
    size_t n = (size_t)img.width * (size_t)img.height;
    float *pixels = n <= 4096 ? mem_alloc(3 * n, sizeof *pixels) : NULL;
    for (size_t i = 0; pixels != NULL && i < 3 * n; i++) {
        size_t k = img.channels == 3 ? i : i / 3;
        pixels[i] = img.u8 != NULL ? img.decode[img.u8[k]] : img.f32[k];
    }
    for (size_t i = 0; pixels != NULL && i < sizeof FORMATS / sizeof FORMATS[0]; i++) {
        char *path = path_in(directory, FORMATS[i]);
        struct image again;
        if (!image_write(path, img.width, img.height, pixels, &err) || !image_read(path, NULL, &again, &err))
            broken(err.text);
        if (again.width != img.width || again.height != img.height)
            broken("a picture written has another size when it is read");
        image_free(&again);
        remove(path);
        free(path);
    }
    free(pixels);
    image_free(&img);
}

/* One more chunk at the end of a file in memory. */
static void add_chunk(uint8_t *file, size_t *used, const char *name, const uint8_t *data, size_t size)
{
    uint8_t *at = file + *used;
    for (size_t i = 0; i < 4; i++)
        at[i] = (uint8_t)(size >> (24 - 8 * i) & 255);
    memcpy(at + 4, name, 4);
    memcpy(at + 8, data, size);
    uint32_t crc = checksum_crc32(0, at + 4, size + 4);
    for (size_t i = 0; i < 4; i++)
        at[8 + size + i] = (uint8_t)(crc >> (24 - 8 * i) & 255);
    *used += size + 12;
}

/* A PNG file as it is, or, without its signature, what is in one: width, height, depth, colour, interlacing, a palette
 * and the rows. Checksums would keep out almost every change otherwise. */
static void fuzz_png(const uint8_t *data, size_t size, const char *directory)
{
    enum { HEAD = 5, PALETTE = 12 };
    if (png_matches(data, size) || size < HEAD + PALETTE) {
        read_picture(png_read, data, size, directory);
        return;
    }
    const uint8_t header[13] = {[3] = data[0], [7] = data[1], [8] = data[2], [9] = data[3], [12] = data[4]};
    size_t packed_size, used = 8;
    uint8_t *packed = deflate_zlib(data + HEAD + PALETTE, size - HEAD - PALETTE, &packed_size);
    uint8_t *file = mem_alloc(packed_size + 200, 1);
    memcpy(file, "\x89PNG\r\n\x1a\n", 8);
    add_chunk(file, &used, "IHDR", header, sizeof header);
    add_chunk(file, &used, "PLTE", data + HEAD, PALETTE);
    add_chunk(file, &used, "IDAT", packed, packed_size);
    add_chunk(file, &used, "IEND", packed, 0);
    read_picture(png_read, file, used, directory);
    free(packed);
    free(file);
}

static void fuzz_tga(const uint8_t *data, size_t size, const char *dir) { read_picture(tga_read, data, size, dir); }
static void fuzz_pfm(const uint8_t *data, size_t size, const char *dir) { read_picture(pfm_read, data, size, dir); }
static void fuzz_ppm(const uint8_t *data, size_t size, const char *dir) { read_picture(ppm_read, data, size, dir); }
static void fuzz_exr(const uint8_t *data, size_t size, const char *dir) { read_picture(exr_read, data, size, dir); }

/* Two bytes say how long the output is; what unpacks must come back when it is packed and unpacked. */
static void fuzz_inflate(const uint8_t *data, size_t size, const char *directory)
{
    (void)directory;
    if (size < 2)
        return;
    size_t n = (size_t)data[0] << 4 | data[1] >> 4, packed_size;
    uint8_t *out = mem_alloc(n, 1), *again = mem_alloc(n, 1);
    struct error err;
    if (inflate_zlib(data + 2, size - 2, out, n, &err)) {
        uint8_t *packed = deflate_zlib(out, n, &packed_size);
        if (!inflate_zlib(packed, packed_size, again, n, &err) || memcmp(out, again, n) != 0)
            broken("what was unpacked does not survive packing");
        free(packed);
    }
    free(out);
    free(again);
}

/* --- meshes and measurements ---------------------------------------------------------------------------- */

static void fuzz_ply(const uint8_t *data, size_t size, const char *directory)
{
    char *path = put_file(directory, "m.ply", data, size);
    struct mesh m;
    struct error err = {.text = ""};
    if (ply_read(path, &m, &err)) {
        for (int i = 0; i < 3 * m.n_triangles; i++)
            if (m.index[i] >= (uint32_t)m.n_vertices)
                broken("a mesh names a vertex that is not there");
        for (int i = 0; i < m.n_vertices; i++)
            if (!is_finite3(m.P[i]))
                broken("a vertex is nowhere");
        mesh_free(&m);
    } else if (err.text[0] == '\0') {
        broken("a mesh is refused without a message");
    }
    free(path);
}

/* A record of a measurement, which the program itself has written and somebody may have changed. */
static void fuzz_record(const uint8_t *data, size_t size, const char *directory)
{
    char *path = put_file(directory, "record.txt", data, size);
    struct record r;
    if (store_read(directory, "record", "key", &r)) {
        for (int i = 0; i < STORE_NUMBERS; i++)
            if (!isfinite(r.number[i]))
                broken("a record holds what is no number");
        free(r.pixels);
    }
    free(path);
}

/* A checkpoint. Its checksums are put right, or no change of anything else would get beyond them. */
static void fuzz_part(const uint8_t *data, size_t size, const char *directory)
{
    char *bytes = mem_alloc(size + 1, 1), hex[16];
    memcpy(bytes, data, size);
    char *check = strstr(bytes, "\ncheck ");
    if (check != NULL && size - (size_t)(check - bytes) >= 20) {
        size_t head = (size_t)(check - bytes) + 1, body = head + 15, n = size - 4 - body;
        snprintf(hex, sizeof hex, "%08lx\n", (unsigned long)checksum_crc32(0, (const uint8_t *)bytes, head));
        memcpy(bytes + head + 6, hex, 9);
        uint32_t crc = size >= body + 4 ? checksum_crc32(0, (const uint8_t *)bytes + body, n) : 0;
        for (size_t i = 0; i < 4 && size >= body + 4; i++)
            bytes[size - 4 + i] = (char)(crc >> 8 * i & 255);
    }
    char *path = put_file(directory, "x.part", bytes, size);
    struct part part;
    struct film film;
    struct error err = {.text = ""};
    FILE *f = part_open(path, &part, &err);
    if (f != NULL && (int64_t)part.width * part.height <= (int64_t)size) {
        struct pixel_rect all = {0, 0, part.width, part.height};
        float *pixels = mem_alloc((size_t)part.width * (size_t)part.height * 3, sizeof *pixels);
        film_init(&film, all, part.width, part.height);
        if (part_add(f, path, &part, &film, &err)) {
            film_develop(&film, part.scale, pixels);
            for (size_t i = 0; i < 3 * (size_t)part.width * (size_t)part.height; i++)
                if (!isfinite(pixels[i]))
                    broken("a pixel of a part is no number");
        }
        film_free(&film);
        free(pixels);
    } else if (f != NULL) {
        broken("a part is larger than its file");
    }
    if (f != NULL)
        part_free(&part);
    else if (err.text[0] == '\0')
        broken("a part is refused without a message");
    free(path);
    free(bytes);
}

/* --- scenes --------------------------------------------------------------------------------------------- */

enum { WIDTH = 3, HEIGHT = 2, SAMPLES = 2, DEPTH = 4 };

static void render(const struct scene *scene, const char *integrator)
{
    struct render_job o = {.integrator = method_of(scene, integrator), .end = SAMPLES, .n_threads = 1,
                               .max_depth = DEPTH};
    struct film film;
    struct error err = {.text = ""};
    float pixels[3 * WIDTH * HEIGHT];
    film_init(&film, render_crop(scene), scene->width, scene->height);
    if (render_by(scene, &o, &film, &err)) {
        film_develop(&film, scene->film_scale, pixels);
        for (int i = 0; i < 3 * rect_width(film.rect) * rect_height(film.rect); i++)
            if (!isfinite(pixels[i]))
                broken("a pixel is no number");
    } else if (err.text[0] == '\0') {
        broken("a render fails without a message");
    }
    film_free(&film);
}

/* Six pixels by every method. Parameters of the scene that are wrong are refused by the first render already, and then
 * left out. */
static void render_all(struct scene *scene)
{
    static const double WHOLE[4] = {0, 1, 0, 1};
    scene->width = WIDTH;
    scene->height = HEIGHT;
    memcpy(scene->crop, WHOLE, sizeof scene->crop);
    job_adapt(scene, method_rows, NULL, NULL);
    scene_prepare(scene);
    for (const struct method *const *m = method_rows; *m != NULL; m++) {
        render(scene, (*m)->name);
        settings_clear(&scene->settings);
        if (m[1] != NULL && m[1]->select != NULL)
            settings_set(&scene->settings, "select", m[1]->select, "-P");
    }
}

/* Messages are for a terminal: one sentence each, and no byte of the scene's that a terminal would act on. */
static void hear(void *context, bool is_error, const char *text)
{
    (void)context;
    (void)is_error;
    for (; *text != '\0'; text++)
        if ((unsigned char)*text < ' ' && *text != '\n')
            broken("a message holds a control character");
}

static void fuzz_scene(const uint8_t *data, size_t size, const char *directory)
{
    char *path = put_file(directory, "scene.pbrt", data, size);
    struct message_sink sink = {hear, NULL};
    struct scene scene;
    struct error err = {.text = ""};
    if (parse_scene(path, NULL, &scene, &sink, &err)) {
        render_all(&scene);
        scene_free(&scene);
    } else if (err.text[0] == '\0') {
        broken("a scene is refused without a message");
    }
    free(path);
}

/* Scenes that are well formed and hostile in their numbers: the bytes choose, see hostile.h. Thousands of shapes in one
 * place take a second here, a hundred times what they take without sanitizers: test_hostile.c renders those. */
static void fuzz_hostile(const uint8_t *data, size_t size, const char *directory)
{
    size_t length;
    char *text = hostile_scene(data, size, &length);
    if (length <= 16384)
        fuzz_scene((const uint8_t *)text, length, directory);
    free(text);
}

/* --- the table ------------------------------------------------------------------------------------------ */

const struct fuzz_target fuzz_targets[] = {
    {"png", fuzz_png}, {"tga", fuzz_tga},         {"pfm", fuzz_pfm}, {"ppm", fuzz_ppm},   {"exr", fuzz_exr},
    {"ply", fuzz_ply}, {"inflate", fuzz_inflate}, {"part", fuzz_part}, {"record", fuzz_record}, {"scene", fuzz_scene},
    {"hostile", fuzz_hostile}, {NULL, NULL}};

const struct fuzz_target *fuzz_find(const char *name)
{
    for (const struct fuzz_target *t = fuzz_targets; t->name != NULL; t++)
        if (strcmp(t->name, name) == 0)
            return t;
    return NULL;
}

void fuzz_prepare(const char *directory)
{
    struct error err;
    char *parts = path_in(directory, "parts");
    if (!list_unpack("test/data/fixtures/parts", parts, &err))
        broken(err.text);
    free(parts);
}
