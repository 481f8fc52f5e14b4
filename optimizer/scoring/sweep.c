#include "scoring/sweep.h"

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

/* Cosines of `angle` more and less what a bin takes; past half a turn and below none what no cosine comes up to. */
static inline float cosine_more(sp_turned angle, float cosine, float sine)
{
    return cosine <= -angle.cosine ? -2 : angle.cosine * cosine - angle.sine * sine;
}
static inline float cosine_less(sp_turned angle, float cosine, float sine)
{
    return cosine < angle.cosine ? 2 : angle.cosine * cosine + angle.sine * sine;
}

/* The radii are a little too large (see sp_bins_create), so that round-off cannot put a bin on the wrong side. */
void sp_cull_create(const sp_bins *bins, const sp_view *view, const sp_spray *spray, sp_count count, sp_cull *cull)
{
    double reach = sp_spray_reach(spray);
    bool fan = spray->kind == SP_PATTERN_FLAT_FAN, all_round = reach >= M_PI, hole = !fan && spray->inner > 0;
    /* beyond a corner of a fan more is blurred than beyond its edges */
    double corner = fan ? (SP_VIEW_CORNER - SP_VIEW_BLUR) * (double)view->most : 0;
    sp_turned outer = turned(fmin(reach + corner, M_PI)), inner = turned(spray->inner),
              side = turned(spray->half_thickness);
    float broad = (float)(fmin(2 * sin(0.5 * reach), all_round ? 2 : 2 * cos(0.5 * reach)) / SP_VIEW_SPOT);
    if (hole)
        broad = fminf(broad, (float)(2 * sin(0.5 * spray->inner) / SP_VIEW_SPOT));
    for (size_t b = 0; b < SP_BINS; b++) {
        float c = view->cosine[b], s = view->sine[b];
        cull->outside[b] = all_round || reach + corner >= M_PI ? -2 : cosine_more(outer, c, s);
        cull->inside[b] = fan ? 2 : all_round ? -2 : cosine_less(outer, c, s);
        cull->inner_outside[b] = hole ? cosine_less(inner, c, s) : 2;
        cull->inner_inside[b] = hole ? cosine_more(inner, c, s) : 2;
        cull->latitude[b] = fan && s < side.cosine ? side.sine * c + side.cosine * s : 2;
    }
    for (size_t b = 0; b < SP_BINS; b++)
        if (count == SP_COUNT_GENEROUS || (!fan && view->broadest[b] >= broad))
            cull_broad((double)bins->radius[b], (double)view->broadest[b], spray, count, b, cull);
}
