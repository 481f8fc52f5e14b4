#include "scoring/pattern_kernels.h"

#include <assert.h>

#if defined __x86_64__ && defined __GNUC__
extern const sp_pattern_kernels sp_pattern_kernels_avx512, sp_pattern_kernels_avx2;
#define WIDER &sp_pattern_kernels_avx512, &sp_pattern_kernels_avx2,
#else
#define WIDER
#endif
extern const sp_pattern_kernels sp_pattern_kernels_plain;

const sp_pattern_kernels *const sp_pattern_kernel_sets[] = {WIDER & sp_pattern_kernels_plain};
const size_t sp_pattern_kernel_set_count = sizeof sp_pattern_kernel_sets / sizeof *sp_pattern_kernel_sets;

const sp_pattern_kernels *sp_pattern_kernels_best(void)
{
    size_t i = 0;
    while (!sp_pattern_kernel_sets[i]->available())
        i++;
    return sp_pattern_kernel_sets[i];
}

sp_region sp_region_create(const sp_spray *spray, const sp_frame *frame, double strength, double slack)
{
    assert(strength >= 0 && slack >= 0); /* strength 0: nothing covers alone, of goods that move */
    return (sp_region){.outline = sp_spray_outline(spray, frame, slack),
                       .alone_from = (float)((1 - slack) / strength),
                       .alone = (float)((1 + slack) / strength)};
}

static float cosine_within(double angle)
{
    return angle >= M_PI ? -2 : angle < 0 ? 2 : (float)cos(angle);
}

/* What cuts bins off. Angles in rad. */
typedef struct {
    bool flat;                    /* it does not hold all between its hole and its reach */
    double reach, hole, latitude; /* the last two: within which, and beyond which on either side, nothing is sprayed */
} limits;

static limits limits_of(const sp_spray *spray)
{
    return (limits){!sp_spray_is_round(spray), sp_spray_reach(spray), spray->low, sp_spray_latitude(spray)};
}

/* The same for one bin, where patches look broad against the pattern, or the region is generous. */
static void cull_broad(double around, double broadest, const limits *own, sp_count count, size_t b, sp_cull *cull)
{
    double far = SP_OUTLINE_FRINGE * broadest, near = count == SP_COUNT_GENEROUS ? far : SP_OUTLINE_BLUR * broadest;
    cull->outside[b] = cosine_within(fmax(own->reach + near, own->flat ? 0 : far) + around);
    cull->inside[b] = own->reach >= M_PI && !own->flat ? -2 : 2;
    cull->inner_outside[b] = 2;
    cull->inner_inside[b] = own->hole > 0 ? cosine_within(fmax(own->hole + near, far) + around) : 2;
    double latitude = own->latitude + near + around;
    cull->latitude[b] = latitude < M_PI / 2 ? (float)sin(latitude) : 2;
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

/* Where a pattern of this reach ends; of flat ones nothing is wholly inside. */
static void cull_reach(const sp_view *view, double reach, bool flat, sp_cull *cull)
{
    sp_turned outer = turned(fmin(reach, M_PI));
    if (reach >= M_PI) {
        set_all(-2, SP_BINS, cull->outside);
        set_all(-2, SP_BLOCKS, cull->near);
    } else {
        set_more(outer, view->cosine, view->sine, SP_BINS, cull->outside);
        set_more(outer, view->block_cosine, view->block_sine, SP_BLOCKS, cull->near);
    }
    if (flat || reach >= M_PI)
        set_all(flat ? 2 : -2, SP_BINS, cull->inside);
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

/* Sines of the latitudes up to which a pattern of this half-thickness reaches. */
static void set_latitude(sp_turned side, const float *restrict cosine, const float *restrict sine, size_t count,
                         float *restrict latitude)
{
    for (size_t i = 0; i < count; i++) {
        float more = side.sine * cosine[i] + side.cosine * sine[i];
        latitude[i] = cosine[i] > 0 && sine[i] < side.cosine ? more : 2;
    }
}

static void cull_sides(const sp_view *view, bool flat, double half_thickness, sp_cull *cull)
{
    sp_turned side = turned(half_thickness);
    if (flat) {
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
    float broad = (float)(chord / SP_OUTLINE_SPOT);
    return hole > 0 ? fminf(broad, (float)(2 * sin(0.5 * hole) / SP_OUTLINE_SPOT)) : broad;
}

/* The radii are a little too large (see sp_bins_create), so that round-off cannot put a bin on the wrong side. */
void sp_cull_create(const sp_bins *bins, const sp_view *view, const sp_spray *spray, sp_count count, sp_cull *cull)
{
    limits own = limits_of(spray);
    /* beyond a corner more is blurred than beyond its edges */
    double corner = own.flat ? (SP_OUTLINE_CORNER - SP_OUTLINE_BLUR) * (double)view->most : 0;
    float broad = own.flat ? INFINITY : broad_against(own.reach, own.hole);
    cull_reach(view, own.reach + corner, own.flat, cull);
    cull_hole(view, own.hole, cull);
    cull_sides(view, own.flat, own.latitude, cull);
    for (size_t b = 0; b < SP_BINS; b++)
        if (count == SP_COUNT_GENEROUS || view->broadest[b] >= broad) {
            cull_broad((double)bins->radius[b], (double)view->broadest[b], &own, count, b, cull);
            cull->near[b / SP_LANES] = -2;
            cull->near_latitude[b / SP_LANES] = 2;
        }
}
