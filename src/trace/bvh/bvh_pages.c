#ifndef _DEFAULT_SOURCE
#define _DEFAULT_SOURCE /* madvise */
#endif
#include "trace/bvh/bvh_pages.h"

#include <stdint.h>
#include <stdlib.h>

#ifdef __linux__
#include <sys/mman.h>
#endif

enum { LINE = 64, PAGE = 1 << 21 };

void *sp_bvh_allocate(size_t count, size_t size)
{
    if (count > (SIZE_MAX - PAGE) / size)
        return NULL;
    size_t bytes = count * size, unit = bytes < 4 * (size_t)PAGE ? LINE : PAGE;
    bytes = (bytes + unit - 1) / unit * unit;
    void *room = aligned_alloc(unit, bytes ? bytes : unit);
#ifdef MADV_HUGEPAGE
    if (room && unit == PAGE)
        madvise(room, bytes, MADV_HUGEPAGE); /* whatever comes of it */
#endif
    return room;
}
