/* A layout as a fitter measures it. */
#include <sprayplan/fitting.h>

#include "allowed.h"
#include "mesh/distance.h"
#include "mounts/mount_geometry.h"
#include "nozzle/pattern.h"
#include "nozzle/whole.h"

#include <stdlib.h>

#define MM 1e3               /* per m */
#define DEG (180 / M_PI)     /* per rad */
#define TENTHS 10            /* of a degree */
#define OFF_MOST 5e-4        /* m, that an azimuth's rounding may move a place by */
#define SAME_PRESSURE 1e-9   /* share by which pressures of one circuit may differ */
#define ROUND_NORMAL 0.17365 /* sine of 10 deg */
#define ROUND_SHARE (2. / 3)

static double rounded(double value, double parts)
{
    return nearbyint(value * parts) / parts + 0.0; /* no -0 */
}

/* deg in [0, whole). */
static double rounded_turn(double angle, double parts, double whole)
{
    double turn = fmod(rounded(angle * DEG, parts), whole);
    return rounded(turn < 0 ? turn + whole : turn, parts);
}

static sp_vec3 across(const sp_datum *datum)
{
    return sp_cross(datum->axis, datum->zero);
}

static sp_fitting_place place_at(const sp_setup *setup, sp_vec3 point)
{
    const sp_datum *datum = &setup->datum;
    sp_vec3 from = sp_sub(sp_setup_outside(setup, point), datum->origin);
    double x = sp_dot(from, datum->zero), y = sp_dot(from, across(datum)), radius = hypot(x, y), parts = TENTHS;
    while (radius / (2 * parts * DEG) > OFF_MOST)
        parts *= 10;
    sp_fitting_place place = {.x_mm = rounded(x * MM, 1),
                              .y_mm = rounded(y * MM, 1),
                              .height_mm = rounded(sp_dot(from, datum->axis) * MM, 1),
                              .radius_mm = rounded(radius * MM, 1)};
    place.azimuth_deg = place.radius_mm > 0 ? rounded_turn(atan2(y, x), parts, 360) : 0;
    return place;
}

static void add_fitting(sp_fitting_row *row, const sp_setup *setup)
{
    const sp_mount *mount = row->mount;
    sp_vec3 tip = row->nozzle->position;
    if (mount && mount->kind == SP_MOUNT_PORT) {
        row->depth_mm = rounded(sp_dot(sp_sub(tip, mount->position), mount->axis) * MM, 1);
        row->at = place_at(setup, mount->position);
    } else if (mount && mount->kind == SP_MOUNT_SURFACE) {
        uint32_t triangle = sp_mount_weld(setup, mount, row->nozzle);
        sp_vec3 weld = sp_triangle_nearest(setup->mesh, triangle, tip);
        row->part = setup->mesh->parts[setup->mesh->part[triangle]].name;
        row->standoff_mm = rounded(sp_distance(weld, tip) * MM, 1);
        row->at = place_at(setup, weld);
    }
    row->fitting = mount && mount->name[0] ? mount->name : row->part;
}

/* Counted from the axis as it is written, so that who draws it from that draws the same. */
static double turn_of(const sp_setup *setup, const sp_nozzle *nozzle, double towards)
{
    const sp_datum *datum = &setup->datum;
    double period = sp_type_roll_period(nozzle->type);
    if (period == 0)
        return NAN;
    sp_vec3 level = sp_sub(sp_scale(across(datum), cos(towards)), sp_scale(datum->zero, sin(towards)));
    sp_vec3 x = sp_nozzle_frame(nozzle->axis, nozzle->roll, setup->up).x;
    double turn = atan2(sp_dot(x, sp_cross(nozzle->axis, level)), sp_dot(x, level));
    return rounded_turn(turn, TENTHS, rounded(period * DEG, 1));
}

static void add_axis(sp_fitting_row *row, const sp_setup *setup)
{
    const sp_datum *datum = &setup->datum;
    sp_vec3 axis = row->nozzle->axis;
    double x = sp_dot(axis, datum->zero), y = sp_dot(axis, across(datum)), down = -sp_dot(axis, datum->axis);
    row->tilt_deg = rounded(atan2(hypot(x, y), down) * DEG, TENTHS);
    bool leans = row->tilt_deg > 0 && row->tilt_deg < 180;
    row->towards_deg = leans ? rounded_turn(atan2(y, x), TENTHS, 360) : 0;
    row->turn_deg = turn_of(setup, row->nozzle, row->towards_deg / DEG);
}

/* Where it belongs among the circuits, by rising pressure; one more where there is none yet. */
static void join_circuit(sp_fitting_sheet *sheet, const sp_nozzle *nozzle)
{
    size_t at = 0;
    while (at < sheet->circuit_count && sheet->circuits[at].pressure < nozzle->pressure * (1 - SAME_PRESSURE))
        at++;
    if (at == sheet->circuit_count || sheet->circuits[at].pressure > nozzle->pressure * (1 + SAME_PRESSURE)) {
        for (size_t i = sheet->circuit_count++; i > at; i--)
            sheet->circuits[i] = sheet->circuits[i - 1];
        sheet->circuits[at] = (sp_circuit){.pressure = nozzle->pressure};
    }
    sheet->circuits[at].flow += sp_nozzle_flow(nozzle, &sheet->setup->liquid);
    sheet->circuits[at].nozzles++;
}

static void number_circuits(sp_fitting_sheet *sheet)
{
    for (size_t i = 0; i < sheet->count; i++)
        while (sheet->circuits[sheet->rows[i].circuit].pressure < sheet->rows[i].nozzle->pressure * (1 - SAME_PRESSURE))
            sheet->rows[i].circuit++;
}

static bool is_round(const sp_setup *setup)
{
    const sp_mesh *mesh = setup->mesh;
    const sp_datum *datum = &setup->datum;
    double turning = 0, all = 0;
    for (uint32_t t = 0; mesh && t < mesh->triangle_count; t++) {
        sp_vec3 normal = sp_triangle_normal(mesh, t);
        sp_vec3 from = sp_sub(sp_setup_outside(setup, sp_triangle_point(mesh, t, 1. / 3, 1. / 3)), datum->origin);
        double area = sp_triangle_area(mesh, t), level = sp_length(sp_cross(normal, datum->axis));
        if (!setup->surfaces[mesh->part[t]].clean || !(level > ROUND_NORMAL))
            continue;
        all += area;
        turning += fabs(sp_dot(normal, sp_unit(sp_cross(datum->axis, from)))) <= ROUND_NORMAL ? area : 0;
    }
    return all > 0 && turning >= ROUND_SHARE * all;
}

sp_fitting_sheet *sp_fitting_sheet_create(const sp_layout *layout, const sp_setup *setup, const sp_mount *mounts,
                                          size_t mount_count, sp_error *error)
{
    if (!layout || !setup || !sp_layout_is_whole(layout, error) ||
        !sp_is_listed((sp_owner){"", ""}, "mounts", mounts, mount_count, error))
        return NULL;
    static const sp_fitting_place nowhere = {NAN, NAN, NAN, NAN, NAN};
    sp_fitting_sheet *sheet = calloc(1, sizeof *sheet);
    if (!sheet)
        return sp_fail_memory(error);
    *sheet = (sp_fitting_sheet){.setup = setup,
                                .count = layout->count,
                                .rows = calloc(layout->count + 1, sizeof *sheet->rows),
                                .circuits = calloc(layout->count + 1, sizeof *sheet->circuits)};
    if (!sheet->rows || !sheet->circuits) {
        sp_fitting_sheet_destroy(sheet);
        return sp_fail_memory(error);
    }
    for (size_t i = 0; i < layout->count; i++) {
        const sp_nozzle *nozzle = &layout->nozzles[i];
        size_t mount = mount_count ? sp_mount_at(setup, mounts, mount_count, nozzle->position) : SIZE_MAX;
        sheet->rows[i] = (sp_fitting_row){.nozzle = nozzle,
                                          .mount = mount == SIZE_MAX ? NULL : &mounts[mount],
                                          .part = "",
                                          .depth_mm = NAN,
                                          .standoff_mm = NAN,
                                          .at = nowhere,
                                          .tip = place_at(setup, nozzle->position)};
        add_fitting(&sheet->rows[i], setup);
        add_axis(&sheet->rows[i], setup);
        join_circuit(sheet, nozzle);
    }
    number_circuits(sheet);
    sheet->round = is_round(setup);
    return sheet;
}

void sp_fitting_sheet_destroy(sp_fitting_sheet *sheet)
{
    if (!sheet)
        return;
    free(sheet->rows);
    free(sheet->circuits);
    free(sheet);
}
