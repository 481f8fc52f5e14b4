/* Memory for much that is read and written all over. */
#ifndef SPRAYPLAN_TRACE_BVH_PAGES_H
#define SPRAYPLAN_TRACE_BVH_PAGES_H

#include <stddef.h>

/* Room for so many items of that size, on lines of the cache, and in large pages where it is large and the system has
 * them: fewer faults while it is built, fewer misses of addresses while it is walked. NULL when memory runs out; for
 * free(). */
void *sp_bvh_allocate(size_t count, size_t size);

#endif
