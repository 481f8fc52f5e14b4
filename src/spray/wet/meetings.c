#include "spray/wet/meetings.h"

#include "nozzle/scramble.h"
#include "spray/wet/growth.h"
#include "spray/wet/pairs.h"

#include <stdlib.h>

typedef struct {
    const sp_mesh *mesh;
    double contact; /* m */
    sp_meetings *to;
    sp_growth growth;
} finder;

static uint32_t shuffle(uint64_t index)
{
    return (uint32_t)(sp_scramble(index * 0x9e3779b97f4a7c15u) >> 32);
}

static void add_meeting(finder *finder, uint32_t triangle, sp_vec3 p, sp_vec3 q)
{
    sp_meetings *to = finder->to;
    if (sp_growth_has_room(&finder->growth, &to->items, &to->capacity, to->count, sizeof *to->items)) {
        to->items[to->count] = (sp_meeting_line){triangle, shuffle(to->count), p, q};
        to->count++;
    }
}

static void add_covering(finder *finder, uint32_t triangle, uint32_t cover)
{
    sp_meetings *to = finder->to;
    if (sp_growth_has_room(&finder->growth, &to->coverings, &to->covering_capacity, to->covering_count,
                           sizeof *to->coverings))
        to->coverings[to->covering_count++] = (sp_covering){triangle, cover};
}

/* On which side of a plane a point at this height above it is: -1, 0 (within the contact) or 1. */
static int side_of(const finder *finder, double height)
{
    return (height > finder->contact) - (height < -finder->contact);
}

/* The heights of a triangle's corners above another's plane, and their sides of it. */
static void take_sides(const finder *finder, uint32_t plane, uint32_t other, double height[3], int side[3])
{
    const sp_mesh *mesh = finder->mesh;
    sp_vec3 normal = sp_triangle_normal(mesh, plane), corner = mesh->vertices[mesh->triangles[plane][0]];
    for (int i = 0; i < 3; i++) {
        height[i] = sp_dot(normal, sp_sub(mesh->vertices[mesh->triangles[other][i]], corner));
        side[i] = side_of(finder, height[i]);
    }
}

/* Where the plane of one triangle meets another; false where it does in less than a line. */
static bool meeting_line(const finder *finder, uint32_t other, const double height[3], const int side[3], sp_vec3 *p,
                         sp_vec3 *q)
{
    const sp_mesh *mesh = finder->mesh;
    sp_vec3 found[3];
    int count = 0;
    for (int i = 0; i < 3; i++) {
        int k = (i + 1) % 3;
        sp_vec3 a = mesh->vertices[mesh->triangles[other][i]], b = mesh->vertices[mesh->triangles[other][k]];
        if (side[i] == 0)
            found[count++] = a;
        else if (side[i] * side[k] < 0)
            found[count++] = sp_along(a, height[i] / (height[i] - height[k]), sp_sub(b, a));
    }
    if (count < 2)
        return false;
    *p = found[0];
    *q = found[1];
    return true;
}

static bool in_one_plane(const int side[3])
{
    return side[0] == 0 && side[1] == 0 && side[2] == 0;
}

/* A triangle in another's plane meets it along its own edges. */
static void meet_in_plane(finder *finder, uint32_t triangle, uint32_t other)
{
    const sp_mesh *mesh = finder->mesh;
    for (int i = 0; i < 3; i++)
        add_meeting(finder, triangle, mesh->vertices[mesh->triangles[other][i]],
                    mesh->vertices[mesh->triangles[other][(i + 1) % 3]]);
    add_covering(finder, triangle, other);
}

static void meet_pair(finder *finder, sp_pair pair)
{
    if (pair.copy) {
        add_covering(finder, pair.a, pair.b);
        add_covering(finder, pair.b, pair.a);
        return;
    }
    double height[2][3];
    int side[2][3];
    take_sides(finder, pair.a, pair.b, height[0], side[0]);
    if (abs(side[0][0] + side[0][1] + side[0][2]) == 3)
        return;
    take_sides(finder, pair.b, pair.a, height[1], side[1]);
    if (abs(side[1][0] + side[1][1] + side[1][2]) == 3)
        return;
    if (in_one_plane(side[0]) || in_one_plane(side[1])) {
        meet_in_plane(finder, pair.a, pair.b);
        meet_in_plane(finder, pair.b, pair.a);
        return;
    }
    sp_vec3 p, q;
    if (meeting_line(finder, pair.b, height[0], side[0], &p, &q))
        add_meeting(finder, pair.a, p, q);
    if (meeting_line(finder, pair.a, height[1], side[1], &p, &q))
        add_meeting(finder, pair.b, p, q);
}

/* What passes through a cap is in two spaces. */
static void meet_cap(finder *finder, const sp_cap *cap)
{
    const sp_mesh *mesh = finder->mesh;
    sp_vec3 normal = sp_unit(cap->normal), p, q;
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        if (finder->to->copies[t])
            continue;
        double height[3];
        int side[3];
        for (int i = 0; i < 3; i++) {
            height[i] = sp_dot(normal, sp_sub(mesh->vertices[mesh->triangles[t][i]], cap->point));
            side[i] = side_of(finder, height[i]);
        }
        if (in_one_plane(side) || !meeting_line(finder, t, height, side, &p, &q))
            continue;
        sp_vec3 along = sp_sub(q, p);
        double length2 = sp_dot(along, along);
        double share = length2 > 0 ? sp_dot(sp_sub(cap->point, p), along) / length2 : 0;
        if (sp_distance(sp_along(p, fmin(fmax(share, 0), 1), along), cap->point) <= cap->radius)
            add_meeting(finder, t, p, q);
    }
}

static int by_order(const void *left, const void *right)
{
    const sp_meeting_line *p = left, *q = right;
    if (p->triangle != q->triangle)
        return p->triangle < q->triangle ? -1 : 1;
    return p->order < q->order ? -1 : p->order > q->order;
}

static int by_cover(const void *left, const void *right)
{
    const sp_covering *p = left, *q = right;
    if (p->triangle != q->triangle)
        return p->triangle < q->triangle ? -1 : 1;
    return p->cover < q->cover ? -1 : p->cover > q->cover;
}

static bool find(finder *finder, const sp_setup *setup, const sp_pair *pairs, size_t pair_count)
{
    sp_meetings *to = finder->to;
    to->copies = calloc(setup->mesh->triangle_count + 1, sizeof *to->copies);
    if (!to->copies)
        return false;
    for (size_t i = 0; i < pair_count; i++)
        to->copies[pairs[i].b] = to->copies[pairs[i].b] || pairs[i].copy;
    for (size_t i = 0; i < setup->cap_count && !finder->growth.failed; i++)
        meet_cap(finder, &setup->caps[i]);
    for (size_t i = 0; i < pair_count && !finder->growth.failed; i++)
        meet_pair(finder, pairs[i]);
    if (to->count)
        qsort(to->items, to->count, sizeof *to->items, by_order);
    if (to->covering_count)
        qsort(to->coverings, to->covering_count, sizeof *to->coverings, by_cover);
    return !finder->growth.failed;
}

bool sp_meetings_find(const sp_setup *setup, const sp_shells *shells, double contact, sp_meetings *meetings,
                      sp_error *error)
{
    *meetings = (sp_meetings){0};
    size_t pair_count = 0;
    sp_pair *pairs = sp_pairs_create(setup->mesh, shells, contact, &pair_count, error);
    if (!pairs)
        return false;
    finder finder = {.mesh = setup->mesh, .contact = contact, .to = meetings};
    bool done = find(&finder, setup, pairs, pair_count);
    free(pairs);
    if (finder.growth.crowded)
        return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                       "geometry: its triangles meet or lie on each other more than %d times", SP_GROWTH_MOST);
    return done || sp_fail_memory(error);
}

void sp_meetings_free(sp_meetings *meetings)
{
    free(meetings->items);
    free(meetings->coverings);
    free(meetings->copies);
    *meetings = (sp_meetings){0};
}
