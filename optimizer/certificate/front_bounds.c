#include "certificate/front_bounds.h"

#include <math.h>

#define WATER_NEAR 1.25  /* times less water is so near that the same multipliers say something */
#define WATER_LIKE 1.1   /* the same, and need not be priced for again */
#define WATER_SAME 1.015 /* the same, and what one's layouts are bounded by does for both */
#define OPEN_LEAST 1e-3  /* gap of a point of the front that is worth a turn */
#define GAPS_MOST 6      /* points that are priced for between others */
#define GAP_LEAST 0.15   /* of the bound, that this must promise */
#define REACH 1.6        /* times a gap's water, up to which its prices are to hold */

/* What of the bound at a point nothing found comes up to. */
static double open_at(const sp_certifying *c, size_t i)
{
    return fmax(0, 1 - c->points[i].found / c->bound.by_water[c->points[i].water]);
}

/* True of a point of as much water as another, or so little less that multipliers for that one do. */
static bool is_like(const sp_certifying *c, size_t i, size_t other, double times)
{
    double water = (double)c->points[i].water, most = (double)c->points[other].water;
    return water <= most && most < times * water;
}

/* The point whose like, it among them, have most open together, for their water squared, that had no turn: the fewer
 * nozzles, the more a turn says. point_count where none has any. */
static size_t next_point(const sp_certifying *c)
{
    size_t found = c->point_count;
    double most = 0;
    for (size_t i = 0; i < c->point_count; i++) {
        double open = 0;
        if (!c->points[i].water || c->points[i].had_turn || open_at(c, i) <= OPEN_LEAST)
            continue;
        for (size_t k = 0; k < c->point_count; k++)
            if (is_like(c, k, i, WATER_NEAR) && !c->points[k].had_turn && open_at(c, k) > OPEN_LEAST)
                open += open_at(c, k) / pow((double)c->points[k].water, 2);
        if (open > most) {
            found = i;
            most = open;
        }
    }
    return found;
}

/* True where the layouts of as much water, or next to no more, were looked at in this turn. */
static bool is_looked_at(const sp_certifying *c, size_t i)
{
    for (size_t k = 0; k < c->point_count; k++)
        if (c->points[k].looked_at && is_like(c, i, k, WATER_SAME))
            return true;
    return false;
}

/* A turn of a point and of those that are like it, those of most water first. */
static bool take_turn(sp_certifying *c, size_t i, sp_effort most, double *work, sp_error *error)
{
    const sp_certified_point *own = &c->points[i];
    *work += sp_pricing_work(c, most.rounds);
    if (!sp_lower_open_bound(c, own->water, open_at(c, i), most.rounds, error))
        return false;
    for (size_t k = 0; k < c->point_count; k++)
        c->points[k].looked_at = false;
    for (size_t k = c->point_count; k-- > 0 && c->bound.complete;) {
        sp_certified_point *like = &c->points[k];
        if (!like->water || like->had_turn || !is_like(c, k, i, WATER_NEAR))
            continue;
        like->had_turn = is_like(c, k, i, WATER_LIKE);
        if (open_at(c, k) <= OPEN_LEAST || is_looked_at(c, k))
            continue;
        like->looked_at = true;
        if (!sp_look_at_layouts(c, like->water, like->found, OPEN_LEAST, most, work, error))
            return false;
    }
    c->points[i].had_turn = true;
    return true;
}

bool sp_lower_front(sp_certifying *c, sp_effort most, sp_error *error)
{
    double work = 0;
    for (size_t i = 0; i < c->point_count; i++)
        c->points[i].had_turn = false;
    for (size_t i; (i = next_point(c)) < c->point_count && work < most.work;)
        if (!sp_certifying_has_time(c, 0.6 + 0.4 * fmin(1, work / most.work)))
            return true;
        else if (!take_turn(c, i, most, &work, error))
            return false;
    return true;
}

/* The point whose bound prices of its own would lower most; point_count where none would by much. */
static size_t widest_gap(const sp_certifying *c)
{
    size_t found = c->point_count;
    double most = GAP_LEAST;
    for (size_t i = 0; i < c->point_count; i++) {
        const sp_certified_point *own = &c->points[i];
        double least = fmax(sp_proved_waters_chord(&c->proved_waters, (double)own->water), own->found);
        double gain = 1 - least / c->bound.by_water[own->water];
        if (gain > most) {
            most = gain;
            found = i;
        }
    }
    return found;
}

bool sp_lower_gaps(sp_certifying *c, sp_error *error)
{
    double reach = c->bound.reach;
    bool done = true;
    c->bound.reach = REACH;
    for (size_t gap = 0, i; done && gap < GAPS_MOST && (i = widest_gap(c)) < c->point_count; gap++) {
        if (!sp_certifying_has_time(c, 1))
            break;
        done = sp_lower_open_bound(c, c->points[i].water, open_at(c, i), 1, error);
    }
    c->bound.reach = reach;
    return done;
}
