/* Layouts: which nozzles there are. */
#include <sprayplan/nozzle.h>
#include <sprayplan/vector.h>

#include <stdlib.h>
#include <string.h>

sp_layout *sp_layout_create(const sp_nozzle *nozzles, size_t count, sp_error *error)
{
    sp_layout *layout = calloc(1, sizeof *layout);
    sp_nozzle *copies = calloc(count ? count : 1, sizeof *copies);
    if (!layout || !copies) {
        free(layout);
        free(copies);
        return sp_fail_memory(error);
    }
    if (nozzles && count)
        memcpy(copies, nozzles, count * sizeof *copies);
    layout->count = count;
    layout->nozzles = copies;
    return layout;
}

void sp_layout_destroy(sp_layout *layout)
{
    if (!layout)
        return;
    free(layout->nozzles);
    free(layout);
}

/* Neither is NaN. */
static bool is_same(double a, double b)
{
    return !(fabs(a - b) > 0);
}

static bool stand_alike(const sp_nozzle *a, const sp_nozzle *b)
{
    return sp_distance(a->position, b->position) <= 0 && sp_distance(a->axis, b->axis) <= 0 &&
           is_same(a->roll, b->roll);
}

bool sp_nozzles_spray_alike(const sp_nozzle *a, const sp_nozzle *b)
{
    return a->type == b->type && stand_alike(a, b) && is_same(a->pressure, b->pressure) &&
           is_same(a->angle, b->angle) && is_same(a->flow, b->flow) && is_same(a->speed, b->speed);
}

static bool turn_alike(const sp_rotation *a, const sp_rotation *b)
{
    return a->jet == b->jet && is_same(a->tilt, b->tilt) && is_same(a->roll, b->roll) && a->jets == b->jets &&
           a->gears[0] == b->gears[0] && a->gears[1] == b->gears[1] && is_same(a->speed, b->speed) &&
           a->turns == b->turns;
}

static double angle_of(const sp_nozzle *nozzle)
{
    return nozzle->angle > 0 ? nozzle->angle : nozzle->type->angle;
}

/* Whether what leaves them has one shape, and flies on in one way where it is as fast. */
static bool are_shaped_alike(const sp_nozzle *a, const sp_nozzle *b)
{
    const sp_nozzle_type *one = a->type, *other = b->type;
    if (!is_same(angle_of(a), angle_of(b)))
        return false;
    return one == other || (one->pattern == other->pattern && one->pattern != SP_PATTERN_CLUSTER &&
                            one->patternation == other->patternation && is_same(one->hollow, other->hollow) &&
                            is_same(one->thickness, other->thickness) && turn_alike(&one->rotation, &other->rotation) &&
                            one->trajectory == other->trajectory && is_same(one->drop, other->drop));
}

bool sp_nozzles_share_edges(const sp_nozzle *a, const sp_nozzle *b, const sp_fluid *liquid)
{
    return stand_alike(a, b) && are_shaped_alike(a, b) &&
           is_same(sp_nozzle_speed(a, liquid), sp_nozzle_speed(b, liquid));
}

bool sp_layout_repeats(const sp_layout *layout, size_t i, const sp_fluid *liquid)
{
    const sp_nozzle *own = &layout->nozzles[i];
    for (size_t k = 0; k < layout->count; k++) {
        const sp_nozzle *other = &layout->nozzles[k];
        if (k == i || !sp_nozzles_share_edges(other, own, liquid))
            continue;
        double more = sp_nozzle_flow(other, liquid) - sp_nozzle_flow(own, liquid);
        if (more > 0 || (!(more < 0) && k < i))
            return true;
    }
    return false;
}

double sp_layout_flow(const sp_layout *layout, const sp_fluid *liquid)
{
    double flow = 0;
    for (size_t i = 0; i < layout->count; i++)
        flow += sp_nozzle_flow(&layout->nozzles[i], liquid);
    return flow;
}
