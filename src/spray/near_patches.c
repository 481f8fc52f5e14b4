/* A patch's pieces are halved across the longest side of their box until no cell looks broad from the source, nor
 * bends flights much at the limit of their reach. Towards the point below a nozzle that takes about as many cells for
 * every halving of the distance.
 *
 * With r the way from the source, b = v² + r·g and D = b² - g²r² (see flight.c) the limit of reach is where D is
 * 0. The slope of D is 2 (b g - g² r) = 2 (v² g - g × (r × g)), of length 2 g √(2 b v² - D), and its second derivatives
 * are no more than 2 g²; so over a distance e it changes by no more than 2 g √(2 b v² - D) e + g² e². Towards the limit
 * flights turn as √D does, and what arrives per area grows as 1/√D: over a cell there its mean is that of the one point
 * where √D is the mean of its least and most, of the share of the cell that is within reach. */
#include "near_patches.h"

#include "sure_miss.h"
#include "judged_point.h"
#include "reserve.h"
#include "spray/drag/wavefronts.h"

#include <stdlib.h>

#define RIM 0.25        /* rad, by which flights turn over a cell at the limit of their reach, about */
#define FINEST 0x1p-40  /* of the patch's length: no cell is halved below it */
#define CELLS_MOST 4096 /* of one patch: more than it takes a nanometre off a wall */
#define CLEAR 3         /* lengths of a patch, that one is within reach which the limit does not concern */
#define CORNERS 14      /* 8 of a piece, and one more for every side of a box */
#define EQUAL 1e-9      /* share by which a side is no longer than another: the first of equal ones is halved */
#define ROUND_OFF 1e-12 /* of a cell's area, that a cut may leave of nothing */

typedef enum {
    OUT_OF_REACH, /* all of it */
    FINE,
    TOO_BROAD,
} bearing;

/* D at the end of a way, with drag how far (m) it is within reach, and what goes with it. Flights sweep area in their
 * plane by `turn` times its root (m²/s) per rad. */
typedef struct {
    double value;    /* m⁴/s⁴ */
    sp_vec3 slope;   /* of it, m³/s⁴ */
    double bend;     /* half its second derivatives, at most, m²/s⁴ */
    double longest;  /* m, of a side that looks not too broad across the plane of a flight at the limit */
    double arriving; /* m/s, of that flight */
    double turn;     /* s */
} reserve;

static reserve reserve_by_parabola(const sp_source *source, sp_vec3 r)
{
    sp_vec3 gravity = source->gravity;
    double g = sp_length(gravity), distance = sp_length(r), speed = source->speed, v2 = speed * speed;
    double b = v2 + sp_dot(r, gravity), time = sqrt(2 * distance / g);
    sp_vec3 level = sp_cross(gravity, sp_cross(r, gravity)); /* g² times r's part across gravity */
    return (reserve){.value = sp_reserve(speed, r, gravity) * (b + g * distance),
                     .slope = sp_along(sp_scale(gravity, 2 * speed * speed), -2, level),
                     .bend = g * g,
                     .longest = SP_BREADTH_MOST * speed * time,
                     .arriving = sqrt(fmax(0, speed * speed + 2 * sp_dot(r, gravity))),
                     .turn = time};
}

static reserve reserve_at(const sp_source *source, sp_vec3 r)
{
    sp_wavefront_limit limit;
    if (!source->fronts)
        return reserve_by_parabola(source, r);
    if (!sp_wavefronts_limit(source->fronts, sp_v(0, 0, 0), r, &limit))
        return (reserve){.value = INFINITY};
    return (reserve){.value = limit.margin,
                     .slope = limit.slope,
                     .bend = 1 / limit.lever,
                     .longest = SP_BREADTH_MOST * limit.lever,
                     .arriving = limit.arriving,
                     .turn = limit.turn};
}

/* With drag, where the limit of reach takes longest to find: whether a square of this edge about a point surely is
 * within it. */
static bool is_clear(const sp_source *source, sp_vec3 point, double length, sp_flight flights[2])
{
    double margin;
    return source->fronts && sp_wavefronts_reach(source->fronts, source->position, point, flights, &margin) > 0 &&
           margin > CLEAR * length;
}

/* How what lies within `radius` of a point, and is `side` long, looks from the source. */
static bearing bearing_of(const sp_source *source, sp_vec3 point, double side, double radius)
{
    sp_vec3 r = sp_sub(point, source->position);
    sp_flight flights[2]; /* of which the low one looks broader */
    if (sp_length(r) <= radius)
        return TOO_BROAD;
    if (is_clear(source, point, 2 * radius, flights))
        return sp_flight_breadth(&flights[0], side) >= SP_BREADTH_MOST ? TOO_BROAD : FINE;
    if (sp_length(source->gravity) > 0) {
        reserve own = reserve_at(source, r);
        double change = sp_length(own.slope) * radius + own.bend * radius * radius;
        if (own.value < -change)
            return OUT_OF_REACH;
        if (own.value < change)
            return side > own.longest || own.arriving * side > RIM * own.turn * sqrt(change) ? TOO_BROAD : FINE;
    }
    int count = sp_source_flights(source, point, flights);
    return count > 0 && sp_flight_breadth(&flights[0], side) >= SP_BREADTH_MOST ? TOO_BROAD : FINE;
}

/* The same, without drag, rather too often than not, without roots: most patches are neither. */
static bool may_be_near(const sp_source *source, const sp_target *target)
{
    sp_vec3 gravity = source->gravity, r = sp_sub(target->point, source->position);
    double v2 = source->speed * source->speed, r2 = sp_dot(r, r), g2 = sp_dot(gravity, gravity);
    double side2 = target->length * target->length, least = SP_BREADTH_MOST * SP_BREADTH_MOST * r2;
    if (g2 == 0)
        return least <= side2;
    double b = v2 + sp_dot(r, gravity), depth = b * b - g2 * r2;
    double change2 = 2 * g2 * side2 * (4 * (2 * b * v2 - depth) + g2 * side2);
    if (depth * depth <= change2)
        return true;
    /* the short flight's squared time is r²/b or more */
    return depth > 0 && (least * v2 <= side2 * b || least * depth <= side2 * b * (2 * b - v2));
}

/* What of a flat cell's D lies on either side of 0. */
typedef struct limit {
    double least, most, half; /* m⁴/s⁴, over what is within reach, and half of how much it changes over all */
    sp_vec3 along;            /* from the cell's point to where D is the mean of what is within reach, m */
} limit;

/* False where what is about a target, as large as a square of edge `side`, does not lie across the limit of reach, nor,
 * with drag, which gathers much of a fine spray there, close to it. */
static bool limit_across(const sp_source *source, const sp_target *target, double side, limit *limit)
{
    sp_flight flights[2];
    if (is_clear(source, target->point, side, flights))
        return false;
    reserve own = reserve_at(source, sp_sub(target->point, source->position));
    sp_vec3 along = sp_along(own.slope, -sp_dot(own.slope, target->normal), target->normal);
    double steep = sp_length(along), half = 0.5 * side * steep;
    double close = source->fronts ? 2 * CLEAR * half : half;
    if (!(own.value > -half && own.value < close))
        return false;
    double most = own.value + half, least = fmax(0, own.value - half), mean = 0.5 * (sqrt(most) + sqrt(least));
    *limit = (struct limit){least, most, half, sp_scale(along, (mean * mean - own.value) / (steep * steep))};
    return true;
}

static bool is_near(const sp_source *source, const sp_target *target)
{
    limit limit;
    return bearing_of(source, target->point, target->length, target->length) == TOO_BROAD ||
           limit_across(source, target, target->length, &limit);
}

bool sp_target_is_near(const sp_source *source, const sp_target *target)
{
    return source->speed > 0 && may_be_near(source, target) && is_near(source, target);
}

bool sp_target_is_near_by(const sp_source *source, const sp_target *target, const sp_flight *flights, int count,
                          double margin)
{
    if (count > 0 && margin > CLEAR * target->length)
        return sp_flight_breadth(&flights[0], target->length) >= SP_BREADTH_MOST ||
               sp_distance(source->position, target->point) <= target->length;
    return is_near(source, target);
}

/* Convex and flat. */
typedef struct {
    int corners;
    uint32_t triangle;
    sp_vec3 corner[CORNERS];
} piece;

/* A patch while it is cut: the pieces of the cell in hand, on those of the cells that it is a part of. */
typedef struct {
    const sp_source *source;
    sp_target whole; /* the patch's */
    piece *pieces;
    size_t count, capacity;
    bool failed;
    double area;  /* m², of all */
    sp_vec3 axis; /* of the cone that is asked for */
    double half_angle;
    size_t cells;
    sp_near_visitor *visit;
    void *user;
} cutting;

static piece *next_piece(cutting *cut, uint32_t triangle)
{
    if (cut->count == cut->capacity) {
        size_t capacity = cut->capacity ? 2 * cut->capacity : 64;
        piece *pieces = realloc(cut->pieces, capacity * sizeof *pieces);
        if (!pieces) {
            cut->failed = true;
            return NULL;
        }
        cut->pieces = pieces;
        cut->capacity = capacity;
    }
    piece *next = &cut->pieces[cut->count++];
    next->corners = 0;
    next->triangle = triangle;
    return next;
}

/* One counted polygon, in pieces of few corners. */
static void take_piece(void *user, const sp_vec3 *polygon, int corners, double area)
{
    cutting *cut = user;
    (void)area;
    for (int first = 1; first + 1 < corners; first += 6) {
        piece *own = next_piece(cut, cut->whole.triangle);
        if (!own)
            return;
        own->corner[own->corners++] = polygon[0];
        for (int i = first; i < corners && i <= first + 6; i++)
            own->corner[own->corners++] = polygon[i];
    }
}

static bool take_pieces(cutting *cut, uint32_t patch)
{
    const sp_evaluator *evaluator = cut->source->evaluator;
    const sp_fragments *fragments = &evaluator->fragments;
    uint32_t texel = evaluator->patches.texel[patch];
    for (uint32_t f = fragments->start[texel]; f < fragments->start[texel + 1]; f++) {
        cut->whole.triangle = fragments->items[f].triangle;
        sp_counted_pieces(evaluator, texel, &fragments->items[f], cut->whole.side == SP_SIDE_BACK, take_piece, cut);
    }
    return !cut->failed;
}

static double coordinate(sp_vec3 p, int axis)
{
    return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

/* What of piece `from` lies on one side of a plane across an axis, on the plane itself below it, becomes a piece. */
static void clip(cutting *cut, size_t from, int axis, double plane, bool above)
{
    piece *part = next_piece(cut, cut->pieces[from].triangle);
    if (!part)
        return;
    const piece *whole = &cut->pieces[from];
    for (int i = 0; i < whole->corners; i++) {
        sp_vec3 a = whole->corner[i], b = whole->corner[(i + 1) % whole->corners];
        double at_a = coordinate(a, axis) - plane, at_b = coordinate(b, axis) - plane;
        bool has_a = above == (at_a > 0), has_b = above == (at_b > 0);
        if (has_a && part->corners < CORNERS)
            part->corner[part->corners++] = a;
        if (has_a != has_b && part->corners < CORNERS)
            part->corner[part->corners++] = sp_along(a, at_a / (at_a - at_b), sp_sub(b, a));
    }
    if (part->corners < 3)
        cut->count--;
}

/* The pieces `first` to `end`, their middle and box. */
typedef struct {
    size_t first, end;
    sp_judged_point middle;
    sp_vec3 low, high;
} cell;

static inline double lesser(double a, double b)
{
    return b < a ? b : a;
}

static cell cell_of(const cutting *cut, size_t first, size_t end)
{
    cell cell = {.first = first, .end = end, .low = {INFINITY, INFINITY, INFINITY}};
    cell.high = sp_scale(cell.low, -1);
    for (size_t i = first; i < end; i++) {
        const piece *own = &cut->pieces[i];
        sp_judged_point_add(&cell.middle, own->corner, own->corners);
        for (int k = 0; k < own->corners; k++) {
            sp_vec3 p = own->corner[k];
            cell.low = sp_v(lesser(cell.low.x, p.x), lesser(cell.low.y, p.y), lesser(cell.low.z, p.z));
            cell.high = sp_v(-lesser(-cell.high.x, -p.x), -lesser(-cell.high.y, -p.y), -lesser(-cell.high.z, -p.z));
        }
    }
    return cell;
}

static void visit_cell(cutting *cut, cell *cell)
{
    cell->middle.point = sp_judged_point_centroid(&cell->middle); /* within a piece that is alone */
    cell->middle.triangle = cut->pieces[cell->first].triangle;
    for (size_t i = cell->first; i < cell->end && cell->end - cell->first > 1; i++)
        sp_judged_point_look(&cell->middle, cut->pieces[i].corner, cut->pieces[i].corners, cut->pieces[i].triangle);
    sp_vec3 normal = sp_triangle_normal(cut->source->evaluator->setup.mesh, cell->middle.triangle);
    sp_target target = {.point = cell->middle.point,
                        .normal = cut->whole.side == SP_SIDE_BACK ? sp_scale(normal, -1) : normal,
                        .side = cut->whole.side,
                        .triangle = cell->middle.triangle,
                        .length = cut->whole.length};
    double part = cell->middle.area / cut->area;
    limit limit;
    if (limit_across(cut->source, &target, sqrt(cell->middle.area), &limit)) {
        target.point = sp_add(target.point, limit.along);
        target.moved = sp_length(limit.along);
        part *= (limit.most - limit.least) / (2 * limit.half);
    }
    cut->cells++;
    cut->visit(cut->user, &target, part);
}

/* `whole`: the area of the cell that it is cut from, m². */
static void cut_cell(cutting *cut, size_t first, size_t end, double whole)
{
    cell cell = cell_of(cut, first, end);
    if (!(cell.middle.area > ROUND_OFF * whole))
        return;
    sp_vec3 size = sp_sub(cell.high, cell.low);
    double longest = fmax(size.x, fmax(size.y, size.z)) * (1 - EQUAL);
    int axis = size.x >= longest ? 0 : size.y >= longest ? 1 : 2;
    double side = coordinate(size, axis), plane = 0.5 * (coordinate(cell.low, axis) + coordinate(cell.high, axis));
    double radius = 0.5 * sp_length(size);
    sp_vec3 middle = sp_scale(sp_add(cell.low, cell.high), 0.5);
    bearing seen = bearing_of(cut->source, middle, side, radius);
    if (seen == OUT_OF_REACH ||
        sp_spray_surely_misses(cut->source, cut->axis, cut->half_angle, NULL, 0, middle, radius))
        return;
    if (seen == FINE || side < FINEST * cut->whole.length || cut->cells >= CELLS_MOST) {
        visit_cell(cut, &cell);
        return;
    }
    for (int above = 0; above < 2 && !cut->failed; above++) {
        size_t start = cut->count;
        for (size_t i = first; i < end && !cut->failed; i++)
            clip(cut, i, axis, plane, above);
        cut_cell(cut, start, cut->count, cell.middle.area);
        cut->count = start;
    }
}

bool sp_patch_cut(const sp_source *source, uint32_t patch, sp_vec3 axis, double half_angle, sp_near_visitor *visit,
                  void *user)
{
    cutting cut = {.source = source,
                   .whole = sp_patch_target(source->evaluator, patch),
                   .axis = axis,
                   .half_angle = half_angle,
                   .visit = visit,
                   .user = user};
    bool done = take_pieces(&cut, patch);
    cut.area = cell_of(&cut, 0, cut.count).middle.area;
    if (done)
        cut_cell(&cut, 0, cut.count, 0);
    free(cut.pieces);
    return done && !cut.failed;
}
