#include "certificate/pose_order.h"

#include "ranking/ranking.h"
#include "scoring/scoring.h"

#include <assert.h>
#include <stdlib.h>

static double along(sp_vec3 v, int axis)
{
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

/* Halves the points across their widest extent, and so on, in the middle of what is left each time. */
static void halve(const sp_vec3 *points, sp_ranked *entries, size_t count)
{
    double widest = -1;
    int axis = 0;
    if (count < 3)
        return;
    for (int k = 0; k < 3; k++) {
        double low = INFINITY, high = -INFINITY;
        for (size_t i = 0; i < count; i++) {
            low = fmin(low, along(points[entries[i].at], k));
            high = fmax(high, along(points[entries[i].at], k));
        }
        if (high - low > widest) {
            widest = high - low;
            axis = k;
        }
    }
    for (size_t i = 0; i < count; i++)
        entries[i].merit = along(points[entries[i].at], axis);
    sp_rank_rising(entries, count);
    halve(points, entries, count / 2);
    halve(points, entries + count / 2, count - count / 2);
}

/* Numbers of the points such that neighbours in the order are neighbours in space. malloc'd. */
static uint32_t *order_points(const sp_vec3 *points, size_t count)
{
    uint32_t *order = malloc((count + 1) * sizeof *order);
    sp_ranked *entries = malloc((count + 1) * sizeof *entries);
    for (size_t i = 0; entries && i < count; i++)
        entries[i] = (sp_ranked){0, i};
    if (order && entries) {
        halve(points, entries, count);
        for (size_t i = 0; i < count; i++)
            order[i] = (uint32_t)entries[i].at;
    }
    free(entries ? entries : (void *)order);
    return entries ? order : NULL;
}

static bool order_axes(sp_pose_order *order)
{
    const sp_candidates *candidates = order->search->candidates;
    size_t count = candidates->mount_count * candidates->variant_count;
    order->axis_at = calloc(count + 1, sizeof *order->axis_at);
    order->rank_of = calloc(count + 1, sizeof *order->rank_of);
    if (!order->axis_at || !order->rank_of)
        return false;
    for (size_t i = 0; i < count; i++) {
        const sp_axes *axes = &candidates->axes[i];
        if (!axes->count)
            continue;
        order->axis_at[i] = order_points(axes->axes, axes->count);
        order->rank_of[i] = malloc(axes->count * sizeof *order->rank_of[i]);
        if (!order->axis_at[i] || !order->rank_of[i])
            return false;
        for (size_t a = 0; a < axes->count; a++)
            order->rank_of[i][order->axis_at[i][a]] = (uint32_t)a;
    }
    return true;
}

/* Sites mount by mount, neighbours of a mount side by side. malloc'd. */
static uint32_t *order_sites(const sp_sites *sites)
{
    uint32_t *order = malloc((sites->count + 1) * sizeof *order);
    sp_vec3 *points = malloc((sites->count + 1) * sizeof *points);
    bool done = order && points;
    for (size_t first = 0, end; done && first < sites->count; first = end) {
        for (end = first; end < sites->count && sites->items[end].mount == sites->items[first].mount; end++)
            points[end - first] = sites->items[end].position;
        uint32_t *within = order_points(points, end - first);
        done = within != NULL;
        for (size_t i = first; done && i < end; i++)
            order[i] = (uint32_t)first + within[i - first];
        free(within);
    }
    free(points);
    if (done)
        return order;
    free(order);
    return NULL;
}

/* What a list is built from. */
typedef struct {
    sp_pose_order *order;
    const sp_cover *cover;
    const uint32_t *tier_of;
    const size_t *ports;
    uint32_t *sites;
    uint32_t *tiers; /* by falling weight */
} list_builder;

/* Ends the list with a block of so many candidates. */
static void add_block(list_builder *l, sp_pose_block block, size_t port, size_t count)
{
    sp_candidate_list *list = &l->order->list;
    size_t kind = list->kind_count - 1;
    block.start = list->count;
    l->order->blocks[l->order->block_count++] = block;
    bool goes_on = list->run_count && list->run_start[list->run_count - 1] >= list->kind_start[kind] &&
                   list->run_port[list->run_count - 1] == port;
    if (!goes_on) {
        list->run_start[list->run_count] = list->count;
        list->run_port[list->run_count++] = port;
    }
    list->count += count;
}

/* The variant's poses in mounts where it is of the tier. */
static void add_variant(list_builder *l, uint32_t variant, uint32_t tier)
{
    const sp_search *search = l->order->search;
    const sp_candidates *candidates = search->candidates;
    for (size_t i = 0; i < search->sites->count; i++) {
        uint32_t site = l->sites[i], mount = search->sites->items[site].mount;
        size_t poses = sp_candidates_axes(candidates, mount, variant)->count * candidates->variants[variant].roll_count;
        if (!poses || l->tier_of[mount * candidates->variant_count + variant] != tier || search->port_taken[mount] ||
            !sp_search_knows(search, site, variant))
            continue;
        l->order->block_of[site * candidates->variant_count + variant] = l->order->block_count;
        add_block(l, (sp_pose_block){0, site, variant}, l->ports[mount], poses);
    }
}

/* Found nozzles of the tier, port by port. */
static void add_found(list_builder *l, uint32_t tier, size_t *listed)
{
    const sp_rows *own = l->order->own;
    for (size_t port = 0; port <= l->cover->port_count; port++) {
        size_t first = *listed, wanted = port < l->cover->port_count ? port : SP_NO_PORT;
        for (size_t i = 0; i < own->count; i++)
            if (own->tier[i] == tier && own->port[i] == wanted)
                l->order->own_order[(*listed)++] = i;
        if (*listed > first)
            add_block(l, (sp_pose_block){0, (uint32_t)first, SP_NONE}, wanted, *listed - first);
    }
}

#ifndef NDEBUG
/* Blocks and runs begin where the one before ends, and cover all positions; kinds get lighter. */
static bool is_covered(const sp_pose_order *order)
{
    const sp_candidate_list *list = &order->list;
    bool covered = order->blocks[0].start == 0 && list->run_start[0] == 0 && list->kind_start[0] == 0;
    for (size_t i = 0; covered && i < order->block_count; i++)
        covered = order->blocks[i].start < order->blocks[i + 1].start;
    for (size_t i = 0; covered && i < list->run_count; i++)
        covered = list->run_start[i] < list->run_start[i + 1];
    for (size_t i = 0; covered && i < list->kind_count; i++)
        covered = list->kind_start[i] < list->kind_start[i + 1] && (i == 0 || list->weight[i - 1] >= list->weight[i]);
    return covered && order->blocks[order->block_count].start == list->count;
}
#endif

static void fill(list_builder *l)
{
    sp_candidate_list *list = &l->order->list;
    size_t listed = 0;
    for (size_t i = 0; i < l->cover->tier_count; i++) {
        size_t at = i;
        for (; at > 0 && l->cover->weight[l->tiers[at - 1]] < l->cover->weight[i]; at--)
            l->tiers[at] = l->tiers[at - 1];
        l->tiers[at] = (uint32_t)i;
    }
    for (size_t i = 0; i < l->cover->tier_count; i++) {
        uint32_t tier = l->tiers[i];
        size_t before = list->count;
        list->kind_start[list->kind_count] = before;
        list->weight[list->kind_count++] = l->cover->weight[tier];
        for (uint32_t k = 0; k < l->order->search->candidates->variant_count; k++)
            add_variant(l, k, tier);
        add_found(l, tier, &listed);
        list->kind_count -= list->count == before;
    }
    list->kind_start[list->kind_count] = list->run_start[list->run_count] = list->count;
    l->order->blocks[l->order->block_count].start = list->count;
    assert(listed == l->order->own->count && is_covered(l->order));
}

bool sp_pose_order_create(const sp_search *search, const sp_cover *cover, const uint32_t *tier_of, const size_t *ports,
                          const sp_rows *own, sp_pose_order *order, sp_error *error)
{
    size_t cells = search->sites->count * search->candidates->variant_count, blocks = cells + own->count + 1;
    *order = (sp_pose_order){.search = search, .own = own};
    order->own_order = malloc((own->count + 1) * sizeof *order->own_order);
    order->blocks = malloc(blocks * sizeof *order->blocks);
    order->block_of = malloc((cells + 1) * sizeof *order->block_of);
    order->list.kind_start = malloc((cover->tier_count + 1) * sizeof(size_t));
    order->list.weight = malloc((cover->tier_count + 1) * sizeof(uint32_t));
    order->list.run_start = malloc(blocks * sizeof(size_t));
    order->list.run_port = malloc(blocks * sizeof(size_t));
    list_builder l = {
        order, cover, tier_of, ports, order_sites(search->sites), malloc((cover->tier_count + 1) * sizeof(uint32_t))};
    bool done = order->own_order && order->blocks && order->block_of && order->list.kind_start && order->list.weight &&
                order->list.run_start && order->list.run_port && l.sites && l.tiers && order_axes(order);
    for (size_t i = 0; done && i < cells; i++)
        order->block_of[i] = SIZE_MAX;
    if (done)
        fill(&l);
    free(l.sites);
    free(l.tiers);
    if (done)
        return true;
    sp_pose_order_free(order);
    return sp_fail_memory(error);
}

void sp_pose_order_free(sp_pose_order *order)
{
    size_t count =
        order->search ? order->search->candidates->mount_count * order->search->candidates->variant_count : 0;
    for (size_t i = 0; i < count; i++) {
        free(order->axis_at ? order->axis_at[i] : NULL);
        free(order->rank_of ? order->rank_of[i] : NULL);
    }
    free(order->axis_at);
    free(order->rank_of);
    free(order->own_order);
    free(order->blocks);
    free(order->block_of);
    sp_candidate_list_free(&order->list);
    *order = (sp_pose_order){0};
}

size_t sp_pose_order_block(const sp_pose_order *order, size_t position)
{
    size_t low = 0, high = order->block_count;
    assert(position < order->list.count);
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        if (order->blocks[middle].start <= position)
            low = middle;
        else
            high = middle;
    }
    return low;
}

sp_pose sp_pose_order_at(const sp_pose_order *order, size_t block, size_t position)
{
    const sp_candidates *candidates = order->search->candidates;
    const sp_pose_block *own = &order->blocks[block];
    uint32_t mount = order->search->sites->items[own->site].mount;
    size_t rolls = candidates->variants[own->variant].roll_count, within = position - own->start;
    assert(own->variant != SP_NONE && own->start <= position && position < own[1].start);
    const uint32_t *axis_at = order->axis_at[mount * candidates->variant_count + own->variant];
    return (sp_pose){own->site, own->variant, axis_at[within / rolls], (uint32_t)(within % rolls)};
}

size_t sp_pose_order_position(const sp_pose_order *order, sp_pose pose)
{
    const sp_candidates *candidates = order->search->candidates;
    uint32_t mount = order->search->sites->items[pose.site].mount;
    size_t block = order->block_of[pose.site * candidates->variant_count + pose.variant];
    const uint32_t *rank_of = order->rank_of[mount * candidates->variant_count + pose.variant];
    assert(block < order->block_count && pose.roll < candidates->variants[pose.variant].roll_count);
    return order->blocks[block].start + (size_t)rank_of[pose.axis] * candidates->variants[pose.variant].roll_count +
           pose.roll;
}
