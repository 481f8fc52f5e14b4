#include "trace/parabola/parabola_hits.h"

sp_hit sp_parabola_ask(const sp_bvh *bvh, const sp_acceleration *acceleration, const sp_ray *ray, uint32_t triangle,
                       uint32_t other)
{
    sp_ray_search search = sp_ray_search_start(ray, false);
    sp_parabola parabola;
    uint32_t candidates[2] = {triangle, other};
    bool good = sp_parabola_start(&parabola, ray, acceleration, bvh->low, bvh->high);
    for (int i = 0; good && i < 2 && candidates[i] != SP_NONE; i++) {
        sp_corners corners;
        sp_bvh_corners(bvh, candidates[i], corners);
        sp_parabola_test(&parabola, (const double(*)[3])corners, candidates[i], &search);
    }
    return search.best;
}
