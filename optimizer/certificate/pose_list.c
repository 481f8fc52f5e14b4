#include "certificate/pose_list.h"
#include "certificate/pose_price.h"
#include "certificate/pose_rows.h"
#include "ranks/messages.h"

#include <omp.h>
#include <stdlib.h>
#include <string.h>

void sp_pose_price_found(const sp_pose_order *order, const sp_multipliers *u, const uint8_t *alive, float *price)
{
    for (size_t i = 0; i < order->block_count; i++) {
        const sp_pose_block *found = &order->blocks[i];
        for (size_t at = found->start; found->variant == SP_NONE && at < found[1].start; at++) {
            size_t row = order->own_order[found->site + at - found->start];
            price[at] = !alive || alive[at] ? nextafterf((float)sp_rows_price(order->own, row, u), INFINITY) : 0;
        }
    }
}

bool sp_pose_share_prices(sp_pose_pricing *pricing, float *price, bool bests, sp_error *error)
{
    const sp_pose_order *order = pricing->order;
    size_t variants = pricing->search->candidates->variant_count, cells = pricing->search->sites->count * variants;
    sp_outgoing outgoing = {0};
    sp_gathered gathered;
    for (size_t i = 0; sp_ranks_count(sp_pose_ranks(pricing)) > 1 && i < cells; i++) {
        if (!sp_ranks_mine(sp_pose_ranks(pricing), i / variants))
            continue;
        const sp_pose_block *block = order->block_of[i] == SIZE_MAX ? NULL : &order->blocks[order->block_of[i]];
        if (price && block)
            sp_pack(&outgoing, price + block->start, (block[1].start - block->start) * sizeof *price);
        if (bests)
            sp_pack(&outgoing, &pricing->bests[i], sizeof pricing->bests[i]);
    }
    if (!sp_ranks_gather(sp_pose_ranks(pricing), "prices", &outgoing, &gathered, error))
        return false;
    for (size_t i = 0; i < cells; i++) {
        size_t rank = sp_ranks_owner(sp_pose_ranks(pricing), i / variants);
        if (sp_ranks_mine(sp_pose_ranks(pricing), i / variants))
            continue;
        const sp_pose_block *block = order->block_of[i] == SIZE_MAX ? NULL : &order->blocks[order->block_of[i]];
        if (price && block)
            sp_unpack(&gathered, rank, price + block->start, (block[1].start - block->start) * sizeof *price);
        if (bests)
            sp_unpack(&gathered, rank, &pricing->bests[i], sizeof pricing->bests[i]);
    }
    sp_gathered_free(&gathered);
    return true;
}

/* The poses of a block that are alive. */
static void price_block(sp_pose_pricing *pricing, sp_pose_scratch *own, size_t block, const sp_multipliers *u,
                        const uint8_t *alive, float *price)
{
    const sp_search *search = pricing->search;
    const sp_pose_block *poses = &pricing->order->blocks[block];
    size_t end = poses[1].start;
    const sp_variant *variant = &search->candidates->variants[poses->variant];
    sp_frame frame = sp_nozzle_frame(search->sites->items[poses->site].axis, 0, sp_evaluator_setup(search->coarse)->up);
    memset(price + poses->start, 0, (end - poses->start) * sizeof *price);
    if (!memchr(alive + poses->start, 1, end - poses->start))
        return;
    const sp_view *view = sp_visibility_look(search->visibility, poses->site, variant->launch, &own->buffer);
    if (!view->start && sp_type_is_uniform(variant->type))
        return;
    sp_region region = sp_pose_prepare(pricing, own, view, variant, &frame, u);
    for (size_t i = poses->start; i < end; i++)
        if (alive[i])
            price[i] = nextafterf(
                (float)sp_pose_price(pricing, own, view, sp_pose_order_at(pricing->order, block, i), &region, 0),
                INFINITY);
}

static bool price_list(void *user, const sp_multipliers *u, const uint8_t *alive, float *price, sp_error *error)
{
    sp_pose_pricing *pricing = user;
    const sp_pose_order *order = pricing->order;
    size_t variants = pricing->search->candidates->variant_count, sites = pricing->search->sites->count;
    sp_ranks_part(sp_pose_ranks(pricing));
#pragma omp parallel for num_threads(pricing->threads) schedule(dynamic, 1)
    for (size_t site = 0; site < sites; site++)
        for (size_t k = 0;
             k < variants && sp_ranks_mine(sp_pose_ranks(pricing), site) && sp_cover_goes_on(pricing->cover); k++)
            if (order->block_of[site * variants + k] != SIZE_MAX)
                price_block(pricing, &pricing->scratches[omp_get_thread_num()], order->block_of[site * variants + k], u,
                            alive, price);
    for (int i = 0; i < pricing->threads; i++)
        sp_visibility_release(pricing->search->visibility, &pricing->scratches[i].buffer);
    sp_ranks_rejoin(sp_pose_ranks(pricing));
    sp_pose_price_found(order, u, alive, price);
    return sp_pose_share_prices(pricing, price, false, error);
}

static bool row_of_list(void *user, size_t position, sp_rows *rows, sp_error *error)
{
    const sp_pose_pricing *pricing = user;
    const sp_pose_order *order = pricing->order;
    size_t block = sp_pose_order_block(order, position);
    if (order->blocks[block].variant != SP_NONE)
        return sp_pose_pricing_add(pricing, sp_pose_order_at(order, block, position), rows, error);
    const sp_rows *own = order->own;
    size_t row = order->own_order[order->blocks[block].site + position - order->blocks[block].start];
    return sp_rows_add(rows, position, own->port[row], own->tier[row], own->texel + own->start[row],
                       own->share + own->start[row], own->start[row + 1] - own->start[row], error);
}

bool sp_pose_list(sp_pose_pricing *pricing, const sp_pose_order *order, sp_candidate_list *list, sp_error *error)
{
    *list = order->list;
    list->user = pricing;
    list->price = price_list;
    list->row = row_of_list;
    list->threads = pricing->threads;
    pricing->order = order;
    pricing->last = calloc(order->list.count + 1, sizeof *pricing->last);
    return pricing->last || sp_fail_memory(error);
}
