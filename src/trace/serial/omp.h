/* What is called of OpenMP where a build has none of it, as that for a page: one thread, in no team. */
#ifndef SPRAYPLAN_SERIAL_OMP_H
#define SPRAYPLAN_SERIAL_OMP_H

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
static inline int omp_get_level(void)
{
    return 0;
}
static inline int omp_get_ancestor_thread_num(int level)
{
    return level == 0 ? 0 : -1;
}

#endif
