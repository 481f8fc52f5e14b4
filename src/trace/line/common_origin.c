/* Rays of one origin: put in the order of their directions, then traced in packets of neighbours. */
#include "trace/line/line_packet.h"
#include "trace/bvh/direction_order.h"
#include "trace/ray/line.h"
#include "trace/line/line_bvh.h"

#include <stdlib.h>
#include <string.h>

/* Origins farther away are left to single lines, which begin near the mesh. */
#define NEAR_ENOUGH 7.0

static const sp_line_packet_kernel *const kernels[] = SP_KERNELS(&sp_line_packet);

sp_hit sp_line_packet_ask(const sp_line_packet *b, int lane, uint32_t triangle, uint32_t other)
{
    const sp_ray *ray = &b->rays[b->ray[lane]];
    sp_ray_search search = sp_ray_search_start(ray, false);
    sp_line line;
    uint32_t candidates[2] = {triangle, other};
    bool good = sp_line_start(&line, ray);
    for (int i = 0; good && i < 2 && candidates[i] != SP_NONE; i++) {
        sp_corners corners;
        sp_bvh_corners(b->bvh, candidates[i], corners);
        sp_line_test(&line, (const double(*)[3])corners, candidates[i], &search);
    }
    return search.best;
}

void sp_line_packet_settle(sp_line_packet *b, int lane, uint32_t triangle)
{
    sp_hit hit = sp_line_packet_ask(b, lane, triangle, b->triangle[lane]);
    if (hit.triangle == SP_NONE)
        return;
    float depth = (float)(hit.t * fabs(b->velocity[2][lane]) * b->bvh->scale);
    b->triangle[lane] = hit.triangle;
    b->low[lane] = depth - SP_BVH_PAD;
    b->high[lane] = b->any ? -1 : depth + SP_BVH_PAD;
}

/* Where the origin is in the hierarchy's space; false where that is too far away. */
static bool place_origin(sp_common_origin *c)
{
    double origin[3], reach = 0;
    sp_to_array(c->rays[0].origin, origin);
    for (int axis = 0; axis < 3; axis++) {
        double place = (origin[axis] - c->bvh->centre[axis]) * c->bvh->scale;
        c->place[axis] = place;
        reach = sp_greater(reach, fabs(place) + 1);
        if (!(fabs(place) <= NEAR_ENOUGH))
            return false;
    }
    c->blur = 13 * 0x1p-24f * (float)reach;
    return true;
}

void sp_common_origin_room_clear(sp_common_origin_room *room)
{
    free(room->order);
    *room = (sp_common_origin_room){0};
}

static bool make_room(sp_common_origin_room *room, size_t count)
{
    if (count <= room->count)
        return true;
    sp_common_origin_room_clear(room);
    if (count > SIZE_MAX / (2 * sizeof *room->order))
        return false;
    room->order = malloc(2 * count * sizeof *room->order);
    if (!room->order)
        return false;
    room->count = count;
    return true;
}

/* The hits of a packet are computed when the next one has been searched, as their corners have to come from memory. */
static void trace_packets(const sp_common_origin *c, const sp_line_packet_kernel *kernel, sp_hit *hits, bool *occluded)
{
    sp_line_packet packets[2];
    int at = 0;
    packets[1].count = 0;
    for (size_t i = 0; i < c->count; at = !at) {
        sp_line_packet *b = &packets[at];
        b->bvh = c->bvh;
        b->rays = c->rays;
        b->blur = c->blur;
        b->any = !hits;
        i += kernel->fill(c, i, b);
        kernel->search(b);
        for (int k = 0; !hits && k < b->count; k++)
            occluded[b->ray[k]] = b->triangle[k] != SP_NONE;
        if (hits) {
            for (int k = 0; k < b->count; k++)
                if (b->triangle[k] != SP_NONE)
                    sp_bvh_prefetch_corners(b->bvh, b->triangle[k]);
            kernel->answer(&packets[!at], hits);
        }
    }
    if (hits)
        kernel->answer(&packets[!at], hits);
}

bool sp_common_origin_trace(const sp_bvh *bvh, sp_instructions instructions, const sp_ray *rays, size_t count,
                            sp_common_origin_room *room, sp_hit *hits, bool *occluded)
{
    sp_common_origin c = {.bvh = bvh, .rays = rays, .count = count};
    if (bvh->node_count == 0 || count == 0 || !place_origin(&c))
        return false;
    if (!make_room(room, count))
        return false;
    c.order[0] = room->order;
    c.order[1] = c.order[0] + count;
    if (!kernels[instructions]->keys(bvh, rays, count, c.order[0]))
        return false;
    sp_direction_sort(c.order, count);
    trace_packets(&c, kernels[instructions], hits, occluded);
    return true;
}

bool sp_common_origin_trace_singly(const sp_bvh *bvh, sp_instructions instructions, const sp_ray *rays, size_t count,
                                   sp_common_origin_room *room, sp_hit *hits, bool *occluded)
{
    if (!make_room(room, count))
        return false;
    sp_direction_entry *order[2] = {room->order, room->order + count};
    kernels[instructions]->keys(bvh, rays, count, order[0]);
    sp_direction_sort(order, count);
    sp_bvh_trace_lines(bvh, instructions, rays, order[0], count, hits, occluded);
    return true;
}
