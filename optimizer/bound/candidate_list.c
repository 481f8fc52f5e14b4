#include "bound/candidate_list.h"

#include <assert.h>
#include <stdlib.h>

void sp_candidate_list_free(sp_candidate_list *list)
{
    free(list->kind_start);
    free(list->weight);
    free(list->run_start);
    free(list->run_port);
    *list = (sp_candidate_list){0};
}

/* The last of starts[0 .. count] that is not beyond the position. */
static size_t part_of(const size_t *starts, size_t count, size_t position)
{
    size_t low = 0, high = count;
    assert(count && starts[0] <= position && position < starts[count]);
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        if (starts[middle] <= position)
            low = middle;
        else
            high = middle;
    }
    return low;
}

size_t sp_candidate_list_kind(const sp_candidate_list *list, size_t position)
{
    return part_of(list->kind_start, list->kind_count, position);
}

size_t sp_candidate_list_run(const sp_candidate_list *list, size_t position)
{
    return part_of(list->run_start, list->run_count, position);
}
