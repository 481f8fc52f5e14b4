/* With how many decimals a layout is written for a fitter: what can be set is written as it is set, and what is small
 * as well as what is large. */
#include "fitting_decimals.h"

#include <sprayplan/result.h>

#define MM 1e3           /* per m */
#define DEG (180 / M_PI) /* per rad */
#define BAR 1e-5         /* per Pa */
#define L_MIN 6e4        /* per m³/s */
#define MOST 9
#define ROUND_OFF 1e-6 /* of the last decimal */
#define OF_A_STEP 1e-4 /* by which a setting that no decimals write exactly, such as 1/3 deg, may be off */

static bool is_exact(double value, double parts)
{
    return fabs(value * parts - nearbyint(value * parts)) <= ROUND_OFF;
}

/* As many more as the settings `from` + k steps need, in a unit of which `per` make one of SI. */
static void add_for_steps(int *decimals, sp_step step, double from, double per)
{
    double size = per * sp_step_size(step), start = per * from;
    if (!(size > 0))
        return;
    for (double parts = pow(10, *decimals); *decimals < MOST && OF_A_STEP * size * parts < 1; parts *= 10) {
        if (is_exact(size, parts) && is_exact(start, parts))
            return;
        ++*decimals;
    }
}

/* m² of all walls that are to be cleaned. */
static double clean_area(const sp_setup *setup)
{
    const sp_mesh *mesh = setup->mesh;
    double area = 0;
    for (uint32_t t = 0; mesh && t < mesh->triangle_count; t++)
        area += setup->surfaces[mesh->part[t]].clean ? sp_triangle_area(mesh, t) : 0;
    return area;
}

sp_fitting_decimals sp_fitting_decimals_of(const sp_layout *layout, const sp_setup *setup, const sp_mount *mounts,
                                           size_t mount_count)
{
    /* lengths as the report's places, see sp_place_decimals */
    sp_fitting_decimals decimals = {
        .mm = sp_told_decimals(MM * sqrt(clean_area(setup)), 0, 4), .deg = 1, .angle_deg = 1, .bar = 2, .l_min = 2};
    for (size_t i = 0; i < mount_count; i++) {
        add_for_steps(&decimals.mm, mounts[i].depth_step, mounts[i].depth_from, MM);
        add_for_steps(&decimals.deg, mounts[i].tilt_step, 0, DEG);
    }
    for (size_t i = 0; i < layout->count; i++) {
        const sp_nozzle_type *type = layout->nozzles[i].type;
        add_for_steps(&decimals.angle_deg, type->angle_step, type->angle, DEG);
        add_for_steps(&decimals.bar, type->pressure_step, 0, BAR);
        add_for_steps(&decimals.l_min, type->flow_step, type->flow, L_MIN);
    }
    return decimals;
}
