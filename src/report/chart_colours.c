/* Colours for charts, so that neighbours are told apart. */
#include "layers.h"

#include <stdlib.h>
#include <string.h>

/* Light enough for names and edges drawn over them, and told apart in pairs by any eye in brightness too. */
const uint8_t sp_chart_palette[SP_CHART_COLOURS][3] = {
    {31, 119, 180}, {255, 187, 120}, {44, 160, 44},   {255, 152, 150}, {148, 103, 189}, {219, 219, 141},
    {140, 86, 75},  {158, 218, 229}, {227, 119, 194}, {152, 223, 138}, {188, 140, 34},  {197, 176, 213},
};

typedef struct {
    uint32_t chart, before; /* which is lower */
} meeting;

static int by_chart(const void *left, const void *right)
{
    const meeting *a = left, *b = right;
    if (a->chart != b->chart)
        return a->chart < b->chart ? -1 : 1;
    return (a->before > b->before) - (a->before < b->before);
}

/* Every pair of charts, as often as texels of theirs meet. */
static meeting *list_meetings(const sp_atlas *atlas, size_t *count, sp_error *error)
{
    meeting *list = malloc((atlas->seam_count + 1) * sizeof *list);
    *count = 0;
    for (size_t i = 0; list && i < atlas->seam_count; ++i) {
        uint32_t one = atlas->chart[atlas->seams[i].edge / 3], other = atlas->chart[atlas->seams[i].across / 3];
        if (one > other)
            list[(*count)++] = (meeting){one, other};
    }
    if (list)
        qsort(list, *count, sizeof *list, by_chart);
    return list ? list : sp_fail_memory(error);
}

/* From `first` on, so that not the same few are taken everywhere; that one where all are. */
static uint8_t free_colour(const bool taken[SP_CHART_COLOURS], uint32_t first)
{
    for (uint32_t k = 0; k < SP_CHART_COLOURS; ++k)
        if (!taken[(first + k) % SP_CHART_COLOURS])
            return (uint8_t)((first + k) % SP_CHART_COLOURS);
    return (uint8_t)(first % SP_CHART_COLOURS);
}

uint8_t *sp_chart_colours(const sp_atlas *atlas, sp_error *error)
{
    size_t count, next = 0;
    meeting *list = list_meetings(atlas, &count, error);
    uint8_t *colour = list ? malloc(atlas->chart_count + 1) : NULL;
    if (list && !colour)
        sp_fail_memory(error);
    for (uint32_t c = 0; colour && c < atlas->chart_count; ++c) {
        bool taken[SP_CHART_COLOURS] = {false};
        for (; next < count && list[next].chart == c; ++next)
            taken[colour[list[next].before]] = true;
        colour[c] = free_colour(taken, c);
    }
    free(list);
    return colour;
}
