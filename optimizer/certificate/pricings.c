#include "certificate/pricings.h"

#include "mesh/grow.h"

#include <assert.h>
#include <math.h>

bool sp_pricings_note(sp_pricings *pricings, double water, double bound)
{
    size_t at = pricings->count;
    while (at > 0 && pricings->items[at - 1].water >= water)
        at--;
    if (at < pricings->count && pricings->items[at].water <= water) {
        pricings->items[at].bound = fmin(pricings->items[at].bound, bound);
        return true;
    }
    if (!sp_grow(&pricings->items, &pricings->capacity, pricings->count + 1, sizeof *pricings->items))
        return false;
    memmove(&pricings->items[at + 1], &pricings->items[at], (pricings->count - at) * sizeof *pricings->items);
    pricings->items[at] = (sp_pricing){water, bound};
    pricings->count++;
    return true;
}

void sp_pricings_free(sp_pricings *pricings)
{
    free(pricings->items);
    *pricings = (sp_pricings){0};
}

double sp_pricings_chord(const sp_pricings *pricings, double water)
{
    size_t next = 0;
    assert(pricings->count && pricings->items[0].water <= water);
    while (next < pricings->count && pricings->items[next].water <= water)
        next++;
    sp_pricing left = pricings->items[next - 1];
    if (next == pricings->count)
        return left.bound;
    sp_pricing right = pricings->items[next];
    return left.bound + (right.bound - left.bound) * (water - left.water) / (right.water - left.water);
}
