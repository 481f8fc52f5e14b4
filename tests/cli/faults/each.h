/* One attempt again and again, each of its allocations failing in turn. */
#ifndef CLI_FAULTS_EACH_H
#define CLI_FAULTS_EACH_H

#include <sprayplan/error.h>

#include "faults.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#define FNV_BASIS 14695981039346656037u
#define FNV_PRIME 1099511628211u

static inline uint64_t hash(uint64_t before, const void *bytes, size_t size)
{
    for (size_t i = 0; i < size; i++)
        before = (before ^ ((const unsigned char *)bytes)[i]) * FNV_PRIME;
    return before;
}

/* What is attempted; *digest tells its answer. */
typedef bool attempt(uint64_t *digest, sp_error *error);

/* Every `step`-th fails. Returns how many allocations there were. */
static inline long fail_each(const char *name, attempt *attempted, long step)
{
    uint64_t expected = FNV_BASIS;
    sp_error error = {0};
    if (!attempted(&expected, &error))
        fail_msg("%s: %s", name, error.message);
    for (long n = 1;; n += step) {
        uint64_t digest = FNV_BASIS;
        error = (sp_error){0};
        long before = faults->allocations;
        faults->failing_allocation = before + n;
        bool good = attempted(&digest, &error), failed = faults->allocations >= faults->failing_allocation;
        faults->failing_allocation = 0;
        if (good ? digest != expected : error.kind != SP_ERROR_MEMORY)
            fail_msg("%s, allocation %ld fails: %s", name, n, good ? "the answer is another" : error.message);
        if (!failed)
            return faults->allocations - before;
    }
}

#endif
