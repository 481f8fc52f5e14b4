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

/* A fan's longitude atan2(x, z) is within its half-width where z >= w √(x² + z²), w being the cosine, or, squared with
 * the signs kept, z|z| (1 - w²) >= w|w| x². */
sp_region sp_region_create(const sp_spray *spray, const sp_frame *frame)
{
    double w = cos(spray->half_width), s = spray->half_width < M_PI ? sin(spray->half_width) : 0;
    sp_region region = {
        .fan = spray->kind == SP_PATTERN_FLAT_FAN,
        .inner = spray->inner > 0 ? (float)cos(spray->inner) : 2,
        .outer = spray->outer < M_PI ? (float)cos(spray->outer) : -2,
        .width = (float)(w * fabs(w)),
        .narrow = (float)(s * s),
        .thickness = spray->half_thickness < M_PI / 2 ? (float)sin(spray->half_thickness) : 2,
    };
    sp_region_turn(&region, frame);
    return region;
}

void sp_region_turn(sp_region *region, const sp_frame *frame)
{
    narrow(frame->x, region->x);
    narrow(frame->y, region->y);
    narrow(frame->z, region->z);
}

bool sp_region_holds(const sp_region *region, float x, float y, float z)
{
    const float *a = region->z, *b = region->y, *c = region->x;
    float along = x * a[0] + y * a[1] + z * a[2];
    if (!region->fan)
        return along >= region->outer && along <= region->inner;
    float up = x * b[0] + y * b[1] + z * b[2], across = x * c[0] + y * c[1] + z * c[2];
    return fabsf(up) <= region->thickness && along * fabsf(along) * region->narrow >= across * across * region->width;
}

/* The radii are a little too large (see visibility.c), so that round-off cannot put a bin on the wrong side. */
void sp_cull_create(const sp_bins *bins, const sp_spray *spray, sp_cull *cull)
{
    double reach = sp_spray_reach(spray);
    bool fan = spray->kind == SP_PATTERN_FLAT_FAN;
    for (size_t b = 0; b < SP_BINS; b++) {
        double radius = (double)bins->radius[b];
        double beyond = reach + radius, within = reach >= M_PI ? M_PI : reach - radius;
        cull->outside[b] = beyond >= M_PI ? -2 : (float)cos(beyond);
        cull->inside[b] = fan || within < 0 ? 2 : within >= M_PI ? -2 : (float)cos(within);
        bool hole = !fan && spray->inner > 0;
        cull->inner_outside[b] = hole && spray->inner > radius ? (float)cos(spray->inner - radius) : 2;
        cull->inner_inside[b] = !hole ? 2 : spray->inner + radius < M_PI ? (float)cos(spray->inner + radius) : -2;
        double latitude = spray->half_thickness + radius;
        cull->latitude[b] = fan && latitude < M_PI / 2 ? (float)sin(latitude) : 2;
    }
}
