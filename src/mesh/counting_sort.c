#include "mesh/counting_sort.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

bool sp_counting_sort(uint32_t *order, size_t count, const uint32_t *keys, size_t key_count, sp_error *error)
{
    size_t *start = calloc(key_count + 1, sizeof *start);
    uint32_t *sorted = malloc((count + 1) * sizeof *sorted);
    bool good = start && sorted;
    if (good) {
        for (size_t i = 0; i < count; i++) {
            assert(keys[i] < key_count);
            start[keys[i] + 1]++;
        }
        for (size_t key = 0; key < key_count; key++)
            start[key + 1] += start[key];
        for (size_t i = 0; i < count; i++)
            sorted[start[keys[order[i]]]++] = order[i];
        memcpy(order, sorted, count * sizeof *order);
    } else {
        sp_fail_memory(error);
    }
    free(start);
    free(sorted);
    return good;
}
