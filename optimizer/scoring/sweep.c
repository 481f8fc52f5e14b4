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

/* What sp_spray_share makes of a patch's greatest breadth: edges are blurred by so much on either side, and a disc not
 * broader than SPOT breadths is spread over FRINGE. A little more than there, for round-off. */
#define BLUR_HALF 0.925
#define SPOT 1.84
#define FRINGE 2.61
#define CORNER 1.32 /* √2 blurs: two of a fan's edges meet there */

static sp_rim rim_at(double angle, double beyond)
{
    double chord = fmax(0, 2 * sin(0.5 * fmin(angle, M_PI)) + beyond), edge2 = fmin(4, chord * chord);
    return (sp_rim){(float)(angle >= M_PI ? 4 : edge2), (float)(edge2 * (1 - edge2 / 4))};
}

sp_region sp_region_create(const sp_spray *spray, const sp_frame *frame, double strength, double slack)
{
    sp_region region = {.fan = spray->kind == SP_PATTERN_FLAT_FAN,
                        .height = 2,
                        .alone_from = (float)((1 - slack) / strength),
                        .alone = (float)((1 + slack) / strength)};
    if (region.fan) {
        region.height = spray->half_thickness < M_PI / 2 ? (float)(sin(spray->half_thickness) + slack) : 2;
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

/* The cosines for one bin's hole, `around` being its radius, `broadest` its patches' breadth and `blur` how far from
 * the edge these may be cut. */
static void cull_hole(double inner, double around, double broadest, double blur, float *outside, float *inside)
{
    bool spread = 2 * sin(0.5 * inner) <= SPOT * broadest;
    double within = inner - around - blur;
    *outside = !spread && within > 0 ? (float)cos(within) : 2;
    *inside = cosine_within(fmax(inner + blur, spread ? FRINGE * broadest : 0) + around);
}

/* The radii are a little too large (see sp_bins_create), so that round-off cannot put a bin on the wrong side. */
void sp_cull_create(const sp_bins *bins, const sp_view *view, const sp_spray *spray, bool generous, sp_cull *cull)
{
    double reach = sp_spray_reach(spray), chord = 2 * sin(0.5 * reach), rest = 2 * cos(0.5 * reach);
    bool fan = spray->kind == SP_PATTERN_FLAT_FAN, hole = !fan && spray->inner > 0;
    for (size_t b = 0; b < SP_BINS; b++) {
        double around = (double)bins->radius[b], broadest = (double)view->broadest[b];
        double blur = (generous ? FRINGE : BLUR_HALF) * broadest, corner = (generous ? FRINGE : CORNER) * broadest;
        bool spread = !fan && (chord <= SPOT * broadest || (reach < M_PI && rest <= SPOT * broadest));
        double beyond = fmax(reach + (fan ? corner : blur), spread ? FRINGE * broadest : 0);
        double within = reach >= M_PI ? M_PI : reach - blur - around;
        cull->outside[b] = cosine_within(beyond + around);
        cull->inside[b] = fan || spread ? 2 : cosine_within(within);
        cull->inner_outside[b] = cull->inner_inside[b] = 2;
        if (hole)
            cull_hole(spray->inner, around, broadest, blur, &cull->inner_outside[b], &cull->inner_inside[b]);
        double latitude = spray->half_thickness + blur + around;
        cull->latitude[b] = fan && latitude < M_PI / 2 ? (float)sin(latitude) : 2;
    }
}
