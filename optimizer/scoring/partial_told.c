#include "scoring/partial_told.h"

#include <stdlib.h>
#include <string.h>

static const sp_nozzle_type *type_of(const sp_search *search, uint64_t variant)
{
    return variant < search->candidates->variant_count ? search->candidates->variants[variant].type : NULL;
}

static uint64_t variant_of(const sp_search *search, const sp_nozzle_type *type)
{
    uint64_t variant = 0;
    while (variant < search->candidates->variant_count && search->candidates->variants[variant].type != type)
        variant++;
    return variant;
}

void sp_tell_nozzle(const sp_search *search, const sp_nozzle *nozzle, sp_told *told)
{
    uint64_t variant = variant_of(search, nozzle->type);
    sp_tell(told, &variant, sizeof variant);
    sp_tell(told, nozzle, sizeof *nozzle);
}

bool sp_hear_nozzle(const sp_search *search, sp_heard *heard, size_t rank, sp_nozzle *nozzle)
{
    uint64_t variant;
    if (!sp_hear(heard, rank, &variant, sizeof variant) || !sp_hear(heard, rank, nozzle, sizeof *nozzle))
        return false;
    nozzle->type = type_of(search, variant);
    return true;
}

/* Most patches get nothing: only others are told, with their numbers. */
static void tell_field(const float *field, size_t count, sp_told *told)
{
    static const float nothing;
    uint32_t some = 0;
    for (size_t i = 0; i < count; i++)
        some += memcmp(&field[i], &nothing, sizeof nothing) != 0;
    sp_tell(told, &some, sizeof some);
    for (uint32_t i = 0; i < count; i++)
        if (memcmp(&field[i], &nothing, sizeof nothing) != 0) {
            sp_tell(told, &i, sizeof i);
            sp_tell(told, &field[i], sizeof field[i]);
        }
}

static bool hear_field(sp_heard *heard, size_t rank, float *field, size_t count)
{
    uint32_t some, at;
    memset(field, 0, count * sizeof *field);
    bool there = sp_hear(heard, rank, &some, sizeof some);
    for (uint32_t i = 0; there && i < some; i++)
        there = sp_hear(heard, rank, &at, sizeof at) && at < count && sp_hear(heard, rank, &field[at], sizeof *field);
    return there;
}

void sp_tell_partial(const sp_search *search, const sp_partial *partial, sp_told *told)
{
    uint64_t count = partial->count;
    sp_tell(told, &count, sizeof count);
    for (size_t i = 0; i < partial->count; i++) {
        const sp_placed *placed = &partial->items[i];
        sp_tell_nozzle(search, &placed->nozzle, told);
        sp_tell_nozzle(search, &placed->origin, told);
        sp_tell(told, &placed->pose, sizeof placed->pose);
        sp_tell(told, &placed->site, sizeof placed->site);
        sp_tell(told, &placed->flow, sizeof placed->flow);
        tell_field(placed->field, search->field_count, told);
    }
}

static bool hear_placed(const sp_search *search, sp_heard *heard, size_t rank, sp_partial *partial, sp_error *error)
{
    sp_placed placed = {.field = malloc((search->field_count + 1) * sizeof *placed.field)};
    if (!placed.field)
        return sp_fail_memory(error);
    if (sp_hear_nozzle(search, heard, rank, &placed.nozzle) && sp_hear_nozzle(search, heard, rank, &placed.origin) &&
        sp_hear(heard, rank, &placed.pose, sizeof placed.pose) &&
        sp_hear(heard, rank, &placed.site, sizeof placed.site) &&
        sp_hear(heard, rank, &placed.flow, sizeof placed.flow) &&
        hear_field(heard, rank, placed.field, search->field_count) && placed.nozzle.type && placed.origin.type)
        return sp_partial_add(search, partial, placed, error);
    free(placed.field);
    return sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0, "a rank has told half a layout");
}

bool sp_hear_partial(const sp_search *search, sp_heard *heard, size_t rank, sp_partial *partial, sp_error *error)
{
    sp_partial made;
    uint64_t count;
    if (!sp_hear(heard, rank, &count, sizeof count))
        return true;
    if (!sp_partial_create(search, &made, error))
        return false;
    for (uint64_t i = 0; i < count; i++)
        if (!hear_placed(search, heard, rank, &made, error)) {
            sp_partial_free(&made);
            return false;
        }
    sp_partial_free(partial);
    *partial = made;
    return true;
}
