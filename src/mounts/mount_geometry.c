#include "mounts/mount_geometry.h"

#include "valid_range.h"
#include "mesh/distance.h"
#include "nozzle/valid.h"

#define TOLERANCE 4e-4      /* of the geometry's diagonal */
#define LEAN_SLACK 0.01     /* rad, by which an axis may be written too slanted */
#define STANDOFF_LEAST 1e-3 /* of the spacing: on the surface itself every line of sight would start in it */

double sp_mount_tolerance(const sp_setup *setup)
{
    sp_vec3 low, high;
    return TOLERANCE * sp_mesh_box(setup->mesh, &low, &high);
}

double sp_mount_points_along(double length, double spacing)
{
    if (!(length > 0))
        return 1;
    return spacing > 0 ? 1 + fmax(1, ceil(length / spacing * (1 - 1e-9))) : INFINITY;
}

/* A body that is as wide as the bore, to the last digits, passes it. */
static bool passes(const sp_mount *mount, const sp_nozzle_type *type)
{
    return !(mount->bore > 0) || !(type->body > mount->bore * (1 + 1e-9));
}

bool sp_mount_takes(const sp_mount *mount, const sp_nozzle_type *type)
{
    if (mount->kind != SP_MOUNT_PORT)
        return true;
    bool listed = !mount->type_count;
    for (size_t i = 0; i < mount->type_count; i++)
        listed |= mount->types[i] == type;
    return listed && passes(mount, type);
}

static bool near_line(sp_vec3 from, sp_vec3 to, sp_vec3 point, double tolerance)
{
    sp_vec3 along = sp_sub(to, from);
    double length2 = sp_dot(along, along), t = 0;
    if (length2 > 0)
        t = fmin(1, fmax(0, sp_dot(sp_sub(point, from), along) / length2));
    return sp_distance(point, sp_along(from, t, along)) <= tolerance;
}

bool sp_port_holds(const sp_mount *mount, sp_vec3 point, double tolerance)
{
    return near_line(sp_along(mount->position, mount->depth_from, mount->axis),
                     sp_along(mount->position, mount->depth_to, mount->axis), point, tolerance);
}

/* The mount's triangle that is nearest to a point. */
static uint32_t nearest_triangle(const sp_mesh *mesh, const sp_mount *mount, sp_vec3 point)
{
    uint32_t nearest = SP_NONE;
    double least = INFINITY;
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        if (!sp_mount_has(mesh, mount, t))
            continue;
        double distance = sp_distance(point, sp_triangle_nearest(mesh, t, point));
        if (distance < least) {
            nearest = t;
            least = distance;
        }
    }
    return nearest;
}

static bool surface_holds(const sp_mesh *mesh, const sp_mount *mount, sp_vec3 point, double tolerance)
{
    uint32_t triangle = nearest_triangle(mesh, mount, point);
    return triangle != SP_NONE &&
           sp_distance(point, sp_triangle_nearest(mesh, triangle, point)) <= sp_mount_standoff(mount) + tolerance;
}

static bool box_holds(const sp_mount *mount, sp_vec3 p, double tolerance)
{
    return p.x >= mount->from.x - tolerance && p.x <= mount->to.x + tolerance && p.y >= mount->from.y - tolerance &&
           p.y <= mount->to.y + tolerance && p.z >= mount->from.z - tolerance && p.z <= mount->to.z + tolerance;
}

static bool holds(const sp_setup *setup, const sp_mount *mount, sp_vec3 point, double tolerance)
{
    switch (mount->kind) {
    case SP_MOUNT_PORT:
        return sp_port_holds(mount, point, tolerance);
    case SP_MOUNT_SURFACE:
        return surface_holds(setup->mesh, mount, point, tolerance);
    case SP_MOUNT_LINE:
        return near_line(mount->from, mount->to, point, tolerance);
    case SP_MOUNT_BOX:
        return box_holds(mount, point, tolerance);
    }
    return false;
}

bool sp_mount_has(const sp_mesh *mesh, const sp_mount *mount, uint32_t triangle)
{
    uint32_t part = mesh->part[triangle];
    return mesh->parts[part].geometry == mount->geometry && (mount->part == SP_NONE || mount->part == part);
}

double sp_mount_standoff(const sp_mount *mount)
{
    return fmax(mount->standoff, STANDOFF_LEAST * mount->spacing);
}

/* How far (m) a nozzle is from where one welded to this triangle stands; INFINITY where its axis leans too far from
 * the wall's normal. */
static double off_its_stand(const sp_mesh *mesh, const sp_mount *mount, uint32_t triangle, const sp_nozzle *nozzle)
{
    sp_vec3 foot = sp_triangle_nearest(mesh, triangle, nozzle->position), out = sp_triangle_normal(mesh, triangle);
    if (sp_dot(out, sp_sub(nozzle->position, foot)) < 0)
        out = sp_scale(out, -1);
    double lean = acos(fmin(1, fmax(-1, sp_dot(out, nozzle->axis))));
    return lean > mount->tilt + LEAN_SLACK
               ? INFINITY
               : sp_distance(nozzle->position, sp_along(foot, sp_mount_standoff(mount), out));
}

uint32_t sp_mount_weld(const sp_setup *setup, const sp_mount *mount, const sp_nozzle *nozzle)
{
    const sp_mesh *mesh = setup->mesh;
    uint32_t best = SP_NONE;
    double least = INFINITY;
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        double off = sp_mount_has(mesh, mount, t) ? off_its_stand(mesh, mount, t, nozzle) : INFINITY;
        if (off < least) {
            best = t;
            least = off;
        }
    }
    return least <= sp_mount_tolerance(setup) ? best : nearest_triangle(mesh, mount, nozzle->position);
}

size_t sp_mount_at(const sp_setup *setup, const sp_mount *mounts, size_t count, sp_vec3 position)
{
    double tolerance = sp_mount_tolerance(setup);
    for (sp_mount_kind kind = SP_MOUNT_PORT; kind <= SP_MOUNT_BOX; kind++)
        for (size_t i = 0; i < count; i++)
            if (mounts[i].kind == kind && holds(setup, &mounts[i], position, tolerance))
                return i;
    return SIZE_MAX;
}

bool sp_mounts_admit(const sp_setup *setup, const sp_mount *mounts, size_t count, const sp_nozzle *nozzle,
                     sp_error *error)
{
    if (!setup || !nozzle || !sp_nozzle_is_valid(nozzle, error) ||
        !sp_is_listed((sp_owner){"", ""}, "mounts", mounts, count, error))
        return false;
    double tolerance = sp_mount_tolerance(setup);
    for (size_t i = 0; i < count; i++)
        if (mounts[i].kind == SP_MOUNT_PORT && !passes(&mounts[i], nozzle->type) &&
            sp_port_holds(&mounts[i], nozzle->position, tolerance))
            return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                           "nozzles: %s, of type '%s', is %g mm wide, expected no more than the bore of port %s, "
                           "%g mm",
                           nozzle->name, nozzle->type->name, 1e3 * nozzle->type->body, mounts[i].name,
                           1e3 * mounts[i].bore);
    return true;
}
