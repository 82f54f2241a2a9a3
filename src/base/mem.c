/* mem.c: see mem.h. */
#include "base/mem.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void die(size_t count, size_t size)
{
    fprintf(stderr, "asbdpt: out of memory (%lu x %lu bytes wanted); use a smaller scene or image\n",
            (unsigned long)count, (unsigned long)size);
    exit(1);
}

void *mem_alloc(size_t count, size_t size)
{
    void *p = calloc(count > 0 ? count : 1, size > 0 ? size : 1); /* which checks for overflow */
    if (p == NULL)
        die(count, size);
    return p;
}

void *mem_grow(void *array, size_t *capacity, size_t need, size_t size)
{
    if (need <= *capacity)
        return array;
    size_t larger = *capacity < 16 ? 16 : *capacity;
    while (larger < need && larger <= SIZE_MAX / 2)
        larger *= 2;
    void *p = larger >= need && larger <= SIZE_MAX / size ? realloc(array, larger * size) : NULL;
    if (p == NULL)
        die(need, size);
    *capacity = larger;
    return p;
}

void *mem_append(void *array, size_t n, size_t size)
{
    size_t capacity = 0;
    return (n & (n - 1)) == 0 ? mem_grow(array, &capacity, n + 1, size) : array;
}

char *mem_copy_text(const char *text)
{
    size_t size = strlen(text) + 1;
    return memcpy(mem_alloc(size, 1), text, size);
}

/* --- arena ------------------------------------------------------------------------------------------- */

union most_aligned { /* C99 has no max_align_t */
    long double number;
    void *pointer;
    long long integer;
};

struct arena_block {
    struct arena_block *next;
    size_t used, size;          /* bytes of data[] */
    union most_aligned data[1]; /* really `size` bytes */
};

enum { BLOCK_BYTES = 16 * 1024, HEADER_BYTES = offsetof(struct arena_block, data) };

static struct arena_block *new_block(size_t size)
{
    size_t room = size > BLOCK_BYTES ? size : BLOCK_BYTES;
    struct arena_block *b = mem_alloc(1, HEADER_BYTES + room);
    b->size = room;
    return b;
}

void *arena_alloc(struct arena *a, size_t size)
{
    const size_t align = sizeof(union most_aligned);
    size = (size + align - 1) / align * align;
    if (a->current == NULL)
        a->first = a->current = new_block(size);
    while (a->current->used + size > a->current->size) {
        if (a->current->next == NULL)
            a->current->next = new_block(size);
        a->current = a->current->next;
    }
    void *p = (char *)a->current->data + a->current->used;
    a->current->used += size;
    return p;
}

char *arena_text(struct arena *a, const char *text) { return strcpy(arena_alloc(a, strlen(text) + 1), text); }

void arena_reset(struct arena *a)
{
    for (struct arena_block *b = a->first; b != NULL; b = b->next)
        b->used = 0;
    a->current = a->first;
}

void arena_free(struct arena *a)
{
    for (struct arena_block *b = a->first; b != NULL;) {
        struct arena_block *next = b->next;
        free(b);
        b = next;
    }
    a->first = a->current = NULL;
}
