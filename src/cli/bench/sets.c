#include "sets.h"

#include <stdlib.h>
#include <string.h>

static size_t size_of(bench_size size, size_t count, size_t triangles)
{
    size_t least = count < 1024 ? count : 1024, fewer = count;
    if (size == SIZE_TREE)
        fewer = count / 16;
    if (size == SIZE_LOOP) {
        fewer = (size_t)1e7 / triangles;
        least = count < 16 ? count : 16;
    }
    return fewer > count ? count : fewer > least ? fewer : least;
}

/* Sorts three times, for the median. */
static bool sort(bench_set *set)
{
    sp_ray *unsorted = malloc((set->count + 1) * sizeof *unsorted);
    uint32_t *order = malloc((set->count + 1) * sizeof *order), *before = set->order;
    double seconds[3];
    bool good = unsorted && order;
    if (good)
        memcpy(unsorted, set->rays, set->count * sizeof *unsorted);
    for (int i = 0; good && i < 3; i++) {
        double start = sp_now();
        good = bench_sort(unsorted, set->count, set->rays, order);
        seconds[i] = sp_now() - start;
    }
    if (good) {
        set->sort_seconds = bench_median(seconds, 3);
        for (size_t i = 0; i < set->count; i++)
            order[i] = before[order[i]];
        set->order = order;
        order = before;
    }
    free(order);
    free(unsorted);
    return good;
}

static bool create(bench_set *set, const bench_stage *stage, const sp_ray *rays, size_t all, const bench_case *of)
{
    set->rays = malloc((set->count + 1) * sizeof *set->rays);
    set->order = malloc((set->count + 1) * sizeof *set->order);
    bool bent = of->trajectory == TRAJECTORY_PARABOLA;
    if (bent)
        set->span = malloc((set->count + 1) * sizeof *set->span);
    if (!set->rays || !set->order || (bent && !set->span))
        return false;
    for (size_t i = 0; i < set->count; i++) {
        set->order[i] = (uint32_t)((double)i * (double)all / (double)set->count);
        set->rays[i] = rays[set->order[i]];
    }
    if (of->sorted && !sort(set))
        return false;
    for (size_t i = 0; bent && i < set->count; i++)
        bench_ray_span(stage, &set->rays[i], of->gravity, set->span[i]);
    return true;
}

bool bench_case_create(bench_case *made, const bench_stage *stage, const sp_ray *rays, size_t count, bench_mode mode,
                       bench_trajectory trajectory, bool sorted)
{
    *made =
        (bench_case){.mode = mode, .trajectory = trajectory, .sorted = sorted, .gravity = bench_gravity(trajectory)};
    for (int size = 0; size < SIZES; size++) {
        made->sets[size].count = size_of(size, count, stage->mesh->triangle_count);
        if (!create(&made->sets[size], stage, rays, count, made))
            return false;
    }
    return true;
}

void bench_case_clear(bench_case *made)
{
    for (int size = 0; size < SIZES; size++) {
        free(made->sets[size].rays);
        free(made->sets[size].order);
        free(made->sets[size].span);
    }
}
