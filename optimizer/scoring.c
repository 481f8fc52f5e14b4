#include "scoring.h"

typedef struct {
    const sp_view *view;
    const float *cosine; /* [SP_BINS] */
    bool fan;
    float x[3], y[3], z[3]; /* the nozzle's frame */
    float inner, outer;     /* cones: cosines of the polar angles */
    float width, thickness; /* fans: cosine of the half-width, sine of the half-thickness */
    float strength;         /* flux over threshold per unit transfer */
} sp_sweep;

static void narrow(sp_vec3 v, float out[3])
{
    out[0] = (float)v.x;
    out[1] = (float)v.y;
    out[2] = (float)v.z;
}

static sp_sweep sweep_create(const sp_search *search, sp_pose pose)
{
    const sp_make *make = &search->candidates->makes[pose.make];
    sp_vec3 up = sp_evaluator_setup(search->coarse)->up;
    sp_nozzle nozzle = sp_pose_nozzle(search->candidates, search->sites, pose, up);
    sp_frame frame = sp_nozzle_frame(nozzle.axis, nozzle.roll, up);
    sp_sweep sweep = {
        .view = sp_visibility_view(search->visibility, pose.site, make->speed_class),
        .cosine = &search->bin_cosine[pose.make * SP_BINS],
        .fan = make->spray.kind == SP_PATTERN_FLAT_FAN,
        .inner = make->spray.inner > 0 ? (float)cos(make->spray.inner) : 2,
        .outer = (float)cos(make->spray.outer),
        .width = (float)cos(make->spray.half_width),
        .thickness = (float)sin(make->spray.half_thickness),
        .strength =
            search->threshold > 0 ? (float)(make->flow / (make->spray.solid_angle * search->threshold)) : INFINITY,
    };
    narrow(frame.x, sweep.x);
    narrow(frame.y, sweep.y);
    narrow(frame.z, sweep.z);
    return sweep;
}

/* Whether the pattern holds the direction of arrival i (DESIGN's regions, without an inverse trigonometric function).
 */
static inline bool holds(const sp_sweep *sweep, uint32_t i)
{
    const sp_view *view = sweep->view;
    float z = view->x[i] * sweep->z[0] + view->y[i] * sweep->z[1] + view->z[i] * sweep->z[2];
    if (!sweep->fan)
        return z >= sweep->outer && z <= sweep->inner;
    float y = view->x[i] * sweep->y[0] + view->y[i] * sweep->y[1] + view->z[i] * sweep->y[2];
    if (fabsf(y) > sweep->thickness)
        return false;
    float x = view->x[i] * sweep->x[0] + view->y[i] * sweep->x[1] + view->z[i] * sweep->x[2];
    return z >= sweep->width * sqrtf(x * x + z * z);
}

static inline bool bin_missed(const sp_search *search, const sp_sweep *sweep, size_t bin)
{
    const sp_bins *bins = &search->visibility->bins;
    return bins->x[bin] * sweep->z[0] + bins->y[bin] * sweep->z[1] + bins->z[bin] * sweep->z[2] < sweep->cosine[bin];
}

sp_score sp_score_pose(const sp_search *search, const float *wet, sp_pose pose)
{
    sp_sweep sweep = sweep_create(search, pose);
    const sp_view *view = sweep.view;
    sp_score score = {0};
    for (size_t b = 0; view->start && b < SP_BINS; b++) {
        if (view->start[b] == view->start[b + 1] || bin_missed(search, &sweep, b))
            continue;
        for (uint32_t i = view->start[b]; i < view->start[b + 1]; i++) {
            float had = wet[view->patch[i]];
            if (had >= 1 || !holds(&sweep, i))
                continue;
            float flux = sweep.strength * view->transfer[i];
            float has = search->single ? fmaxf(had, flux) : had + flux;
            float area = search->area[view->patch[i]], worth = sp_worth(search, had);
            score.gain += (double)(area * (sp_worth(search, has) - worth));
            score.room += (double)(area * (1 - worth));
        }
    }
    return score;
}

void sp_field_pose(const sp_search *search, sp_pose pose, float *field)
{
    sp_sweep sweep = sweep_create(search, pose);
    const sp_view *view = sweep.view;
    for (size_t p = 0; p < search->patch_count; p++)
        field[p] = 0;
    for (size_t b = 0; view->start && b < SP_BINS; b++) {
        if (bin_missed(search, &sweep, b))
            continue;
        for (uint32_t i = view->start[b]; i < view->start[b + 1]; i++)
            if (holds(&sweep, i))
                field[view->patch[i]] += sweep.strength * view->transfer[i];
    }
}

void sp_field_reach(const sp_search *search, const sp_nozzle *nozzle, const sp_reach *reach, float *field)
{
    const sp_setup *setup = sp_evaluator_setup(search->coarse);
    sp_spray spray = sp_spray_create(nozzle->type, sp_nozzle_angle(nozzle));
    sp_frame frame = sp_nozzle_frame(nozzle->axis, nozzle->roll, setup->up);
    double flow = sp_nozzle_flow(nozzle, &setup->liquid);
    for (size_t p = 0; p < search->patch_count; p++)
        field[p] = 0;
    for (size_t i = 0; i < reach->count; i++) {
        const sp_arrival *arrival = &reach->arrivals[i];
        sp_vec3 d = arrival->direction;
        double intensity = sp_spray_intensity(&spray, sp_v(sp_dot(d, frame.x), sp_dot(d, frame.y), sp_dot(d, frame.z)));
        if (arrival->passes && intensity > 0 && arrival->transfer > 0)
            field[arrival->patch] +=
                search->threshold > 0 ? (float)(flow * intensity * arrival->transfer / search->threshold) : INFINITY;
    }
}

bool sp_field_nozzle(const sp_search *search, const sp_nozzle *nozzle, float *field, sp_error *error)
{
    sp_spray spray = sp_spray_create(nozzle->type, sp_nozzle_angle(nozzle));
    double speed = sp_nozzle_speed(nozzle, &sp_evaluator_setup(search->coarse)->liquid);
    sp_reach *reach = sp_evaluator_reach(search->coarse, nozzle->position, speed, nozzle->axis,
                                         fmin(M_PI, sp_spray_reach(&spray) + 1e-6), error);
    if (!reach)
        return false;
    sp_field_reach(search, nozzle, reach, field);
    sp_reach_destroy(reach);
    return true;
}

double sp_field_gain(const sp_search *search, const float *wet, const float *field)
{
    double gain = 0;
    for (size_t p = 0; p < search->patch_count; p++)
        if (field[p] > 0 && wet[p] < 1) {
            float has = search->single ? fmaxf(wet[p], field[p]) : wet[p] + field[p];
            gain += (double)(search->area[p] * (sp_worth(search, has) - sp_worth(search, wet[p])));
        }
    return gain;
}
