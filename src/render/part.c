/* part.c: see part.h. */
#include "render/part.h"

#include <errno.h>
#include <inttypes.h>
#include <limits.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "base/bits.h"
#include "base/file.h"
#include "base/mem.h"
#include "base/number.h"
#include "base/os.h"
#include "base/version.h"
#include "image/zlib.h"

static const char MAGIC[] = "asbdpt part 9\n";
enum { MOST_TEXT = 1 << 20, BUFFER = 1 << 16, EMPTY = 255, LONGEST_SUM = 1 + 10 * EXACT_DIGITS };

/* Of the picture; with half its samples; and, of a block under way, with its splats and then, of each pixel, its
 * samples. */
static size_t picture_of(const struct part *p) { return (size_t)p->width * (size_t)p->height * 3; }
static size_t samples_of(const struct part *p) { return picture_of(p) * (p->halves ? 2 : 1); }
static size_t splats_of(const struct part *p) { return samples_of(p) + (p->passes > 0 ? picture_of(p) : 0); }
static size_t sums_of(const struct part *p) { return splats_of(p) + (p->passes > 0 ? picture_of(p) / 3 : 0); }

/* --- what a render is of ------------------------------------------------------------------------------ */

struct lines {
    char *text; /* owned */
    size_t used, capacity;
};

/* One line more; whatever could break a line is replaced. */
static void add_line(struct lines *l, const char *format, ...)
{
    struct error line;
    va_list args;
    va_start(args, format);
    vsnprintf(line.text, sizeof line.text, format, args);
    va_end(args);
    error_clean(line.text);
    size_t n = strlen(line.text);
    l->text = mem_grow(l->text, &l->capacity, l->used + n + 2, 1);
    memcpy(l->text + l->used, line.text, n);
    l->used += n;
    memcpy(l->text + l->used++, "\n", 2);
}

static int by_name(const void *a, const void *b)
{
    const struct setting *const *x = a, *const *y = b;
    return strcmp((*x)->name, (*y)->name);
}

/* In order of their names: -P may give them in any. Long values are told apart by a hash. */
static void add_settings(struct lines *l, const struct settings *s)
{
    const struct setting **item = mem_alloc((size_t)s->n, sizeof *item);
    for (int i = 0; i < s->n; i++)
        item[i] = &s->item[i];
    qsort(item, (size_t)s->n, sizeof *item, by_name);
    for (int i = 0; i < s->n; i++)
        if (strcmp(item[i]->name, "maxdepth") != 0)
            add_line(l, "parameter %.100s %.200s %016" PRIx64, item[i]->name, item[i]->value,
                hash_content(item[i]->value, strlen(item[i]->value)));
    free(item);
}

/* The lines from "version" on: all that changes a byte of a sample. To be given to free(). */
static char *identity_text(const struct render_job *job)
{
    const struct scene *scene = job->scene;
    const struct filter *f = &scene->filter;
    struct lines l = {0};
    add_line(&l, "version %s, estimator %d", VERSION, ESTIMATOR);
    add_line(&l, "scene %016" PRIx64, scene->content);
    add_line(&l, "integrator %s", job->integrator->name);
    add_line(&l, "maxdepth %d", job->max_depth);
    add_settings(&l, &scene->settings);
    add_line(&l, "seed %" PRIu64, job->seed);
    add_line(&l, "filter %d %.17g %.17g %.17g %.17g %.17g %.17g", (int)f->kind, f->radius[0], f->radius[1], f->alpha,
             f->B, f->C, f->tau);
    return l.text;
}

struct part part_describe(const struct render_job *job)
{
    const struct scene *scene = job->scene;
    struct pixel_rect r = job->film_rect;
    return (struct part){.identity = identity_text(job), .width = rect_width(r), .height = rect_height(r),
                         .scale = scene->film_scale, .place = {r.x0, r.y0, scene->width, scene->height},
                         .planned = job->planned, .first = job->first, .end = job->end};
}

void part_free(struct part *p)
{
    free(p->identity);
    p->identity = NULL;
}

/* --- bytes that are checked on the way ---------------------------------------------------------------- */

struct stream {
    FILE *file;
    uint32_t crc;
    size_t used, filled; /* of the buffer */
    uint8_t byte[BUFFER];
};

static void flush(struct stream *s)
{
    s->crc = checksum_crc32(s->crc, s->byte, s->used);
    fwrite(s->byte, 1, s->used, s->file);
    s->used = 0;
}

static void put_digit(struct stream *s, int64_t digit)
{
    uint64_t rest = digit < 0 ? ~((uint64_t)digit << 1) : (uint64_t)digit << 1;
    for (; rest >= 128; rest >>= 7)
        s->byte[s->used++] = (uint8_t)(128 | (rest & 127));
    s->byte[s->used++] = (uint8_t)rest;
}

static void put_sum(struct stream *s, const struct exact_sum *sum)
{
    static const struct exact_sum NOTHING = {{0}, 0};
    if (s->used > BUFFER - LONGEST_SUM)
        flush(s);
    if (sum->top == 0 && memcmp(sum->digit, NOTHING.digit, sizeof sum->digit) == 0) {
        s->byte[s->used++] = EMPTY;
        return;
    }
    s->byte[s->used++] = (uint8_t)sum->top;
    for (int i = 0; i < EXACT_DIGITS; i++)
        put_digit(s, sum->digit[i]);
}

/* Fill the buffer up behind what is not used yet. */
static void refill(struct stream *s)
{
    s->crc = checksum_crc32(s->crc, s->byte, s->used);
    s->filled -= s->used;
    memmove(s->byte, s->byte + s->used, s->filled);
    s->filled += fread(s->byte + s->filled, 1, BUFFER - s->filled, s->file);
    s->used = 0;
}

/* The next byte of the buffer, or -1. */
static int get(struct stream *s) { return s->used < s->filled ? s->byte[s->used++] : -1; }

/* The digit that begins at `at`; returns where the next one does, or NULL if this one does not end before `end`. */
static const uint8_t *get_digit(const uint8_t *at, const uint8_t *end, int64_t *out)
{
    uint64_t value = 0;
    for (int shift = 0; shift < 64 && at < end; shift += 7) {
        uint8_t byte = *at++;
        if (shift == 63 && byte > 1)
            return NULL;
        value |= (uint64_t)(byte & 127) << shift;
        if (byte < 128) {
            int64_t half = (int64_t)(value >> 1);
            *out = value & 1 ? -1 - half : half;
            return at;
        }
    }
    return NULL;
}

static bool get_sum(struct stream *s, struct exact_sum *out)
{
    memset(out, 0, sizeof *out);
    if (s->filled - s->used < LONGEST_SUM)
        refill(s);
    int top = get(s);
    if (top == EMPTY)
        return true;
    out->top = top;
    const uint8_t *at = top >= 0 && top < EXACT_PLACES ? s->byte + s->used : NULL;
    for (int i = 0; at != NULL && i < EXACT_DIGITS; i++)
        at = get_digit(at, s->byte + s->filled, &out->digit[i]);
    if (at != NULL)
        s->used = (size_t)(at - s->byte);
    return at != NULL;
}

/* --- writing ----------------------------------------------------------------------------------------- */

/* The lines that must agree between parts of one picture; to be given to free(). */
static char *picture_text(const struct part *p)
{
    size_t room = strlen(p->identity) + 256;
    char *text = mem_alloc(room, 1);
    snprintf(text, room, "size %d %d\nfilm %d %d, window %d %d\nscale %.17g\nspp %ld\n%s", p->width, p->height,
             p->place.width, p->place.height, p->place.x, p->place.y, p->scale, p->planned, p->identity);
    return text;
}

/* All lines; to be given to free(). */
static char *header_text(const struct part *p)
{
    char *picture = picture_text(p);
    size_t room = strlen(picture) + 256;
    char *text = mem_alloc(room, 1);
    snprintf(text, room, "%ssamples %ld %ld\ndone %ld %" PRId64 "\nleft-out %ld\nhalves %d\n%s", MAGIC,
             p->first, p->end, p->done, p->passes, p->left_out, p->halves, picture);
    size_t n = strlen(text);
    snprintf(text + n, room - n, "check %08lx\n", (unsigned long)checksum_crc32(0, (const uint8_t *)text, n));
    free(picture);
    return text;
}

bool part_possible(const struct film *film, const char *path, struct error *err)
{
    return !film->learnt_short ||
           error_set(err, "%s: learning was cut short, so the samples do not go with those of other parts", path);
}

void part_write(struct file_output *file, const struct part *p, const struct film *film)
{
    struct part now = *p; /* its identity is borrowed */
    now.done = film->iterations;
    now.passes = film->passes;
    now.left_out = film->nonfinite;
    now.halves = film->half != NULL;
    char *text = header_text(&now);
    struct stream *s = mem_alloc(1, sizeof *s);
    s->file = file->stream;
    fwrite(text, 1, strlen(text), s->file);
    const struct film_block *block = &film->block;
    for (size_t i = 0, n = picture_of(p), m = samples_of(&now), k = splats_of(&now); i < sums_of(&now); i++) {
        struct exact_sum of_block = {{0}, 0};
        if (i >= m && i < k)
            exact_add(&of_block, (double)block->splat[i - m]);
        else if (i >= k && block->in[i - k])
            exact_add(&of_block, (double)block->iterations);
        put_sum(s, i < n ? &film->sum[i] : i < m ? &film->half[i - n] : &of_block);
    }
    flush(s);
    uint8_t end[4];
    bytes_of_bits(s->crc, end, 4, false);
    fwrite(end, 1, sizeof end, s->file);
    free(s);
    free(text);
}

/* --- reading ----------------------------------------------------------------------------------------- */

/* The lines up to the one that checks them, and this one, to be given to free(); NULL if there is none. */
static char *read_text(FILE *f)
{
    size_t used = 0, line = 0, capacity = 0;
    char *text = NULL;
    for (int c; used < MOST_TEXT && (c = getc(f)) != EOF && c != '\0';) {
        text = mem_grow(text, &capacity, used + 2, 1);
        text[used++] = (char)c;
        text[used] = '\0';
        if (c != '\n')
            continue;
        if (strncmp(text + line, "check ", 6) == 0)
            return text;
        line = used;
    }
    free(text);
    return NULL;
}

/* Can a part have these numbers? */
static bool possible(const struct part *p)
{
    const struct placement *at = &p->place;
    struct error ignored;
    return p->width > 0 && p->height > 0 && picture_size_ok((uint64_t)p->width, (uint64_t)p->height, &ignored) &&
           at->x >= 0 && at->y >= 0 && at->width > 0 && at->height > 0 && p->width <= at->width - at->x &&
           p->height <= at->height - at->y && p->scale >= 0 && p->scale <= NUMBER_MAX && p->first >= 0 &&
           p->end > p->first && p->end <= p->planned && p->done >= 0 && p->done <= p->end - p->first &&
           p->passes >= 0 && (p->passes == 0 || p->done < p->end - p->first) && p->left_out >= 0;
}

/* The text must be, byte for byte, what the program writes for the numbers that it reads in it: so no line can be
 * twice, missing, elsewhere, or read otherwise than it is compared. */
static bool read_numbers(const char *text, struct part *p)
{
    int begin = 0, halves = 0;
    sscanf(text + sizeof MAGIC - 1, "samples %ld %ld done %ld %" SCNd64 " left-out %ld halves %d size %d %d film %d "
           "%d, window %d %d scale %lf spp %ld %n", &p->first, &p->end, &p->done, &p->passes, &p->left_out, &halves,
           &p->width, &p->height, &p->place.width, &p->place.height, &p->place.x, &p->place.y, &p->scale, &p->planned,
           &begin);
    p->halves = halves != 0;
    const char *identity = text + sizeof MAGIC - 1 + begin, *check = identity;
    while (strncmp(check, "check ", 6) != 0)
        check = strchr(check, '\n') + 1;
    p->identity = mem_alloc((size_t)(check - identity) + 1, 1);
    memcpy(p->identity, identity, (size_t)(check - identity));
    char *again = header_text(p);
    bool ok = begin > 0 && possible(p) && strcmp(text, again) == 0;
    free(again);
    return ok;
}

static bool read_header(FILE *f, const char *path, struct part *out, struct error *err)
{
    char *text = read_text(f);
    bool part = text != NULL && strncmp(text, "asbdpt part ", 12) == 0;
    bool known = part && strncmp(text, MAGIC, sizeof MAGIC - 1) == 0;
    bool ok = known && read_numbers(text, out);
    free(text);
    if (!ok)
        part_free(out);
    return ok || error_set(err, "%s: %s", path, part && !known ? "the part has a format of another version" :
                                                "this is no part, or its beginning is damaged");
}

FILE *part_open(const char *path, struct part *out, struct error *err)
{
    memset(out, 0, sizeof *out);
    FILE *f = os_open_input(path);
    if (f == NULL) {
        error_set(err, "%s: cannot be opened: %s", path, strerror(errno));
        return NULL;
    }
    if (read_header(f, path, out, err)) {
        uint64_t size; /* a byte for each sum at least: before memory is taken for them */
        if (os_kind_of_stream(f, &size) != OS_FILE || size >= sums_of(out))
            return f;
        error_set(err, "%s: the part is damaged or cut off", path);
        part_free(out);
    }
    fclose(f);
    return NULL;
}

/* How many samples of the block under way a pixel has: all or none. */
static bool get_samples(const struct part *p, size_t pixel, double samples, struct film_block *block)
{
    double most = fmin((double)(p->end - p->first - p->done), 1 << 30);
    if (!(samples >= 1 && samples <= most))
        return samples == 0;
    block->iterations = (long)samples;
    block->in[pixel] = true;
    block->n_in++;
    return true;
}

/* Every sum, the right check behind them, and nothing more. */
static bool add_sums(struct stream *s, const struct part *p, struct film *film)
{
    for (size_t i = 0, n = picture_of(p), m = samples_of(p), k = splats_of(p); i < sums_of(p); i++) {
        struct exact_sum sum, *to = i < n ? &film->sum[i] : i < m && film->half != NULL ? &film->half[i - n] : NULL;
        if (!get_sum(s, &sum) || (to != NULL && !exact_join(to, &sum)))
            return false;
        if (i >= k && !get_samples(p, i - k, exact_value(&sum), &film->block))
            return false;
        if (i >= m && i < k)
            film->block.splat[i - m] = float_within(exact_value(&sum));
    }
    refill(s);
    uint32_t crc = s->crc, said = 0;
    for (int i = 0; i < 4; i++) {
        int byte = get(s);
        if (byte < 0)
            return false;
        said |= (uint32_t)byte << (8 * i);
    }
    return said == crc && get(s) < 0;
}

bool part_add(FILE *file, const char *path, const struct part *p, struct film *film, struct error *err)
{
    if (p->width != rect_width(film->rect) || p->height != rect_height(film->rect)) {
        fclose(file);
        return error_set(err, "%s: the part has another size than the film", path);
    }
    struct stream *s = mem_alloc(1, sizeof *s);
    s->file = file;
    bool ok = add_sums(s, p, film);
    free(s);
    fclose(file);
    film->iterations += p->done;
    film->passes = p->passes;
    film->nonfinite = p->left_out < LONG_MAX - film->nonfinite ? film->nonfinite + p->left_out : LONG_MAX;
    return ok || error_set(err, "%s: the part is damaged or cut off", path);
}

bool part_same(const struct part *p, const char *path, const struct part *wanted, struct error *err)
{
    char *text = picture_text(p), *other = picture_text(wanted);
    const char *a = text, *b = other;
    bool same = true;
    while (same && (*a != '\0' || *b != '\0')) {
        size_t n = strcspn(a, "\n"), m = strcspn(b, "\n");
        same = n == m && strncmp(a, b, n) == 0;
        if (!same)
            error_set(err, "%s: a part of another image: it has \"%.*s\", not \"%.*s\"", path, (int)n, a, (int)m, b);
        a += n + (a[n] == '\n');
        b += m + (b[m] == '\n');
    }
    free(text);
    free(other);
    return same;
}
