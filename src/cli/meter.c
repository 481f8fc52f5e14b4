/* Counts the heap that the program's code and the library's hold: the linker leads their calls here (--wrap). What
 * shared libraries allocate for themselves is not seen. */
#include "cli.h"

#include <malloc.h>
#include <stdatomic.h>

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *block, size_t size);
void __real_free(void *block);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *block, size_t size);
void __wrap_free(void *block);

/* The program's own state: allocations come from everywhere. */
static atomic_llong held, peak;
static long long at_start;

static void count(long long bytes)
{
    long long now = atomic_fetch_add_explicit(&held, bytes, memory_order_relaxed) + bytes;
    long long most = atomic_load_explicit(&peak, memory_order_relaxed);
    while (now > most &&
           !atomic_compare_exchange_weak_explicit(&peak, &most, now, memory_order_relaxed, memory_order_relaxed))
        continue;
}

static long long size_of(void *block)
{
    return block ? (long long)malloc_usable_size(block) : 0;
}

void *__wrap_malloc(size_t size)
{
    void *block = __real_malloc(size);
    count(size_of(block));
    return block;
}

void *__wrap_calloc(size_t items, size_t size)
{
    void *block = __real_calloc(items, size);
    count(size_of(block));
    return block;
}

/* Counted as if both blocks were held for a moment, which they may be. */
void *__wrap_realloc(void *block, size_t size)
{
    long long before = size_of(block);
    void *moved = __real_realloc(block, size);
    if (moved || size == 0) {
        count(size_of(moved));
        count(-before);
    }
    return moved;
}

void __wrap_free(void *block)
{
    count(-size_of(block));
    __real_free(block);
}

void cli_meter_start(void)
{
    at_start = atomic_load(&held);
    atomic_store(&peak, at_start);
}

size_t cli_meter_peak(void)
{
    return (size_t)(atomic_load(&peak) - at_start);
}
