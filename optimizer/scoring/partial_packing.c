#include "scoring/partial_packing.h"

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

void sp_pack_nozzle(const sp_search *search, const sp_nozzle *nozzle, sp_outgoing *outgoing)
{
    uint64_t variant = variant_of(search, nozzle->type);
    sp_pack(outgoing, &variant, sizeof variant);
    sp_pack(outgoing, nozzle, sizeof *nozzle);
}

bool sp_unpack_nozzle(const sp_search *search, sp_gathered *gathered, size_t rank, sp_nozzle *nozzle)
{
    uint64_t variant;
    if (!sp_unpack(gathered, rank, &variant, sizeof variant) || !sp_unpack(gathered, rank, nozzle, sizeof *nozzle))
        return false;
    nozzle->type = type_of(search, variant);
    return true;
}

/* Most patches get nothing: only others are packed, with their numbers. */
static void pack_field(const float *field, size_t count, sp_outgoing *outgoing)
{
    static const float nothing;
    uint32_t some = 0;
    for (size_t i = 0; i < count; i++)
        some += memcmp(&field[i], &nothing, sizeof nothing) != 0;
    sp_pack(outgoing, &some, sizeof some);
    for (uint32_t i = 0; i < count; i++)
        if (memcmp(&field[i], &nothing, sizeof nothing) != 0) {
            sp_pack(outgoing, &i, sizeof i);
            sp_pack(outgoing, &field[i], sizeof field[i]);
        }
}

static bool unpack_field(sp_gathered *gathered, size_t rank, float *field, size_t count)
{
    uint32_t some, at;
    memset(field, 0, count * sizeof *field);
    bool there = sp_unpack(gathered, rank, &some, sizeof some);
    for (uint32_t i = 0; there && i < some; i++)
        there = sp_unpack(gathered, rank, &at, sizeof at) && at < count &&
                sp_unpack(gathered, rank, &field[at], sizeof *field);
    return there;
}

void sp_pack_partial(const sp_search *search, const sp_partial *partial, sp_outgoing *outgoing)
{
    uint64_t count = partial->count;
    sp_pack(outgoing, &count, sizeof count);
    for (size_t i = 0; i < partial->count; i++) {
        const sp_placed *placed = &partial->items[i];
        sp_pack_nozzle(search, &placed->nozzle, outgoing);
        sp_pack_nozzle(search, &placed->origin, outgoing);
        sp_pack(outgoing, &placed->pose, sizeof placed->pose);
        sp_pack(outgoing, &placed->site, sizeof placed->site);
        sp_pack(outgoing, &placed->flow, sizeof placed->flow);
        pack_field(placed->field, search->field_count, outgoing);
    }
}

static bool unpack_placed(const sp_search *search, sp_gathered *gathered, size_t rank, sp_partial *partial,
                          sp_error *error)
{
    sp_placed placed = {.field = malloc((search->field_count + 1) * sizeof *placed.field)};
    if (!placed.field)
        return sp_fail_memory(error);
    if (sp_unpack_nozzle(search, gathered, rank, &placed.nozzle) &&
        sp_unpack_nozzle(search, gathered, rank, &placed.origin) &&
        sp_unpack(gathered, rank, &placed.pose, sizeof placed.pose) &&
        sp_unpack(gathered, rank, &placed.site, sizeof placed.site) &&
        sp_unpack(gathered, rank, &placed.flow, sizeof placed.flow) &&
        unpack_field(gathered, rank, placed.field, search->field_count) && placed.nozzle.type && placed.origin.type)
        return sp_partial_add(search, partial, placed, error);
    free(placed.field);
    return sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0, "a rank has sent half a layout");
}

bool sp_unpack_partial(const sp_search *search, sp_gathered *gathered, size_t rank, sp_partial *partial,
                       sp_error *error)
{
    sp_partial made;
    uint64_t count;
    if (!sp_unpack(gathered, rank, &count, sizeof count))
        return true;
    if (!sp_partial_create(search, &made, error))
        return false;
    for (uint64_t i = 0; i < count; i++)
        if (!unpack_placed(search, gathered, rank, &made, error)) {
            sp_partial_free(&made);
            return false;
        }
    sp_partial_free(partial);
    *partial = made;
    return true;
}
