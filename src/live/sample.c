/* One patch of each square of stride by stride pixels of a chart, on each side, for a quick look. */
#include "live/state.h"

#include <stdlib.h>

typedef struct {
    uint64_t block, chart; /* of the block's place and side; charts may share a block */
    uint32_t patch;
} placed;

static int by_block(const void *left, const void *right)
{
    const placed *a = left, *b = right;
    if (a->block != b->block)
        return a->block < b->block ? -1 : 1;
    if (a->chart != b->chart)
        return a->chart < b->chart ? -1 : 1;
    return (a->patch > b->patch) - (a->patch < b->patch);
}

static placed place_of(const sp_evaluator *evaluator, uint32_t patch, unsigned stride)
{
    const sp_atlas *atlas = sp_evaluator_atlas(evaluator);
    const sp_patches *patches = sp_evaluator_patches(evaluator);
    sp_texel_place at = sp_atlas_place(atlas, patches->texel[patch]);
    uint64_t across = atlas->page_edge / stride + 1;
    uint64_t block = ((uint64_t)at.page * across + at.y / stride) * across + at.x / stride;
    return (placed){2 * block + (patches->side[patch] == SP_SIDE_BACK), at.chart, patch};
}

/* The middle one of each block stands for all. */
static void choose(const placed *all, size_t count, sp_live_sample *sample)
{
    for (size_t i = 0, end; i < count; i = end) {
        for (end = i + 1; end < count && all[end].block == all[i].block && all[end].chart == all[i].chart;)
            end++;
        uint32_t middle = all[i + (end - i) / 2].patch;
        sample->among[middle] = true;
        for (size_t k = i; k < end; k++)
            sample->standing[all[k].patch] = middle;
    }
}

void sp_live_free_sample(sp_live_sample *sample)
{
    free(sample->among);
    free(sample->standing);
    *sample = (sp_live_sample){0};
}

bool sp_live_take_sample(sp_live *live, unsigned stride)
{
    size_t count = sp_evaluator_patches(live->evaluator)->count;
    if (live->sample.stride == stride)
        return true;
    sp_live_free_sample(&live->sample);
    placed *all = malloc((count + 1) * sizeof *all);
    live->sample.among = calloc(count + 1, sizeof *live->sample.among);
    live->sample.standing = malloc((count + 1) * sizeof *live->sample.standing);
    bool done = all && live->sample.among && live->sample.standing;
    for (uint32_t i = 0; done && i < count; i++)
        all[i] = place_of(live->evaluator, i, stride);
    if (done) {
        qsort(all, count, sizeof *all, by_block);
        choose(all, count, &live->sample);
        live->sample.stride = stride;
    }
    free(all);
    if (!done)
        sp_live_free_sample(&live->sample);
    return done || sp_fail_memory(&live->error);
}
