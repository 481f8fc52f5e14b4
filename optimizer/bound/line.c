#include "bound/line.h"

#include <stdlib.h>

void sp_line_free(sp_line *line)
{
    free(line->kind_start);
    free(line->weight);
    free(line->run_start);
    free(line->run_port);
    *line = (sp_line){0};
}

/* The last of starts[0 .. count] that is not beyond the position. */
static size_t part_of(const size_t *starts, size_t count, size_t position)
{
    size_t low = 0, high = count;
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        if (starts[middle] <= position)
            low = middle;
        else
            high = middle;
    }
    return low;
}

size_t sp_line_kind(const sp_line *line, size_t position)
{
    return part_of(line->kind_start, line->kind_count, position);
}

size_t sp_line_run(const sp_line *line, size_t position)
{
    return part_of(line->run_start, line->run_count, position);
}
