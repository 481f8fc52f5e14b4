#include "certificate/proved_waters.h"

#include "mesh/grow.h"

#include <assert.h>
#include <math.h>

bool sp_proved_waters_note(sp_proved_waters *waters, double water, double bound)
{
    size_t at = waters->count;
    while (at > 0 && waters->items[at - 1].water >= water)
        at--;
    if (at < waters->count && waters->items[at].water <= water) {
        waters->items[at].bound = fmin(waters->items[at].bound, bound);
        return true;
    }
    if (!sp_grow(&waters->items, &waters->capacity, waters->count + 1, sizeof *waters->items))
        return false;
    memmove(&waters->items[at + 1], &waters->items[at], (waters->count - at) * sizeof *waters->items);
    waters->items[at] = (sp_proved_water){water, bound};
    waters->count++;
    return true;
}

void sp_proved_waters_free(sp_proved_waters *waters)
{
    free(waters->items);
    *waters = (sp_proved_waters){0};
}

double sp_proved_waters_chord(const sp_proved_waters *waters, double water)
{
    size_t next = 0;
    assert(waters->count && waters->items[0].water <= water);
    while (next < waters->count && waters->items[next].water <= water)
        next++;
    sp_proved_water left = waters->items[next - 1];
    if (next == waters->count)
        return left.bound;
    sp_proved_water right = waters->items[next];
    return left.bound + (right.bound - left.bound) * (water - left.water) / (right.water - left.water);
}
