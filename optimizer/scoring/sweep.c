#include "scoring/sweep.h"

#include <assert.h>

#if defined __x86_64__ && defined __GNUC__
extern const sp_sweep_set sp_sweep_avx512, sp_sweep_avx2;
#define WIDER &sp_sweep_avx512, &sp_sweep_avx2,
#else
#define WIDER
#endif
extern const sp_sweep_set sp_sweep_plain;

const sp_sweep_set *const sp_sweep_sets[] = {WIDER & sp_sweep_plain};
const size_t sp_sweep_set_count = sizeof sp_sweep_sets / sizeof *sp_sweep_sets;

const sp_sweep_set *sp_sweep_best(void)
{
    size_t i = 0;
    while (!sp_sweep_sets[i]->available())
        i++;
    return sp_sweep_sets[i];
}

static void narrow(sp_vec3 v, float out[3])
{
    out[0] = (float)v.x;
    out[1] = (float)v.y;
    out[2] = (float)v.z;
}

static sp_rim rim_at(double angle, double beyond)
{
    double chord = fmax(0, 2 * sin(0.5 * fmin(angle, M_PI)) + beyond), edge2 = angle >= M_PI ? 4 : chord * chord;
    double sine2 = fmax(edge2 * (1 - edge2 / 4), 1e-30);
    return (sp_rim){(float)edge2, (float)(1 / (2 * SP_SPRAY_BLUR * sqrt(sine2)))};
}

sp_region sp_region_create(const sp_spray *spray, const sp_frame *frame, double strength, double slack)
{
    assert(strength >= 0 && slack >= 0 && spray->inner >= 0); /* strength 0: nothing covers alone, of goods that move */
    sp_region region = {.fan = spray->kind == SP_PATTERN_FLAT_FAN,
                        .height = 2,
                        .alone_from = (float)((1 - slack) / strength),
                        .alone = (float)((1 + slack) / strength)};
    if (region.fan) {
        region.height = spray->half_thickness < M_PI / 2 ? (float)(sin(spray->half_thickness) + slack) : 2;
        region.rise = (float)(1 / (SP_SPRAY_BLUR * cos(fmin(spray->half_thickness, 0.499 * M_PI))));
        region.wide = cos(spray->half_width) < 0;
        region.all_round = spray->half_width >= M_PI;
        region.end_cosine = (float)cos(spray->half_width + slack);
        region.end_sine = (float)sin(spray->half_width + slack);
    } else {
        region.outer = rim_at(spray->outer, slack);
        region.inner = spray->inner > 0 ? rim_at(spray->inner, -slack) : (sp_rim){0, 0};
    }
    sp_region_turn(&region, frame);
    return region;
}

void sp_region_turn(sp_region *region, const sp_frame *frame)
{
    narrow(frame->z, region->z);
    if (!region->fan)
        return;
    narrow(frame->y, region->y);
    sp_vec3 along = sp_scale(frame->z, (double)region->end_sine);
    narrow(sp_along(along, -(double)region->end_cosine, frame->x), region->end[0]);
    narrow(sp_along(along, (double)region->end_cosine, frame->x), region->end[1]);
}

static float cosine_within(double angle)
{
    return angle >= M_PI ? -2 : angle < 0 ? 2 : (float)cos(angle);
}

/* The same for one bin, where patches look broad against the pattern, or the region is generous. */
static void cull_broad(double around, double broadest, const sp_spray *spray, sp_count count, size_t b, sp_cull *cull)
{
    double reach = sp_spray_reach(spray), far = SP_VIEW_FRINGE * broadest,
           near = count == SP_COUNT_GENEROUS ? far : SP_VIEW_BLUR * broadest;
    bool fan = spray->kind == SP_PATTERN_FLAT_FAN;
    cull->outside[b] = cosine_within(fmax(reach + near, fan ? 0 : far) + around);
    cull->inside[b] = reach >= M_PI && !fan ? -2 : 2;
    cull->inner_outside[b] = 2;
    cull->inner_inside[b] = !fan && spray->inner > 0 ? cosine_within(fmax(spray->inner + near, far) + around) : 2;
    double latitude = spray->half_thickness + near + around;
    cull->latitude[b] = fan && latitude < M_PI / 2 ? (float)sin(latitude) : 2;
}

/* A polar angle's cosine and sine, once for all bins. */
typedef struct {
    float cosine, sine;
} sp_turned;

static sp_turned turned(double angle)
{
    return (sp_turned){(float)cos(angle), (float)sin(angle)};
}

/* Cosines of `angle` more and less what a bin, or block, takes; past half a turn and below none what no cosine comes up
 * to. Sums are made in any case, so that compilers take many at a time. */
static void set_more(sp_turned angle, const float *restrict cosine, const float *restrict sine, size_t count,
                     float *restrict cosines)
{
    for (size_t i = 0; i < count; i++) {
        float more = angle.cosine * cosine[i] - angle.sine * sine[i];
        cosines[i] = cosine[i] <= -angle.cosine ? -2 : more;
    }
}
static void set_less(sp_turned angle, const float *restrict cosine, const float *restrict sine, float *restrict cosines)
{
    for (size_t b = 0; b < SP_BINS; b++) {
        float less = angle.cosine * cosine[b] + angle.sine * sine[b];
        cosines[b] = cosine[b] < angle.cosine ? 2 : less;
    }
}

static void set_all(float value, size_t count, float *cosines)
{
    for (size_t i = 0; i < count; i++)
        cosines[i] = value;
}

/* Where a pattern of this reach ends; for fans nothing is wholly inside. */
static void cull_reach(const sp_view *view, double reach, bool fan, sp_cull *cull)
{
    sp_turned outer = turned(fmin(reach, M_PI));
    if (reach >= M_PI) {
        set_all(-2, SP_BINS, cull->outside);
        set_all(-2, SP_BLOCKS, cull->near);
    } else {
        set_more(outer, view->cosine, view->sine, SP_BINS, cull->outside);
        set_more(outer, view->block_cosine, view->block_sine, SP_BLOCKS, cull->near);
    }
    if (fan || reach >= M_PI)
        set_all(fan ? 2 : -2, SP_BINS, cull->inside);
    else
        set_less(outer, view->cosine, view->sine, cull->inside);
}

/* Where a cone is hollow. */
static void cull_hole(const sp_view *view, double hole, sp_cull *cull)
{
    sp_turned inner = turned(hole);
    if (hole > 0) {
        set_less(inner, view->cosine, view->sine, cull->inner_outside);
        set_more(inner, view->cosine, view->sine, SP_BINS, cull->inner_inside);
    } else {
        set_all(2, SP_BINS, cull->inner_outside);
        set_all(2, SP_BINS, cull->inner_inside);
    }
}

/* Sines of the latitudes up to which a fan of this half-thickness reaches. */
static void set_latitude(sp_turned side, const float *restrict cosine, const float *restrict sine, size_t count,
                         float *restrict latitude)
{
    for (size_t i = 0; i < count; i++) {
        float more = side.sine * cosine[i] + side.cosine * sine[i];
        latitude[i] = cosine[i] > 0 && sine[i] < side.cosine ? more : 2;
    }
}

/* A cone reaches all latitudes. */
static void cull_sides(const sp_view *view, bool fan, double half_thickness, sp_cull *cull)
{
    sp_turned side = turned(half_thickness);
    if (fan) {
        set_latitude(side, view->cosine, view->sine, SP_BINS, cull->latitude);
        set_latitude(side, view->block_cosine, view->block_sine, SP_BLOCKS, cull->near_latitude);
    } else {
        set_all(2, SP_BINS, cull->latitude);
        set_all(2, SP_BLOCKS, cull->near_latitude);
    }
}

/* Breadth from which patches look broad against a pattern. */
static float broad_against(double reach, double hole)
{
    double chord = fmin(2 * sin(0.5 * reach), reach >= M_PI ? 2 : 2 * cos(0.5 * reach));
    float broad = (float)(chord / SP_VIEW_SPOT);
    return hole > 0 ? fminf(broad, (float)(2 * sin(0.5 * hole) / SP_VIEW_SPOT)) : broad;
}

/* The radii are a little too large (see sp_bins_create), so that round-off cannot put a bin on the wrong side. */
void sp_cull_create(const sp_bins *bins, const sp_view *view, const sp_spray *spray, sp_count count, sp_cull *cull)
{
    bool fan = spray->kind == SP_PATTERN_FLAT_FAN;
    double reach = sp_spray_reach(spray), hole = fan ? 0 : spray->inner;
    /* beyond a corner of a fan more is blurred than beyond its edges */
    double corner = fan ? (SP_VIEW_CORNER - SP_VIEW_BLUR) * (double)view->most : 0;
    float broad = fan ? INFINITY : broad_against(reach, hole);
    cull_reach(view, reach + corner, fan, cull);
    cull_hole(view, hole, cull);
    cull_sides(view, fan, spray->half_thickness, cull);
    for (size_t b = 0; b < SP_BINS; b++)
        if (count == SP_COUNT_GENEROUS || view->broadest[b] >= broad) {
            cull_broad((double)bins->radius[b], (double)view->broadest[b], spray, count, b, cull);
            cull->near[b / SP_LANES] = -2;
            cull->near_latitude[b / SP_LANES] = 2;
        }
}
