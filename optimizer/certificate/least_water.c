#include "certificate/least_water.h"

#include <math.h>

#define STEP_WATER 0.4  /* of the way to the proposal's water, for the first trial */
#define STEP_RAISED 0.1 /* of that way, that the least is sought to be raised by at first */
#define STEP_LEAST 0.02 /* and at last */
#define LESS 1e-9       /* of an area, that is as much */

bool sp_lower_water(sp_certifying *c, double area, size_t most, size_t trials, size_t rounds, sp_error *error)
{
    double step = STEP_WATER;
    for (size_t trial = 0; trial < trials; trial++) {
        size_t water = sp_bound_water(&c->bound, area);
        if (!water || water >= most)
            return true;
        if (!sp_lower_bound_in_time(c, water + (size_t)(step * (double)(most - water)), rounds,
                                    0.3 + 0.3 * (double)trial / (double)trials, error))
            return false;
        if (sp_bound_water(&c->bound, area) == water)
            step *= 0.5;
    }
    return true;
}

bool sp_raise_water(sp_certifying *c, double area, size_t most, sp_effort effort, sp_error *error)
{
    double work = 0, step = STEP_RAISED;
    for (size_t water; step > STEP_LEAST && work < effort.work && sp_certifying_has_time(c, c->done);) {
        water = sp_bound_water(&c->bound, area);
        if (!water || water >= most)
            return true;
        size_t higher = water + (size_t)ceil(step * (double)(most - water));
        work += sp_pricing_work(c, effort.rounds);
        if (!sp_lower_bound(c, higher, effort.rounds, error) ||
            (c->bound.complete && c->bound.by_water[higher] >= area &&
             !sp_look_at_layouts(c, higher, area * (1 - LESS), 0, effort, &work, error)))
            return false;
        step *= sp_bound_water(&c->bound, area) > higher ? 1 : 0.5;
    }
    return true;
}
