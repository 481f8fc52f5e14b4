/* glibc lets a program bring its own malloc: this one counts and hands on. */
#include "meter.h"

#if defined(__has_feature)
#define HAS_FEATURE(feature) __has_feature(feature)
#else
#define HAS_FEATURE(feature) 0
#endif

#if defined(__SANITIZE_ADDRESS__) || HAS_FEATURE(address_sanitizer)

void meter_start(void) {}

size_t meter_peak(void)
{
    return 0;
}

#else

#include <malloc.h>
#include <stdatomic.h>

void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *block, size_t size);
void __libc_free(void *block);

static atomic_llong held, peak;
static long long at_start;

static void count(long long bytes)
{
    long long now = atomic_fetch_add_explicit(&held, bytes, memory_order_relaxed) + bytes;
    if (now > atomic_load_explicit(&peak, memory_order_relaxed))
        atomic_store_explicit(&peak, now, memory_order_relaxed);
}

static long long size_of(void *block)
{
    return block ? (long long)malloc_usable_size(block) : 0;
}

void *malloc(size_t size)
{
    void *block = __libc_malloc(size);
    count(size_of(block));
    return block;
}

void *calloc(size_t items, size_t size)
{
    void *block = __libc_calloc(items, size);
    count(size_of(block));
    return block;
}

/* Counted as if both blocks were held for a moment, which they may be. */
void *realloc(void *block, size_t size)
{
    long long before = size_of(block);
    void *moved = __libc_realloc(block, size);
    if (moved || size == 0) {
        count(size_of(moved));
        count(-before);
    }
    return moved;
}

void free(void *block)
{
    count(-size_of(block));
    __libc_free(block);
}

void meter_start(void)
{
    at_start = atomic_load(&held);
    atomic_store(&peak, at_start);
}

size_t meter_peak(void)
{
    return (size_t)(atomic_load(&peak) - at_start);
}

#endif
