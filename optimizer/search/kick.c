#include "search/kick.h"

#include <stdlib.h>
#include <string.h>

#define POSES_MOST 256    /* poses that a kick looks at: few enough to be quick, and different each time */
#define GAIN_LEAST 1e-4   /* of the area, for one more nozzle */
#define TRIES 8           /* to find a dry patch that some pose reaches */
#define SECOND_SHARE 0.35 /* of the kicks, that move two nozzles */

/* SplitMix64: Steele, Lea and Flood, Fast splittable pseudorandom number generators, OOPSLA 2014. */
static uint64_t next(uint64_t *state)
{
    uint64_t z = *state += 0x9e3779b97f4a7c15;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
}

static double uniform(uint64_t *state)
{
    return (double)(next(state) >> 11) * 0x1p-53;
}

/* Some of the pool's poses, in its order, evenly at random. */
static bool draw_poses(const sp_pool *pool, uint64_t *state, sp_pool *drawn, sp_error *error)
{
    size_t wanted = pool->count < POSES_MOST ? pool->count : POSES_MOST;
    for (size_t i = 0; i < pool->count && drawn->count < wanted; i++)
        if (uniform(state) * (double)(pool->count - i) < (double)(wanted - drawn->count) &&
            !sp_pool_add(drawn, pool->items[i], error))
            return false;
    return true;
}

/* A dry patch, chosen by area; patch_count where there is none. */
static size_t dry_patch(const sp_search *search, const sp_draft *draft, uint64_t *state)
{
    double dry = 0;
    size_t chosen = search->patch_count;
    for (size_t p = 0; p < search->patch_count; p++)
        dry += (double)(search->area[p] * (1 - sp_covered(draft->wet[p], draft->dry[p])));
    double left = uniform(state) * dry;
    for (size_t p = 0; p < search->patch_count && left >= 0; p++)
        if (sp_covered(draft->wet[p], draft->dry[p]) < 1) {
            chosen = p;
            left -= (double)(search->area[p] * (1 - sp_covered(draft->wet[p], draft->dry[p])));
        }
    return chosen;
}

/* Adds the pose that gains most where one dry patch, chosen at random, counts as much as all the rest. */
static bool add_at_random(const sp_search *search, const sp_pool *poses, double budget, uint64_t *state,
                          sp_bench *bench, sp_draft *draft, sp_error *error)
{
    sp_search drawn = *search;
    drawn.area = malloc(search->patch_count * sizeof *drawn.area);
    if (!drawn.area)
        return sp_fail_memory(error);
    memcpy(drawn.area, search->area, search->patch_count * sizeof *drawn.area);
    float all = (float)sp_evaluator_patches(search->coarse)->total_area;
    bool done = true;
    for (int i = 0; i < TRIES; i++) {
        size_t patch = dry_patch(search, draft, state);
        sp_pose pose;
        if (patch == search->patch_count)
            break;
        drawn.area[patch] += all;
        double gain = sp_pool_best(&drawn, poses, draft, 0, budget, bench, &pose);
        drawn.area[patch] = search->area[patch];
        if (gain > 0 && (gain >= (double)all || i == TRIES - 1)) {
            done = sp_draft_add_pose(search, draft, pose, error);
            break;
        }
    }
    free(drawn.area);
    return done;
}

static bool fill(const sp_search *search, const sp_pool *poses, double budget, size_t most, sp_bench *bench,
                 sp_draft *draft, sp_error *error)
{
    double least = GAIN_LEAST * sp_evaluator_patches(search->coarse)->total_area;
    sp_pose pose;
    while (draft->count < most && sp_pool_best(search, poses, draft, 0.5, budget, bench, &pose) > least)
        if (!sp_draft_add_pose(search, draft, pose, error))
            return false;
    return true;
}

bool sp_kick(const sp_search *search, const sp_pool *pool, double budget, uint64_t seed, sp_draft *draft,
             sp_error *error)
{
    uint64_t state = seed;
    sp_pool poses = {0};
    size_t before = draft->count, moved = 1 + (uniform(&state) < SECOND_SHARE);
    sp_bench bench = {0};
    bool done = draw_poses(pool, &state, &poses, error) && sp_bench_create(search, &poses, &bench, error);
    for (size_t i = 0; i < moved && draft->count; i++)
        sp_draft_remove(search, draft, (size_t)(uniform(&state) * (double)draft->count));
    for (size_t i = 0; done && i < moved && draft->count < before; i++)
        done = add_at_random(search, &poses, budget, &state, &bench, draft, error);
    done = done && fill(search, &poses, budget, before + 1, &bench, draft, error);
    sp_pool_free(&poses);
    sp_bench_free(&bench);
    return done;
}
