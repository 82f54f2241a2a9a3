/* mem.h: checked allocation, growing arrays, and the arena that holds what a path needs.
 *
 * Running out of memory is handled in one place: one line on stderr and exit status 1. Callers therefore never test for
 * NULL. Sizes that come from a file must be checked against the file's length before they reach this module. */
#ifndef ASBDPT_MEM_H
#define ASBDPT_MEM_H

#include <stddef.h>
#include <stdint.h>

/* mem_alloc: room for `count` objects of `size` bytes, filled with zeros, to be given to free(). */
void *mem_alloc(size_t count, size_t size);

/* mem_grow: make sure a growing array can hold at least `need` objects; capacity doubles.
 *   array     the block so far (may be NULL), owned by the caller; invalid after the call
 *   capacity  in-out, objects the block can hold
 * Returns the (possibly moved) block. New objects are not cleared.
 * mem_append: the same for one object more of n, for arrays that only ever grow by one: their room is kept nowhere, it
 * is a power of two, doubled when n reaches it. */
void *mem_grow(void *array, size_t *capacity, size_t need, size_t size);
void *mem_append(void *array, size_t n, size_t size);

/* mem_copy_text: a heap copy of a string, to be given to free(). */
char *mem_copy_text(const char *text);

/* Bytes in memory. */
struct bytes {
    uint8_t *data; /* [n], owned */
    size_t n, capacity;
};

/* An arena hands out memory that is all given back at once. Blocks are kept after arena_reset, so a steady
 * state allocates nothing. One owner, one thread. */
struct arena_block;
struct arena {
    struct arena_block *first;   /* chain of blocks in the order they are filled */
    struct arena_block *current; /* block being filled, NULL before the first allocation */
};

/* arena_alloc: `size` bytes, aligned for any type, not cleared. Valid until arena_reset or arena_free. arena_text: a
 * copy of a string. arena_reset: give everything back to the arena (keeps its blocks), arena_free: to the system; the
 * arena is usable again. */
void *arena_alloc(struct arena *a, size_t size);
char *arena_text(struct arena *a, const char *text);
void arena_reset(struct arena *a);
void arena_free(struct arena *a);

#endif
