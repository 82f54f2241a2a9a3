/* exr_pack.c: the compressions of OpenEXR's blocks but PIZ, see exr.h. [OpenEXR]
 *
 * RLE, ZIPS and ZIP first make similar bytes equal: the even bytes of the block go before the odd ones, so that the
 * high bytes of numbers stand together, and each byte is replaced by its difference from the one before, plus 128. Then
 * they pack runs, or deflate. */
#include <string.h>

#include "image/exr.h"
#include "image/zlib.h"

/* From in[n], which is destroyed, to out[n]. */
static void undo_differences(uint8_t *in, size_t n, uint8_t *out)
{
    for (size_t i = 1; i < n; i++)
        in[i] = (uint8_t)(in[i - 1] + in[i] - 128);
    for (size_t i = 0; i < n; i++)
        out[i] = in[i / 2 + (i % 2 != 0 ? (n + 1) / 2 : 0)];
}

static void make_differences(const uint8_t *in, size_t n, uint8_t *out)
{
    for (size_t i = 0; i < n; i++)
        out[i / 2 + (i % 2 != 0 ? (n + 1) / 2 : 0)] = in[i];
    for (size_t i = n; i-- > 1;)
        out[i] = (uint8_t)(out[i] - out[i - 1] + 128);
}

/* Runs: a count 0..127 and a byte that occurs once more than that, or 256 minus a count of bytes that follow. */
static bool undo_runs(const uint8_t *in, size_t n, uint8_t *out, size_t size)
{
    size_t at = 0, done = 0;
    while (at < n) {
        unsigned head = in[at++];
        bool same = head < 128;
        size_t count = same ? head + 1 : 256 - head, stored = same ? 1 : count;
        if (stored > n - at || count > size - done)
            return false;
        if (same)
            memset(out + done, in[at], count);
        else
            memcpy(out + done, in + at, count);
        at += stored;
        done += count;
    }
    return done == size;
}

bool exr_unpack(const struct exr *e, const uint8_t *in, size_t n, size_t width, size_t height, uint8_t *scratch,
                uint8_t *out, size_t size)
{
    bool ok = false;
    switch (e->compression) {
    case EXR_RLE: ok = undo_runs(in, n, scratch, size); break;
    case EXR_ZIPS:
    case EXR_ZIP: ok = inflate_zlib(in, n, scratch, size, NULL); break;
    case EXR_PIZ: return piz_unpack(e, in, n, width, height, out, size);
    case EXR_NONE:
    case EXR_READ: break;
    }
    if (ok)
        undo_differences(scratch, size, out);
    return ok;
}

uint8_t *exr_pack_zip(const uint8_t *in, size_t n, uint8_t *scratch, size_t *size)
{
    make_differences(in, n, scratch);
    return deflate_zlib(scratch, n, size);
}
