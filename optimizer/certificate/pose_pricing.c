#include "certificate/pose_pricing.h"

#include <stdlib.h>

#define SHARES_MORE 1e-5f /* more than single precision puts a share, or flux, wrong */

static bool allocate(sp_pose_pricing *pricing)
{
    const sp_search *search = pricing->search;
    size_t texels = 2 * search->patch_count + 1, room = search->visibility->largest + 2 * SP_LANES;
    pricing->bests = calloc(search->sites->count + 1, search->candidates->variant_count * sizeof *pricing->bests);
    pricing->scratches = calloc((size_t)pricing->threads, sizeof *pricing->scratches);
    if (!pricing->bests || !pricing->scratches)
        return false;
    for (int i = 0; i < pricing->threads; i++) {
        sp_pose_scratch *own = &pricing->scratches[i];
        own->worth = calloc(2 * room, sizeof *own->worth);
        own->fields = (sp_field_scratch){.cull = &own->cull,
                                         .more = SHARES_MORE,
                                         .share = own->worth,
                                         .counts = own->worth + room,
                                         .runs = malloc(SP_BINS * sizeof *own->fields.runs)};
        own->field = malloc(texels * sizeof *own->field);
        own->texels = malloc(texels * sizeof *own->texels);
        own->shares = malloc(texels * sizeof *own->shares);
        if (!own->worth || !own->fields.runs || !own->field || !own->texels || !own->shares)
            return false;
    }
    return true;
}

static bool any_bent(const sp_search *search)
{
    for (size_t i = 0; i < search->candidates->launch_count; i++)
        if (sp_length(sp_evaluator_gravity(search->coarse, &search->candidates->launches[i])) > 0)
            return true;
    return false;
}

sp_pose_pricing *sp_pose_pricing_create(const sp_search *search, const sp_cover *cover, const uint32_t *tier_of,
                                        const float *need, const float *film_need, const size_t *ports, sp_error *error)
{
    sp_pose_pricing *pricing = malloc(sizeof *pricing);
    if (!pricing)
        return sp_fail_memory(error);
    *pricing = (sp_pose_pricing){.search = search,
                                 .cover = cover,
                                 .tier_of = tier_of,
                                 .need = need,
                                 .film_need = film_need,
                                 .ports = ports,
                                 .upwards = (float)(1 + sp_field_margin(search->kept_count + cover->nozzles)),
                                 .bent = any_bent(search),
                                 .threads = sp_scorer_threads(search)};
    if (allocate(pricing))
        return pricing;
    sp_pose_pricing_destroy(pricing);
    return sp_fail_memory(error);
}

void sp_pose_pricing_destroy(sp_pose_pricing *pricing)
{
    if (!pricing)
        return;
    for (int i = 0; pricing->scratches && i < pricing->threads; i++) {
        free(pricing->scratches[i].worth);
        free(pricing->scratches[i].fields.runs);
        free(pricing->scratches[i].field);
        free(pricing->scratches[i].texels);
        free(pricing->scratches[i].shares);
    }
    free(pricing->bests);
    free(pricing->last);
    free(pricing->scratches);
    free(pricing);
}
