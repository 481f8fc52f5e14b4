#include "refine/smooth_arrivals.h"

#include "nozzle/frame.h"
#include "nozzle/strength.h"

#include <assert.h>

#define FAR 8.0 /* widths beyond the edge where nothing is left of a pattern */
/* Width of the logistic step, of a patch's breadth, whose slope is that of sp_spray_share's. */
#define OWN_EDGE (SP_SPRAY_BLUR / 7.5)
#define BROAD 0.3 /* rad; patches that look broader lose what reaches beyond FAR of its width */
#define STEP 1e-6 /* share of half an unknown's range, for differences of frames and patterns */

/* All that a nozzle's arrivals share. */
typedef struct {
    const sp_search *search;
    const sp_pose_parameters *parameters;
    sp_width width;
    sp_nozzle nozzle;
    const sp_sight *sight;
    sp_spray spray;
    sp_frame frame;
    double strength; /* flux over threshold per transfer */
    double least;    /* cosine of the angle from which nothing is left */
    bool moved;      /* not where it was traced from */
    /* by unknown: axis and roll turn the frame, angle and flow change the pattern and its strength */
    sp_frame turn[SP_UNKNOWNS];
    sp_spray other[SP_UNKNOWNS];
    double step[SP_UNKNOWNS];
    double thicken[SP_UNKNOWNS]; /* derivative of log strength */
} sp_posed;

static sp_vec3 difference(sp_vec3 to, sp_vec3 from, double step)
{
    return sp_scale(sp_sub(to, from), 1 / step);
}

/* What of the pose changes with unknown k, by a difference towards the middle of its range. */
static void vary(sp_posed *posed, const double *values, size_t k)
{
    const sp_pose_parameters *parameters = posed->parameters;
    const sp_setup *setup = sp_evaluator_setup(posed->search->coarse);
    double changed[SP_UNKNOWNS], half = 0.5 * (parameters->high[k] - parameters->low[k]);
    for (size_t i = 0; i < parameters->count; i++)
        changed[i] = values[i];
    double step = copysign(STEP * half, parameters->low[k] + half - values[k]);
    changed[k] += step;
    sp_nozzle nozzle = sp_pose_parameters_nozzle(parameters, changed);
    sp_frame frame = sp_nozzle_frame(nozzle.axis, nozzle.roll, setup->up);
    assert(step != 0);
    posed->turn[k] = (sp_frame){difference(frame.x, posed->frame.x, step), difference(frame.y, posed->frame.y, step),
                                difference(frame.z, posed->frame.z, step)};
    posed->step[k] = step;
    posed->other[k] = sp_spray_create(nozzle.type, sp_nozzle_angle(&nozzle));
    double before = sp_nozzle_flow(&posed->nozzle, &setup->liquid) / posed->spray.solid_angle;
    double after = sp_nozzle_flow(&nozzle, &setup->liquid) / posed->other[k].solid_angle;
    posed->thicken[k] = (after - before) / (step * before);
}

static sp_posed pose(const sp_search *search, const sp_pose_parameters *parameters, const sp_sight *sight,
                     sp_width width, const double *values, bool slopes)
{
    const sp_setup *setup = sp_evaluator_setup(search->coarse);
    sp_posed posed = {.search = search, .parameters = parameters, .width = width, .sight = sight};
    posed.nozzle = sp_pose_parameters_nozzle(parameters, values);
    posed.spray = sp_spray_create(posed.nozzle.type, sp_nozzle_angle(&posed.nozzle));
    posed.frame = sp_nozzle_frame(posed.nozzle.axis, posed.nozzle.roll, setup->up);
    double flow = sp_nozzle_flow(&posed.nozzle, &setup->liquid);
    posed.strength = sp_strength(flow, posed.spray.solid_angle, search->threshold);
    double most = sp_spray_reach(&posed.spray) + FAR * (width.edge + OWN_EDGE * BROAD);
    posed.least = most < M_PI ? cos(most) : -2;
    posed.moved = sp_distance(posed.nozzle.position, sight->position) > 0;
    for (size_t k = 0; slopes && k < parameters->count; k++)
        vary(&posed, values, k);
    return posed;
}

/* An arrival at the nozzle's pose: where it goes, how thick it arrives, how far inside the pattern it starts. */
typedef struct {
    sp_flight flight;
    double transfer;  /* 1/m² */
    sp_vec3 local;    /* its direction in the nozzle's frame */
    double margin;    /* rad */
    sp_vec3 gradient; /* of the margin by `local`; for slopes alone */
    double edge;      /* rad, its width */
    double inside;    /* smoothed, 0 to 1 */
} sp_posed_arrival;

/* False where nothing is left of the pattern. */
static bool pose_arrival(const sp_posed *posed, const sp_arrival *seen, bool flies, bool slopes,
                         sp_posed_arrival *arrival)
{
    arrival->flight.direction = seen->direction;
    arrival->transfer = seen->transfer;
    /* from where it was traced the direction is known, and most need not be flown to be left out */
    if (!posed->moved && sp_dot(seen->direction, posed->frame.z) < posed->least)
        return false;
    if (flies &&
        !sp_sight_fly(posed->search, posed->sight, seen, posed->nozzle.position, &arrival->flight, &arrival->transfer))
        return false;
    arrival->local = sp_frame_local(&posed->frame, arrival->flight.direction);
    if (arrival->local.z < posed->least)
        return false;
    arrival->margin = sp_spray_margin_slope(&posed->spray, arrival->local, slopes ? &arrival->gradient : NULL);
    double own = OWN_EDGE * seen->breadth;
    arrival->edge = sqrt(posed->width.edge * posed->width.edge + own * own);
    assert(arrival->edge > 0);
    double widths = arrival->margin / arrival->edge;
    if (widths < -FAR)
        return false;
    arrival->inside = widths > FAR ? 1 : sp_smooth_step(widths);
    return true;
}

/* Derivatives of a flight when its start moves along `move`, without drag differentiated from |r - g t²/2| = v t; with
 * u the direction, w the velocity on arrival: t' = u·r'/u·w, u' = (r' - w t')/(v t). Returns that of log transfer, and
 * u'. */
static double shift(const sp_posed *posed, const sp_posed_arrival *arrival, const sp_arrival *seen, sp_vec3 move,
                    sp_vec3 *turn)
{
    sp_vec3 g = posed->sight->gravity;
    sp_vec3 r = sp_sub(seen->point, posed->nozzle.position), by = sp_scale(move, -1);
    sp_vec3 u = arrival->flight.direction, w = arrival->flight.velocity;
    if (posed->sight->launch.fronts) {
        sp_flight_change change = sp_wavefronts_change(posed->sight->launch.fronts, &arrival->flight, by);
        *turn = change.direction;
        return sp_dot(seen->normal, change.velocity) / sp_dot(seen->normal, w) - change.spread;
    }
    double v = posed->sight->launch.speed, t = arrival->flight.time;
    double later = sp_dot(u, by) / sp_dot(u, w);
    *turn = sp_scale(sp_along(by, -later, w), 1 / (v * t));
    sp_vec3 faster = sp_along(sp_scale(*turn, v), later, g);
    /* spread = v t² √D with b = v² + r·g, D = b² - g² r² */
    double b = v * v + sp_dot(r, g), root = arrival->flight.spread / (v * t * t);
    double d = 2 * b * sp_dot(by, g) - 2 * sp_dot(g, g) * sp_dot(r, by);
    double spread = 2 * later / t + d / (2 * root * root);
    return sp_dot(seen->normal, faster) / sp_dot(seen->normal, w) - spread;
}

/* Derivatives of logarithms by an unknown. */
typedef struct {
    double flux, share;
} sp_log_slope;

static sp_log_slope log_slope(const sp_posed *posed, const sp_posed_arrival *arrival, const sp_arrival *seen, size_t k)
{
    const sp_pose_parameters *parameters = posed->parameters;
    double edge = (1 - arrival->inside) / arrival->edge;
    sp_log_slope slope = {0, 0};
    sp_vec3 turn;
    switch (parameters->kind[k]) {
    case SP_UNKNOWN_PLACE:
        slope.flux = shift(posed, arrival, seen, parameters->move[k], &turn);
        slope.share = edge * sp_dot(arrival->gradient, sp_frame_local(&posed->frame, turn));
        break;
    case SP_UNKNOWN_AXIS:
    case SP_UNKNOWN_ROLL:
        if (edge > 0)
            slope.share = edge * sp_dot(arrival->gradient, sp_frame_local(&posed->turn[k], arrival->flight.direction));
        break;
    case SP_UNKNOWN_ANGLE:
        if (edge > 0)
            slope.share = edge * (sp_spray_margin_slope(&posed->other[k], arrival->local, NULL) - arrival->margin) /
                          posed->step[k];
        slope.flux = posed->thicken[k];
        break;
    case SP_UNKNOWN_FLOW:
        slope.flux = posed->thicken[k];
        break;
    }
    return slope;
}

/* How far the flux of an arrival suffices alone, and by how much that changes with its logarithm. */
static double alone_of(const sp_posed *posed, double flux, double *rise)
{
    *rise = 0;
    if (posed->search->threshold <= 0)
        return 1;
    double cover = sp_smooth_step(log(flux) / posed->width.coverage);
    *rise = cover * (1 - cover) / posed->width.coverage;
    return cover;
}

static void set_arrival(const sp_posed *posed, const sp_posed_arrival *arrival, const sp_arrival *seen, size_t i,
                        const sp_smooth_arrivals *arrivals)
{
    double flux = posed->strength * arrival->transfer, share = seen->part * arrival->inside, rise;
    double alone = alone_of(posed, flux, &rise);
    assert(share >= 0 && alone >= 0 && alone <= 1);
    bool sums = !posed->search->alone;
    arrivals->alone[i] = share * alone;
    arrivals->flux[i] = sums ? share * (1 - alone) * flux : 0;
    for (size_t k = 0; arrivals->alone_slope && k < posed->parameters->count; k++) {
        sp_log_slope by = log_slope(posed, arrival, seen, k);
        size_t at = k * posed->sight->count + i;
        double of_alone = share * (alone * by.share + rise * by.flux);
        double of_flux = share * flux * ((1 - alone) * (by.share + by.flux) - rise * by.flux);
        arrivals->alone_slope[at] = isfinite(of_alone) ? of_alone : 0;
        arrivals->flux_slope[at] = sums && isfinite(of_flux) ? of_flux : 0;
    }
}

/* The liquid that an arrival brings its patch, m³/s, and by how much that changes with every unknown. */
static void set_brought(const sp_posed *posed, const sp_posed_arrival *arrival, const sp_arrival *seen, size_t i,
                        const sp_brought *brought)
{
    const sp_patches *patches = sp_evaluator_patches(posed->search->coarse);
    double flow = sp_nozzle_flow(&posed->nozzle, &sp_evaluator_setup(posed->search->coarse)->liquid);
    brought->amount[i] =
        flow / posed->spray.solid_angle * arrival->transfer * arrival->inside * seen->part * patches->area[seen->patch];
    for (size_t k = 0; brought->slope && k < posed->parameters->count; k++) {
        sp_log_slope by = log_slope(posed, arrival, seen, k);
        double by_k = brought->amount[i] * (by.flux + by.share);
        brought->slope[k * posed->sight->count + i] = isfinite(by_k) ? by_k : 0;
    }
}

static void set_nothing(const sp_pose_parameters *parameters, size_t count, size_t i, double *amount, double *slope)
{
    amount[i] = 0;
    for (size_t k = 0; slope && k < parameters->count; k++)
        slope[k * count + i] = 0;
}

static bool has_place(const sp_pose_parameters *parameters)
{
    for (size_t k = 0; k < parameters->count; k++)
        if (parameters->kind[k] == SP_UNKNOWN_PLACE)
            return true;
    return false;
}

void sp_smooth_arrivals_set(const sp_search *search, const sp_pose_parameters *parameters, const sp_sight *sight,
                            sp_width width, const double *values, size_t first, size_t end,
                            const sp_smooth_arrivals *arrivals, const sp_brought *brought)
{
    bool slopes = arrivals->alone_slope != NULL;
    sp_posed posed = pose(search, parameters, sight, width, values, slopes);
    bool flies = posed.moved || (slopes && has_place(parameters));
    for (size_t i = first; i < end; i++) {
        const sp_arrival *seen = &sight->seen[i];
        sp_posed_arrival arrival = {0};
        bool there = pose_arrival(&posed, seen, flies, slopes, &arrival);
        if (there && seen->passes) {
            set_arrival(&posed, &arrival, seen, i, arrivals);
        } else {
            set_nothing(parameters, sight->count, i, arrivals->alone, arrivals->alone_slope);
            set_nothing(parameters, sight->count, i, arrivals->flux, arrivals->flux_slope);
        }
        if (brought && there)
            set_brought(&posed, &arrival, seen, i, brought);
        else if (brought)
            set_nothing(parameters, sight->count, i, brought->amount, brought->slope);
    }
}
