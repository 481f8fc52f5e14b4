#include "certificate/pose_rows.h"
#include "scoring/footprints.h"

#include <omp.h>
#include <string.h>

#define PART_MORE 5e-5f /* more than single precision puts a share at an edge wrong */

/* The share of what a texel needs that a film brings, rounded upwards. */
static inline float film_share_of(const sp_pose_pricing *pricing, uint32_t texel, float film)
{
    return fminf(1, film / pricing->film_need[texel] * pricing->upwards);
}

/* Adds what a print brings to a row of `count` entries; returns how many it has then. A texel is covered by what hits
 * it, or by its film, never by both together, so that where many nozzles suffice one way, the greater of either way's
 * shares come to 1 as well. Where a spray ends, what it covers by itself and what suffices together with others' are
 * two entries: inequalities make of them what they make of each. */
static inline size_t write_print(const sp_pose_pricing *pricing, const sp_print *print, uint32_t *texels, float *shares,
                                 size_t count)
{
    uint32_t t = print->patch;
    if (!(pricing->need[t] > 0))
        return count;
    float hits = print->hit > 0 ? sp_pose_share(pricing, t, print->hit, false) : 0,
          runs = print->film > 0 ? film_share_of(pricing, t, print->film) : 0;
    float both[] = {print->edge > 0 ? fmaxf(-print->edge - PART_MORE, -1) : 0, fmaxf(hits, runs)};
    for (int i = 0; i < 2; i++)
        if (both[i] != 0) {
            texels[count] = t;
            shares[count++] = both[i];
        }
    return count;
}

size_t sp_pose_write_field(const sp_pose_pricing *pricing, const float *field, uint32_t *texels, float *shares)
{
    size_t count = 0, patches = pricing->search->patch_count;
    for (uint32_t t = 0; t < patches; t++) {
        float hit = field[t], film = pricing->film_need ? field[patches + t] : 0;
        sp_print print = {t, hit > 0 ? hit : 0, hit < 0 ? -hit : 0, film};
        if (hit != 0 || film > 0)
            count = write_print(pricing, &print, texels, shares, count);
    }
    return count;
}

static size_t write_footprint(const sp_pose_pricing *pricing, const sp_footprint *footprint, uint32_t *texels,
                              float *shares)
{
    size_t count = 0;
    for (size_t i = 0; i < footprint->count; i++)
        count = write_print(pricing, &footprint->prints[i], texels, shares, count);
    return count;
}

size_t sp_pose_write(const sp_pose_pricing *pricing, sp_pose pose, uint32_t *texels, float *shares)
{
    return write_footprint(pricing, sp_footprints_look(pricing->search->footprints, pose), texels, shares);
}

bool sp_pose_pricing_row(const sp_pose_pricing *pricing, const float *field, uint64_t key, size_t port, uint32_t tier,
                         sp_rows *rows, sp_error *error)
{
    const sp_pose_scratch *own = &pricing->scratches[omp_get_thread_num()];
    size_t count = sp_pose_write_field(pricing, field, own->texels, own->shares);
    return sp_rows_add(rows, key, port, tier, own->texels, own->shares, count, error);
}

/* Appends the row of a pose that no pattern kernel sums. */
static bool add_footprint(const sp_pose_pricing *pricing, const sp_footprint *footprint, uint64_t key, size_t port,
                          uint32_t tier, sp_rows *rows, sp_error *error)
{
    const sp_pose_scratch *own = &pricing->scratches[omp_get_thread_num()];
    size_t count = write_footprint(pricing, footprint, own->texels, own->shares);
    return sp_rows_add(rows, key, port, tier, own->texels, own->shares, count, error);
}

bool sp_pose_pricing_found(const sp_pose_pricing *pricing, const sp_placed *placed, uint32_t tier, sp_rows *rows,
                           sp_error *error)
{
    size_t port = pricing->ports[placed->site.mount];
    return sp_type_is_uniform(placed->nozzle.type)
               ? sp_pose_pricing_row(pricing, placed->field, SP_OWN_KEY, port, tier, rows, error)
               : add_footprint(pricing, sp_placed_footprint(pricing->search, placed), SP_OWN_KEY, port, tier, rows,
                               error);
}

/* The field of a pose that the kernels sum, rounded upwards, into the thread's own. */
static void sum_pose(const sp_pose_pricing *pricing, sp_pose_scratch *own, sp_pose pose)
{
    const sp_search *search = pricing->search;
    const sp_variant *variant = &search->candidates->variants[pose.variant];
    sp_vec3 up = sp_evaluator_setup(search->coarse)->up;
    sp_nozzle nozzle = sp_pose_nozzle(search->candidates, search->sites, pose, up);
    sp_frame frame = sp_nozzle_frame(nozzle.axis, nozzle.roll, up);
    sp_view_buffer *buffer = NULL;
    own->fields.view = sp_visibility_look(search->visibility, pose.site, variant->launch, &buffer);
    memset(own->field, 0, search->field_count * sizeof *own->field);
    if (own->fields.view->start) {
        sp_region region =
            sp_region_create(&variant->spray, &frame, sp_variant_strength(search, variant), SP_POSE_SLACK);
        sp_cull_create(&search->visibility->bins, own->fields.view, &variant->spray, SP_COUNT_SHARE, &own->cull);
        sp_field_region(search, &own->fields, variant, &region, own->field);
    }
    sp_visibility_release(search->visibility, &buffer);
}

bool sp_pose_pricing_add(const sp_pose_pricing *pricing, sp_pose pose, sp_rows *rows, sp_error *error)
{
    const sp_search *search = pricing->search;
    sp_pose_scratch *own = &pricing->scratches[omp_get_thread_num()];
    size_t key = sp_pose_order_position(pricing->order, pose),
           port = pricing->ports[search->sites->items[pose.site].mount];
    uint32_t tier = sp_pose_tier(pricing, pose.site, pose.variant);
    if (!sp_type_is_uniform(search->candidates->variants[pose.variant].type))
        return add_footprint(pricing, sp_footprints_look(search->footprints, pose), key, port, tier, rows, error);
    sum_pose(pricing, own, pose);
    return sp_pose_pricing_row(pricing, own->field, key, port, tier, rows, error);
}
