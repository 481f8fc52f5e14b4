/* A binary heap of 64-bit keys, the least on top. */
#ifndef SPRAYPLAN_MESH_HEAP_H
#define SPRAYPLAN_MESH_HEAP_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct {
    uint64_t *keys; /* the owner frees it */
    size_t count, capacity;
} sp_heap;

/* False when memory runs out. */
bool sp_heap_push(sp_heap *heap, uint64_t key);
/* The heap must hold something. */
uint64_t sp_heap_pop(sp_heap *heap);

#endif
