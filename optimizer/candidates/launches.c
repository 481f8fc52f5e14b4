#include "candidates/launches.h"

#include "candidates/ranges.h"

#include <stdio.h>

typedef struct {
    sp_vec3 low, high; /* m */
} box;

static void stretch(box *box, sp_vec3 point)
{
    box->low = sp_v(fmin(box->low.x, point.x), fmin(box->low.y, point.y), fmin(box->low.z, point.z));
    box->high = sp_v(fmax(box->high.x, point.x), fmax(box->high.y, point.y), fmax(box->high.z, point.z));
}

/* Where nozzles may stand on a mount, but for a surface's. */
static void stretch_over(box *box, const sp_mount *mount)
{
    if (mount->kind == SP_MOUNT_PORT) {
        stretch(box, sp_along(mount->position, mount->depth_from, mount->axis));
        stretch(box, sp_along(mount->position, mount->depth_to, mount->axis));
    } else if (mount->kind != SP_MOUNT_SURFACE) {
        stretch(box, mount->from);
        stretch(box, mount->to);
    }
}

/* m, that the patterns of a nozzle may be off it. */
static double widest_offset(const sp_place_options *options)
{
    double widest = 0;
    for (size_t t = 0; t < options->type_count; t++)
        for (size_t i = 0; i < options->types[t]->member_count; i++)
            widest = fmax(widest, sp_length(options->types[t]->members[i].offset));
    for (size_t n = 0; options->kept && n < options->kept->count; n++)
        for (size_t i = 0; i < options->kept->nozzles[n].type->member_count; i++)
            widest = fmax(widest, sp_length(options->kept->nozzles[n].type->members[i].offset));
    return widest;
}

/* m: no flight is asked for to an end farther off. */
static double farthest_flight(const sp_evaluator *evaluator, const sp_place_options *options, const sp_sites *sites)
{
    box box;
    double moves = 0;
    sp_mesh_box(sp_evaluator_setup(evaluator)->mesh, &box.low, &box.high);
    for (size_t m = 0; m < options->mount_count; m++) {
        const sp_mount *mount = &options->mounts[m];
        stretch_over(&box, mount);
        if (mount->kind == SP_MOUNT_SURFACE) /* along it in either direction of its plane */
            moves = fmax(moves, 2 * sp_move_limit(options, mount));
    }
    for (size_t i = 0; i < sites->count; i++)
        stretch(&box, sites->items[i].position);
    for (size_t i = 0; options->kept && i < options->kept->count; i++)
        stretch(&box, options->kept->nozzles[i].position);
    return sp_distance(box.low, box.high) + moves + widest_offset(options) +
           sp_sweep_reach(&sp_evaluator_setup(evaluator)->sweep);
}

static bool add_all(sp_launch_table *table, const sp_place_options *options, sp_error *error)
{
    for (size_t t = 0; t < options->type_count; t++)
        for (size_t p = 0; p < options->pressure_count; p++) {
            const sp_nozzle_type *type = options->types[t];
            sp_nozzle nozzle = {
                .type = type, .axis = sp_v(0, 0, 1), .pressure = sp_fed_pressure(type, options->pressures[p])};
            snprintf(nozzle.name, sizeof nozzle.name, "of type %.55s", type->name);
            if (!sp_launch_table_add(table, &nozzle, error))
                return false;
        }
    for (size_t i = 0; options->kept && i < options->kept->count; i++)
        if (!sp_launch_table_add(table, &options->kept->nozzles[i], error))
            return false;
    return true;
}

sp_launch_table *sp_launches_create(const sp_evaluator *evaluator, const sp_place_options *options,
                                    const sp_sites *sites, sp_error *error)
{
    sp_launch_table *table = sp_launch_table_create(evaluator, farthest_flight(evaluator, options, sites), error);
    if (table && add_all(table, options, error))
        return table;
    sp_launch_table_destroy(table);
    return NULL;
}
