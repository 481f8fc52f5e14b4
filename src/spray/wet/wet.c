/* Wet sides, in four steps. Shells that are closed and consistently turned are solids. Triangles are cut where others
 * cross or touch them, so that each side of each face looks into one space. A side that looks into material, or lies on
 * another surface, is dry. Among the free sides lines of sight tell which look into the liquid.
 *
 * Material is where the winding number of all closed shells is above 0, normals outwards counting 1 each time round.
 * So bodies may overlap, nest and pierce each other, and of a hollow body drawn with two shells the inner one, turned
 * towards the hollow, takes away what the outer one adds. Three things are put right first.
 *  - A shell turned inwards that does not enclose the cavity's point and lies in no other body is a solid drawn inside
 *    out: it is turned round.
 *  - The outermost shell around the cavity's point, turned outwards, is a room drawn inside out (a tank as simulations
 *    of flow draw it) where nearly all that leaves it outwards reaches the sky, and no hollow lies in it: it is turned
 *    round. A wall has an inner side too, from which one sees wall, and what stands in a vessel sees that.
 *  - A room drawn as one shell turned inwards has a wall without end: what is behind it, and what sticks out through
 * it, must count as material, and so 1 is added everywhere. A winding number above 0 at the cavity's point then means
 * that it lies in steel. */
#include "spray/wet/wet.h"

#include "spray/wet/flood_fill.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

#define SAME 1e-9      /* of the diagonal: corners nearer than this are one */
#define BEYOND 2.0     /* contacts */
#define SAMPLES 16     /* triangles of a shell that tell what it lies in */
#define SKY_LINES 1024 /* from a shell, to tell whether it lies under the sky */
#define SKY_STRIDE 387 /* mixes their directions */
#define SKY_LEAST 4    /* one line in so many may meet something */

/* The least winding number of the other shells in front of some triangles of a shell. */
static int winding_beside(const sp_wet *wet, const sp_mesh *mesh, uint32_t shell, double contact)
{
    int least = INT_MAX, looked = 0;
    for (uint32_t t = wet->shells.widest[shell]; t < mesh->triangle_count && looked < SAMPLES; t++) {
        if (wet->shells.of[t] != shell)
            continue;
        sp_vec3 beside = sp_along(sp_triangle_point(mesh, t, 0.3, 0.35), BEYOND * contact, sp_triangle_normal(mesh, t));
        int winding = sp_winding_without(wet->solids, beside, shell);
        least = winding < least ? winding : least;
        looked++;
    }
    return least;
}

/* Whether a hollow lies in a shell. */
static bool holds_hollow(const sp_wet *wet, const sp_mesh *mesh, uint32_t shell)
{
    for (uint32_t s = 0; s < wet->shells.count; s++) {
        if (s == shell || !wet->shells.closed[s] || !(wet->shells.volume[s] < 0))
            continue;
        sp_vec3 point = sp_triangle_point(mesh, wet->shells.widest[s], 0.3, 0.35);
        if (sp_winding_of(wet->solids, point, shell) > 0)
            return true;
    }
    return false;
}

/* Whether nearly all lines that leave a shell outwards, evenly spread over it, reach the sky. */
static bool lies_under_sky(const sp_wet *wet, const sp_tracer *tracer, uint32_t shell, double contact)
{
    const sp_mesh *mesh = sp_tracer_mesh(tracer);
    double area = 0, passed = 0;
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        area += wet->shells.of[t] == shell ? sp_triangle_area(mesh, t) : 0;
    int cast = 0, met = 0;
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        passed += wet->shells.of[t] == shell ? sp_triangle_area(mesh, t) / area * SKY_LINES : 0;
        sp_vec3 normal = sp_triangle_normal(mesh, t);
        for (; cast + 0.5 < passed; cast++) {
            sp_vec3 direction = sp_sphere_direction(cast * SKY_STRIDE % SKY_LINES, SKY_LINES);
            if (sp_dot(direction, normal) < 0)
                direction = sp_scale(direction, -1);
            sp_ray line = {.origin = sp_along(sp_triangle_point(mesh, t, 0.3, 0.35), BEYOND * contact, normal),
                           .velocity = direction,
                           .t_max = INFINITY,
                           .skip = t};
            met += sp_trace_occluded(tracer, &line, sp_v(0, 0, 0));
        }
    }
    return SKY_LEAST * met < cast;
}

/* Turns round what is drawn inside out, and finds how much is to be added to winding numbers. */
static void turn_shells(sp_wet *wet, const sp_setup *setup, const sp_tracer *tracer, double contact)
{
    const sp_shells *shells = &wet->shells;
    for (uint32_t s = 0; s < shells->count; s++) {
        if (!shells->closed[s] || shells->volume[s] == 0)
            continue;
        bool around = setup->cavity == SP_CAVITY_POINT && sp_winding_of(wet->solids, setup->cavity_point, s) != 0;
        bool inwards = shells->volume[s] < 0;
        if (around == inwards)
            continue;
        if (winding_beside(wet, setup->mesh, s, contact) <= 0 &&
            (!around || (!holds_hollow(wet, setup->mesh, s) && lies_under_sky(wet, tracer, s, contact))))
            shells->turn[s] = -1;
    }
    for (uint32_t s = 0; s < shells->count && setup->cavity == SP_CAVITY_POINT; s++) {
        if (!shells->closed[s] || shells->turn[s] * sp_winding_of(wet->solids, setup->cavity_point, s) >= 0)
            continue;
        int behind = winding_beside(wet, setup->mesh, s, contact);
        wet->base = 1 - behind > wet->base ? 1 - behind : wet->base;
    }
}

/* The innermost has the smallest box. */
uint32_t sp_wet_part_around(const sp_wet *wet, const sp_mesh *mesh, sp_vec3 point)
{
    const sp_shells *shells = &wet->shells;
    uint32_t part = SP_NONE;
    double least = INFINITY;
    for (uint32_t s = 0; s < shells->count; s++) {
        double size = sp_distance(shells->low[s], shells->high[s]);
        if (!shells->closed[s] || size >= least || !sp_is_within(shells->low[s], shells->high[s], point) ||
            shells->turn[s] * sp_winding_of(wet->solids, point, s) <= 0)
            continue;
        part = mesh->part[shells->widest[s]];
        least = size;
    }
    return part;
}

/* Of a part whose hollow was not closed only the outside is known. */
static bool has_open_shell(const sp_wet *wet, const sp_mesh *mesh, uint32_t part)
{
    for (uint32_t s = 0; s < wet->shells.count; s++)
        if (!wet->shells.closed[s] && mesh->part[wet->shells.widest[s]] == part)
            return true;
    return false;
}

static bool fail_in_material(const sp_wet *wet, const sp_setup *setup, sp_error *error)
{
    const sp_mesh *mesh = setup->mesh;
    sp_vec3 point = setup->cavity_point, outside = sp_setup_outside(setup, point);
    uint32_t part = sp_wet_part_around(wet, mesh, point);
    bool open = part != SP_NONE && has_open_shell(wet, mesh, part);
    return sp_fail(
        error, SP_ERROR_INPUT, NULL, 0, 0,
        "cavity: the point (%.12g m, %.12g m, %.12g m) lies in the material of part \"%s\"%s; expected a point of the "
        "space where the liquid flies (a room drawn as one shell has its normals inwards)",
        outside.x, outside.y, outside.z, part == SP_NONE ? "" : mesh->parts[part].name,
        open ? ", or in a hollow of it that cannot be told, since it has open edges" : "");
}

static bool find_solids(sp_wet *wet, const sp_setup *setup, const sp_tracer *tracer, double contact, sp_error *error)
{
    bool any = false;
    for (size_t s = 0; s < wet->shells.count; s++)
        any = any || wet->shells.closed[s];
    if (!any)
        return true;
    wet->solids = sp_winding_create(setup->mesh, &wet->shells, error);
    if (!wet->solids)
        return false;
    turn_shells(wet, setup, tracer, contact);
    if (setup->cavity != SP_CAVITY_POINT)
        return true;
    return !sp_wet_is_material(wet, setup->cavity_point) || fail_in_material(wet, setup, error);
}

static bool find_wet(sp_wet *wet, const sp_setup *setup, const sp_tracer *tracer, sp_error *error)
{
    const sp_mesh *mesh = setup->mesh;
    sp_vec3 low, high;
    double diagonal = sp_mesh_box(mesh, &low, &high), contact = SP_CONTACT * diagonal;
    if (!sp_shells_create(&wet->shells, mesh, SAME * diagonal, error) ||
        !find_solids(wet, setup, tracer, contact, error) ||
        !sp_cuts_create(&wet->cuts, setup, &wet->shells, contact, error) ||
        !sp_faces_create(&wet->faces, mesh, &wet->shells, &wet->cuts, wet->solids, wet->base, setup->run.threads,
                         error))
        return false;
    wet->flooded.liquid = calloc(2 * wet->faces.count + 1, sizeof *wet->flooded.liquid);
    if (!wet->flooded.liquid)
        return sp_fail_memory(error);
    if (!sp_flood_faces(setup, tracer, &wet->faces, &wet->shells, &wet->flooded, error))
        return false;
    for (size_t side = 0; side < 2 * wet->faces.count; side++) {
        uint32_t triangle = sp_face_triangle(&wet->faces, (uint32_t)(side / 2));
        if (wet->flooded.liquid[side])
            wet->sides[triangle] |= (uint8_t)(1u << side % 2);
        else if (wet->faces.area[side / 2] > 0)
            wet->whole[triangle] &= (uint8_t) ~(1u << side % 2);
    }
    return true;
}

sp_wet *sp_wet_create(const sp_setup *setup, const sp_tracer *tracer, sp_error *error)
{
    size_t count = setup->mesh->triangle_count;
    sp_wet *wet = calloc(1, sizeof *wet);
    if (!wet)
        return sp_fail_memory(error);
    wet->sides = calloc(count + 1, 1);
    wet->whole = malloc(count + 1);
    if (!wet->sides || !wet->whole) {
        sp_wet_destroy(wet);
        return sp_fail_memory(error);
    }
    memset(wet->whole, 3, count);
    if (setup->cavity == SP_CAVITY_NONE) {
        memset(wet->sides, 3, count);
    } else if (!find_wet(wet, setup, tracer, error)) {
        sp_wet_destroy(wet);
        return NULL;
    }
    return wet;
}

void sp_wet_destroy(sp_wet *wet)
{
    if (!wet)
        return;
    sp_faces_destroy(&wet->faces);
    sp_cuts_destroy(&wet->cuts);
    sp_winding_destroy(wet->solids);
    sp_shells_destroy(&wet->shells);
    free(wet->flooded.liquid);
    free(wet->sides);
    free(wet->whole);
    free(wet);
}

unsigned sp_wet_at(const sp_wet *wet, uint32_t triangle, double u, double v)
{
    if (wet->sides[triangle] == wet->whole[triangle])
        return wet->sides[triangle];
    bool near;
    size_t face = sp_face_at(&wet->faces, triangle, u, v, &near);
    return (unsigned)wet->flooded.liquid[2 * face] | (unsigned)wet->flooded.liquid[2 * face + 1] << 1;
}

bool sp_wet_is_material(const sp_wet *wet, sp_vec3 point)
{
    return wet->solids && sp_winding_at(wet->solids, point) + wet->base > 0;
}
