/* A layout as a fitter measures it. */
#include <sprayplan/fitting.h>

#include "valid_range.h"
#include "fitting_decimals.h"
#include "mesh/distance.h"
#include "mounts/mount_geometry.h"
#include "nozzle/pattern.h"
#include "nozzle/valid.h"

#include <stdlib.h>

#define MM 1e3               /* per m */
#define DEG (180 / M_PI)     /* per rad */
#define OFF_MOST 0.5         /* of a length's last decimal, that an azimuth's rounding may move a place by */
#define ROUND_OFF 1e-6       /* of the last decimal, by which what was computed may lie below what it stands for */
#define SAME_PRESSURE 1e-9   /* share by which pressures of one circuit may differ */
#define ROUND_NORMAL 0.17365 /* sine of 10 deg */
#define ROUND_SHARE (2. / 3)

/* Halves upwards, of negative numbers as well: lengths that differ by a number of these decimals do so when rounded. */
static double rounded(double value, int decimals)
{
    double parts = pow(10, decimals);
    return floor(value * parts + 0.5 + ROUND_OFF) / parts;
}

/* deg in [0, whole). */
static double rounded_turn(double angle, int decimals, double whole)
{
    double turn = fmod(rounded(angle * DEG, decimals), whole);
    return rounded(turn < 0 ? turn + whole : turn, decimals);
}

static sp_vec3 across(const sp_datum *datum)
{
    return sp_cross(datum->axis, datum->zero);
}

static sp_fitting_place place_at(const sp_fitting_sheet *sheet, sp_vec3 point)
{
    const sp_datum *datum = &sheet->setup->datum;
    sp_vec3 from = sp_sub(sp_setup_outside(sheet->setup, point), datum->origin);
    double x = sp_dot(from, datum->zero), y = sp_dot(from, across(datum)), radius = hypot(x, y);
    int mm = sheet->decimals.mm, deg = 1;
    while (radius * MM * pow(10, mm) / (2 * pow(10, deg) * DEG) > OFF_MOST)
        deg++;
    sp_fitting_place place = {.x_mm = rounded(x * MM, mm),
                              .y_mm = rounded(y * MM, mm),
                              .height_mm = rounded(sp_dot(from, datum->axis) * MM, mm),
                              .radius_mm = rounded(radius * MM, mm)};
    place.azimuth_deg = place.radius_mm > 0 ? rounded_turn(atan2(y, x), deg, 360) : 0;
    return place;
}

/* In a port; returns where the tip comes to lie with that depth. */
static sp_vec3 set_lance(sp_fitting_row *row, const sp_fitting_sheet *sheet)
{
    const sp_mount *port = row->mount;
    sp_vec3 tip = row->nozzle->position;
    double depth = sp_dot(sp_sub(tip, port->position), port->axis);
    row->depth_mm = rounded(depth * MM, sheet->decimals.mm);
    row->at = place_at(sheet, port->position);
    return sp_along(tip, row->depth_mm / MM - depth, port->axis);
}

/* The same on a surface, with that standoff. */
static sp_vec3 set_weld(sp_fitting_row *row, const sp_fitting_sheet *sheet)
{
    const sp_mesh *mesh = sheet->setup->mesh;
    sp_vec3 tip = row->nozzle->position;
    uint32_t triangle = sp_mount_weld(sheet->setup, row->mount, row->nozzle);
    sp_vec3 weld = sp_triangle_nearest(mesh, triangle, tip);
    double standoff = sp_distance(weld, tip);
    row->part = mesh->parts[mesh->part[triangle]].name;
    row->standoff_mm = rounded(standoff * MM, sheet->decimals.mm);
    row->at = place_at(sheet, weld);
    return standoff > 0 ? sp_along(weld, row->standoff_mm / MM / standoff, sp_sub(tip, weld)) : tip;
}

static void add_fitting(sp_fitting_row *row, const sp_fitting_sheet *sheet)
{
    const sp_mount *mount = row->mount;
    sp_vec3 tip = row->nozzle->position;
    if (mount && mount->kind == SP_MOUNT_PORT)
        tip = set_lance(row, sheet);
    else if (mount && mount->kind == SP_MOUNT_SURFACE)
        tip = set_weld(row, sheet);
    row->tip = place_at(sheet, tip);
    row->fitting = mount && mount->name[0] ? mount->name : row->part;
}

/* Counted from the axis as it is written, so that who draws it from that draws the same. */
static double turn_of(const sp_fitting_sheet *sheet, const sp_nozzle *nozzle, double towards)
{
    const sp_datum *datum = &sheet->setup->datum;
    double period = sp_type_roll_period(nozzle->type);
    if (period == 0)
        return NAN;
    sp_vec3 level = sp_sub(sp_scale(across(datum), cos(towards)), sp_scale(datum->zero, sin(towards)));
    sp_vec3 x = sp_nozzle_frame(nozzle->axis, nozzle->roll, sheet->setup->up).x;
    double turn = atan2(sp_dot(x, sp_cross(nozzle->axis, level)), sp_dot(x, level));
    return rounded_turn(turn, sheet->decimals.deg, rounded(period * DEG, 0));
}

static void add_axis(sp_fitting_row *row, const sp_fitting_sheet *sheet)
{
    const sp_datum *datum = &sheet->setup->datum;
    int deg = sheet->decimals.deg;
    sp_vec3 axis = row->nozzle->axis;
    double x = sp_dot(axis, datum->zero), y = sp_dot(axis, across(datum)), down = -sp_dot(axis, datum->axis);
    row->tilt_deg = rounded(atan2(hypot(x, y), down) * DEG, deg);
    bool leans = row->tilt_deg > 0 && row->tilt_deg < 180;
    row->towards_deg = leans ? rounded_turn(atan2(y, x), deg, 360) : 0;
    row->turn_deg = turn_of(sheet, row->nozzle, row->towards_deg / DEG);
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
    if (!layout || !setup || !sp_layout_is_valid(layout, error) ||
        !sp_is_listed((sp_owner){"", ""}, "mounts", mounts, mount_count, error))
        return NULL;
    static const sp_fitting_place nowhere = {NAN, NAN, NAN, NAN, NAN};
    sp_fitting_sheet *sheet = calloc(1, sizeof *sheet);
    if (!sheet)
        return sp_fail_memory(error);
    *sheet = (sp_fitting_sheet){.setup = setup,
                                .decimals = sp_fitting_decimals_of(layout, setup, mounts, mount_count),
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
                                          .at = nowhere};
        add_fitting(&sheet->rows[i], sheet);
        add_axis(&sheet->rows[i], sheet);
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
