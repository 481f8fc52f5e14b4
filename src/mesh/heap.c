#include "mesh/heap.h"

#include <assert.h>
#include <stdlib.h>

bool sp_heap_push(sp_heap *heap, uint64_t key)
{
    if (heap->count == heap->capacity) {
        size_t capacity = heap->capacity ? 2 * heap->capacity : 1024;
        uint64_t *keys = realloc(heap->keys, capacity * sizeof *keys);
        if (!keys)
            return false;
        heap->keys = keys;
        heap->capacity = capacity;
    }
    size_t at = heap->count++;
    for (; at > 0 && key < heap->keys[(at - 1) / 2]; at = (at - 1) / 2)
        heap->keys[at] = heap->keys[(at - 1) / 2];
    heap->keys[at] = key;
    return true;
}

uint64_t sp_heap_pop(sp_heap *heap)
{
    assert(heap->count > 0 && heap->count <= heap->capacity);
    uint64_t top = heap->keys[0], last = heap->keys[--heap->count];
    size_t at = 0;
    for (size_t child; (child = 2 * at + 1) < heap->count; at = child) {
        if (child + 1 < heap->count && heap->keys[child + 1] < heap->keys[child])
            child++;
        if (heap->keys[child] >= last)
            break;
        heap->keys[at] = heap->keys[child];
    }
    heap->keys[at] = last;
    assert(top <= heap->keys[0]);
    return top;
}
