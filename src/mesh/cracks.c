#include "mesh/cracks.h"

#include "mesh/box_pairs.h"
#include "mesh/grow.h"
#include "mesh/min_max.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>

#define ALONG 0.85       /* cosine: edges that are turned more against each other do not lie along each other */
#define SLENDER 0.25     /* of a triangle's edge or height: what is wider is no crack to it */
#define HAIR 0.01        /* of the width: nearer is the same place, whatever the angle between the two surfaces */
#define FOLDED 0.5       /* cosine between the ways into two surfaces, above which the two lie over each other */
#define MOST_MEETINGS 50 /* a stretch, in the mean, beside a million: a crowd that strangers made ends */

/* A part of an open edge, no longer than such edges are in the mean, so that few others lie in its box. */
typedef struct {
    uint32_t half_edge;
    double from, to;
    double reach;   /* m, how wide a crack may be there */
    uint32_t taken; /* the first of its parts that cracks have taken; SP_NONE */
} stretch;

/* A part of a stretch that a crack has; in a list by place. */
typedef struct {
    double from, to;
    uint32_t next;
} taken_part;

/* Two stretches that lie along each other: the crack that they would make. */
typedef struct {
    double cost; /* m */
    uint32_t stretch[2];
    sp_crack crack;
} meeting;

typedef struct {
    const sp_mesh *mesh;
    double width;
    stretch *stretches;
    size_t stretch_count, stretch_room;
    meeting *meetings;
    size_t meeting_count, meeting_room;
    taken_part *taken;
    size_t taken_count, taken_room;
    sp_cracks *cracks;
    size_t crack_room;
    bool failed; /* memory ran out */
} crack_search;

static sp_vec3 start_of(const sp_mesh *mesh, uint32_t half_edge)
{
    return mesh->vertices[sp_half_edge_from(mesh, half_edge)];
}

static sp_vec3 step_of(const sp_mesh *mesh, uint32_t half_edge)
{
    return sp_sub(mesh->vertices[sp_half_edge_to(mesh, half_edge)], start_of(mesh, half_edge));
}

static sp_vec3 point_on(const sp_mesh *mesh, uint32_t half_edge, double part)
{
    return sp_along(start_of(mesh, half_edge), part, step_of(mesh, half_edge));
}

/* Unit, from the edge into its triangle. */
static sp_vec3 into(const sp_mesh *mesh, uint32_t half_edge)
{
    return sp_unit(sp_cross(sp_triangle_normal(mesh, half_edge / 3), step_of(mesh, half_edge)));
}

static double reach_of(const crack_search *search, uint32_t half_edge)
{
    const sp_mesh *mesh = search->mesh;
    sp_vec3 far = mesh->vertices[mesh->triangles[half_edge / 3][(half_edge % 3 + 2) % 3]];
    double height = sp_dot(sp_sub(far, start_of(mesh, half_edge)), into(mesh, half_edge));
    double least = sp_lesser(height, sp_length(step_of(mesh, half_edge)));
    return sp_lesser(search->width, SLENDER * least);
}

/* Cuts one open edge into stretches of that length at most. */
static bool cut(crack_search *search, uint32_t half_edge, double length)
{
    double own = sp_length(step_of(search->mesh, half_edge));
    size_t parts = own > length ? (size_t)ceil(own / length) : 1;
    double reach = reach_of(search, half_edge);
    if (!sp_grow(&search->stretches, &search->stretch_room, search->stretch_count + parts, sizeof(stretch)))
        return false;
    for (size_t k = 0; k < parts; k++)
        search->stretches[search->stretch_count++] =
            (stretch){half_edge, (double)k / (double)parts, (double)(k + 1) / (double)parts, reach, SP_NONE};
    return true;
}

static bool list_stretches(crack_search *search, const sp_half_edges *edges)
{
    size_t count = 0;
    double sum = 0;
    for (uint32_t h = 0; h < 3 * search->mesh->triangle_count; h++)
        if (edges->kind[h] == SP_EDGE_OPEN) {
            sum += sp_length(step_of(search->mesh, h));
            count++;
        }
    for (uint32_t h = 0; h < 3 * search->mesh->triangle_count; h++)
        if (edges->kind[h] == SP_EDGE_OPEN && !cut(search, h, sum / (double)count))
            return false;
    return search->stretch_count < SP_NONE;
}

/* Narrows parts of an edge about their middle to where |w + u v| <= reach, u counting from there; false for nowhere. */
static bool narrow(double part[2], sp_vec3 w, sp_vec3 v, double reach)
{
    double middle = 0.5 * (part[0] + part[1]), a = sp_dot(v, v), b = sp_dot(w, v), c = sp_dot(w, w) - reach * reach;
    if (!(a > 0))
        return c <= 0;
    double root = b * b - a * c;
    if (!(root >= 0))
        return false;
    part[0] = sp_greater(part[0], middle - (b + sqrt(root)) / a);
    part[1] = sp_lesser(part[1], middle + (sqrt(root) - b) / a);
    return part[0] < part[1];
}

/* The parts of two stretches, by the perpendiculars on the first edge, that lie within reach of each other. */
static bool lie_along(const crack_search *search, const stretch *p, const stretch *q, double reach, sp_crack *crack)
{
    const sp_mesh *mesh = search->mesh;
    sp_vec3 a = step_of(mesh, p->half_edge), b = step_of(mesh, q->half_edge);
    double square = sp_dot(a, a), product = sp_dot(a, b);
    if (!(fabs(product) >= ALONG * sqrt(square * sp_dot(b, b)) && square > 0 && fabs(product) > 0))
        return false;
    sp_vec3 off = sp_sub(start_of(mesh, q->half_edge), start_of(mesh, p->half_edge));
    double first = sp_dot(off, a) / square, each = product / square; /* on the first edge, of q's start and length */
    double ends[2] = {first + q->from * each, first + q->to * each}, *part = crack->part[0];
    part[0] = sp_greater(p->from, sp_lesser(ends[0], ends[1]));
    part[1] = sp_lesser(p->to, sp_greater(ends[0], ends[1]));
    if (!(part[0] < part[1]))
        return false;
    double middle = 0.5 * (part[0] + part[1]);
    sp_vec3 apart = sp_sub(point_on(mesh, q->half_edge, (middle - first) / each), point_on(mesh, p->half_edge, middle));
    if (!narrow(part, apart, sp_sub(sp_scale(b, 1 / each), a), reach))
        return false;
    for (int k = 0; k < 2; k++)
        crack->part[1][k] = sp_lesser(q->to, sp_greater(q->from, (part[k] - first) / each));
    crack->half_edge[0] = p->half_edge;
    crack->half_edge[1] = q->half_edge;
    return true;
}

static bool share_corner(const sp_mesh *mesh, uint32_t a, uint32_t b)
{
    uint32_t from = sp_half_edge_from(mesh, a), to = sp_half_edge_to(mesh, a);
    return sp_half_edge_from(mesh, b) == from || sp_half_edge_to(mesh, b) == from || sp_half_edge_from(mesh, b) == to ||
           sp_half_edge_to(mesh, b) == to;
}

/* How far the second edge lies from the first, and of that, how far within the first one's triangle: m, in the mean. */
static double gap_of(const sp_mesh *mesh, const sp_crack *crack, double *within)
{
    double gap = 0;
    sp_vec3 inwards = into(mesh, crack->half_edge[0]);
    *within = 0;
    for (int k = 0; k < 2; k++) {
        sp_vec3 apart = sp_sub(point_on(mesh, crack->half_edge[1], crack->part[1][k]),
                               point_on(mesh, crack->half_edge[0], crack->part[0][k]));
        gap += 0.5 * sp_length(apart);
        *within += 0.5 * sp_dot(apart, inwards);
    }
    return gap;
}

static double length_of(const sp_mesh *mesh, const sp_crack *crack)
{
    return (crack->part[0][1] - crack->part[0][0]) * sp_length(step_of(mesh, crack->half_edge[0]));
}

/* A box visitor. */
static bool meet(void *user, uint32_t i, uint32_t j)
{
    crack_search *search = user;
    const sp_mesh *mesh = search->mesh;
    uint32_t first = i < j ? i : j, second = i < j ? j : i;
    const stretch *p = &search->stretches[first], *q = &search->stretches[second];
    meeting met = {0, {first, second}, {{0}, {{0}}}};
    double reach = sp_lesser(p->reach, q->reach), within;
    if (p->half_edge / 3 == q->half_edge / 3 || !lie_along(search, p, q, reach, &met.crack) ||
        !(length_of(mesh, &met.crack) > reach))
        return true;
    double gap = gap_of(mesh, &met.crack, &within), hair = HAIR * search->width;
    double fold = sp_dot(into(mesh, p->half_edge), into(mesh, q->half_edge));
    bool turned = met.crack.part[1][0] < met.crack.part[1][1];
    /* two rims over each other; or the two edges of a pointed corner, between which its surface lies */
    if (gap > hair && (fold > FOLDED || (within > hair && share_corner(mesh, p->half_edge, q->half_edge))))
        return true;
    met.cost = gap + hair * (0.5 * (1 + fold) + turned); /* of those in one place, what goes on smoothly */
    if (search->meeting_count > 1000000 + MOST_MEETINGS * search->stretch_count)
        return false;
    search->failed =
        !sp_grow(&search->meetings, &search->meeting_room, search->meeting_count + 1, sizeof *search->meetings);
    if (search->failed)
        return false;
    search->meetings[search->meeting_count++] = met;
    return true;
}

static bool find_meetings(crack_search *search, sp_error *error)
{
    size_t count = search->stretch_count;
    sp_box *boxes = malloc((count + 1) * sizeof *boxes);
    uint32_t *list = malloc((count + 1) * sizeof *list);
    bool done = boxes && list;
    for (uint32_t i = 0; done && i < count; i++) {
        const stretch *s = &search->stretches[i];
        sp_box from = sp_box_around(point_on(search->mesh, s->half_edge, s->from), 0.5 * s->reach);
        boxes[i] = sp_box_around(point_on(search->mesh, s->half_edge, s->to), 0.5 * s->reach);
        for (int k = 0; k < 3; k++) {
            boxes[i].low[k] = sp_lesser(boxes[i].low[k], from.low[k]);
            boxes[i].high[k] = sp_greater(boxes[i].high[k], from.high[k]);
        }
        list[i] = i;
    }
    sp_error trouble = {0};
    done = done && (sp_box_pairs(boxes, list, count, meet, search, &trouble) || trouble.kind != SP_ERROR_MEMORY);
    free(boxes);
    free(list);
    return (done && !search->failed) || sp_fail_memory(error);
}

static int by_cost(const void *left, const void *right)
{
    const meeting *a = left, *b = right;
    if (a->cost != b->cost)
        return a->cost < b->cost ? -1 : 1;
    if (a->stretch[0] != b->stretch[0])
        return a->stretch[0] < b->stretch[0] ? -1 : 1;
    return (a->stretch[1] > b->stretch[1]) - (a->stretch[1] < b->stretch[1]);
}

/* Of these parts of a stretch the longest that no crack has taken. */
static void keep_free(const crack_search *search, const stretch *s, double part[2])
{
    double best[2] = {part[0], part[0]}, at = part[0];
    for (uint32_t i = s->taken; i != SP_NONE && at < part[1]; i = search->taken[i].next) {
        double end = sp_lesser(search->taken[i].from, part[1]);
        if (end - at > best[1] - best[0]) {
            best[0] = at;
            best[1] = end;
        }
        at = sp_greater(at, search->taken[i].to);
    }
    if (part[1] - at > best[1] - best[0]) {
        best[0] = at;
        best[1] = part[1];
    }
    part[0] = best[0];
    part[1] = best[1];
}

static void take(crack_search *search, stretch *s, double from, double to)
{
    uint32_t *at = &s->taken;
    while (*at != SP_NONE && search->taken[*at].from < from)
        at = &search->taken[*at].next;
    search->taken[search->taken_count] = (taken_part){from, to, *at};
    *at = (uint32_t)search->taken_count++;
}

/* Cuts a crack to these parts on one of its sides. */
static void cut_to(sp_crack *crack, int side, const double part[2])
{
    double from = crack->part[side][0], over = crack->part[side][1] - from;
    double other = crack->part[1 - side][0], each = (crack->part[1 - side][1] - other) / over;
    for (int k = 0; k < 2; k++) {
        double own = over > 0 ? part[k] : part[1 - k];
        crack->part[1 - side][k] = other + (own - from) * each;
        crack->part[side][k] = own;
    }
}

/* What is left of a meeting becomes a crack, if it is longer than wide. */
static bool settle(crack_search *search, const meeting *met)
{
    sp_crack crack = met->crack;
    stretch *of[2] = {&search->stretches[met->stretch[0]], &search->stretches[met->stretch[1]]};
    for (int side = 0; side < 2; side++) {
        double *own = crack.part[side];
        double part[2] = {sp_lesser(own[0], own[1]), sp_greater(own[0], own[1])}, whole = part[1] - part[0];
        keep_free(search, of[side], part);
        if (!(part[1] > part[0]))
            return true;
        if (part[1] - part[0] < whole)
            cut_to(&crack, side, part);
    }
    if (!(length_of(search->mesh, &crack) > sp_lesser(of[0]->reach, of[1]->reach)))
        return true;
    sp_cracks *cracks = search->cracks;
    if (!sp_grow(&cracks->cracks, &search->crack_room, cracks->count + 1, sizeof crack) ||
        !sp_grow(&search->taken, &search->taken_room, search->taken_count + 2, sizeof *search->taken))
        return false;
    for (int side = 0; side < 2; side++) {
        double *own = crack.part[side];
        take(search, of[side], sp_lesser(own[0], own[1]), sp_greater(own[0], own[1]));
    }
    assert(crack.half_edge[0] < crack.half_edge[1] && crack.part[0][0] < crack.part[0][1]);
    cracks->cracks[cracks->count++] = crack;
    return true;
}

static int by_place(const void *left, const void *right)
{
    const sp_crack_side *a = left, *b = right;
    if (a->half_edge != b->half_edge)
        return a->half_edge < b->half_edge ? -1 : 1;
    return a->from != b->from ? (a->from > b->from) - (a->from < b->from)
                              : (a->crack > b->crack) - (a->crack < b->crack);
}

/* Where one side of a crack begins or ends. */
static void move_end(sp_cracks *cracks, sp_crack_side *side, bool begins, double to)
{
    sp_crack *crack = &cracks->cracks[side->crack];
    double *part = crack->part[crack->half_edge[1] == side->half_edge];
    bool falls = part[0] > part[1];
    part[begins == falls] = to;
    *(begins ? &side->from : &side->to) = to;
}

/* Closes what is left open of an edge beside its cracks, where that is short: sides [first] up to `end`. */
static void close_rests(const crack_search *search, size_t first, size_t end)
{
    sp_cracks *cracks = search->cracks;
    sp_crack_side *sides = cracks->sides;
    double length = sp_length(step_of(search->mesh, sides[first].half_edge));
    double rest = 2 * reach_of(search, sides[first].half_edge) / length;
    if (sides[first].from <= rest)
        move_end(cracks, &sides[first], true, 0);
    for (size_t i = first + 1; i < end; i++)
        if (sides[i].from - sides[i - 1].to <= rest)
            move_end(cracks, &sides[i - 1], false, sides[i].from);
    if (1 - sides[end - 1].to <= rest)
        move_end(cracks, &sides[end - 1], false, 1);
}

static bool list_sides(const crack_search *search)
{
    sp_cracks *cracks = search->cracks;
    size_t count = 2 * cracks->count;
    cracks->sides = malloc((count + 1) * sizeof *cracks->sides);
    if (!cracks->sides)
        return false;
    for (size_t i = 0; i < count; i++) {
        const double *part = cracks->cracks[i / 2].part[i % 2];
        cracks->sides[i] = (sp_crack_side){cracks->cracks[i / 2].half_edge[i % 2], (uint32_t)(i / 2),
                                           sp_lesser(part[0], part[1]), sp_greater(part[0], part[1])};
    }
    qsort(cracks->sides, count, sizeof *cracks->sides, by_place);
    for (size_t i = 0, end; i < count; i = end) {
        for (end = i + 1; end < count && cracks->sides[end].half_edge == cracks->sides[i].half_edge;)
            end++;
        close_rests(search, i, end);
    }
    return true;
}

bool sp_cracks_find(const sp_mesh *mesh, const sp_half_edges *edges, double width, sp_cracks *cracks, sp_error *error)
{
    *cracks = (sp_cracks){0};
    crack_search search = {.mesh = mesh, .width = width, .cracks = cracks};
    bool done = list_stretches(&search, edges) && find_meetings(&search, error);
    if (done && search.meeting_count)
        qsort(search.meetings, search.meeting_count, sizeof *search.meetings, by_cost);
    for (size_t i = 0; done && i < search.meeting_count; i++)
        done = settle(&search, &search.meetings[i]);
    done = done && list_sides(&search);
    free(search.stretches);
    free(search.meetings);
    free(search.taken);
    if (done)
        return true;
    sp_cracks_free(cracks);
    return sp_fail_memory(error);
}

void sp_cracks_free(sp_cracks *cracks)
{
    free(cracks->cracks);
    free(cracks->sides);
    *cracks = (sp_cracks){0};
}

size_t sp_cracks_on(const sp_cracks *cracks, uint32_t half_edge, size_t *first)
{
    size_t low = 0, high = 2 * cracks->count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (cracks->sides[middle].half_edge < half_edge)
            low = middle + 1;
        else
            high = middle;
    }
    *first = low;
    while (high < 2 * cracks->count && cracks->sides[high].half_edge == half_edge)
        high++;
    return high;
}
