#include "trace/bvh/direction_order.h"

enum { DIGIT = 12, DIGITS = 2, VALUES = 1 << DIGIT };

void sp_direction_sort(sp_direction_entry *order[2], size_t count)
{
    uint32_t starts[DIGITS][VALUES] = {{0}};
    size_t steps_back = 0;
    for (size_t i = 1; i < count; i++)
        steps_back += order[0][i].key < order[0][i - 1].key;
    if (steps_back <= count / 16)
        return;
    for (size_t i = 0; i < count; i++)
        for (int digit = 0; digit < DIGITS; digit++)
            starts[digit][order[0][i].key >> digit * DIGIT & (VALUES - 1)]++;
    for (int digit = 0; digit < DIGITS; digit++) {
        uint32_t sum = 0;
        for (int value = 0; value < VALUES; value++) {
            uint32_t here = starts[digit][value];
            starts[digit][value] = sum;
            sum += here;
        }
        for (size_t i = 0; i < count; i++) {
            sp_direction_entry e = order[0][i];
            order[1][starts[digit][e.key >> digit * DIGIT & (VALUES - 1)]++] = e;
        }
        sp_direction_entry *swap = order[0];
        order[0] = order[1];
        order[1] = swap;
    }
}
