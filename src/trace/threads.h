/* Threads, where the build has any: all in which the library and its build for a page differ. */
#ifndef SPRAYPLAN_TRACE_THREADS_H
#define SPRAYPLAN_TRACE_THREADS_H

#ifdef _OPENMP
#include <omp.h>
#else
static inline int omp_get_max_threads(void)
{
    return 1;
}
static inline int omp_get_num_threads(void)
{
    return 1;
}
static inline int omp_get_thread_num(void)
{
    return 0;
}
static inline int omp_in_parallel(void)
{
    return 0;
}
#endif

#endif
