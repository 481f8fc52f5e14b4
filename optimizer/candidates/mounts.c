#include "candidates/mounts.h"

#include "candidates/valid_options.h"

#include "deadline/deadline.h"
#include "valid_range.h"
#include "mesh/distance.h"
#include "mesh/grow.h"
#include "trace/distance.h"

#include <stdlib.h>

#define SAMPLES_PER_SITE 16 /* points to choose from, per square of the spacing */
#define NM 1e9              /* to a metre */

static bool append(sp_sites *sites, const sp_site *site, sp_error *error)
{
    if (!sp_grow(&sites->items, &sites->capacity, sites->count + 1, sizeof *sites->items))
        return sp_fail_memory(error);
    sites->items[sites->count++] = *site;
    return true;
}

/* How many points a mount gives; of a surface about as many, for each side that is wet. Infinite where a spacing is
 * needed and there is none. */
static double points_of(const sp_mesh *mesh, const sp_mount *mount)
{
    sp_vec3 extent = sp_sub(mount->to, mount->from);
    double area = 0;
    switch (mount->kind) {
    case SP_MOUNT_PORT:
        return sp_mount_points_along(mount->depth_to - mount->depth_from, mount->depth_spacing);
    case SP_MOUNT_LINE:
        return sp_mount_points_along(sp_length(extent), mount->spacing);
    case SP_MOUNT_BOX:
        return sp_mount_points_along(extent.x, mount->spacing) * sp_mount_points_along(extent.y, mount->spacing) *
               sp_mount_points_along(extent.z, mount->spacing);
    case SP_MOUNT_SURFACE:
        for (uint32_t t = 0; t < mesh->triangle_count; t++)
            area += sp_mount_has(mesh, mount, t) ? sp_triangle_area(mesh, t) : 0;
        return area > 0 ? fmax(1, area / (fmax(mount->spacing, 0) * mount->spacing)) : 0;
    }
    return 0;
}

/* That all mounts together give no more points than they may; the error names the one that gives most. */
static bool check_points(const sp_mesh *mesh, const sp_place_options *options, sp_error *error)
{
    static const char *const kinds[] = {"port", "surface", "line", "box"};
    double all = 0, most = 0;
    size_t worst = 0;
    for (size_t m = 0; m < options->mount_count; m++) {
        double points = points_of(mesh, &options->mounts[m]);
        all += points;
        worst = points > most ? m : worst;
        most = fmax(most, points);
    }
    if (all <= SP_MOUNTING_POINTS)
        return true;
    const sp_mount *mount = &options->mounts[worst];
    const char *quote = mount->name[0] ? "'" : "", *between = mount->name[0] ? " " : "";
    return sp_fail(
        error, SP_ERROR_INPUT, NULL, 0, 0,
        "mounts: %s%s%s%s%s (number %zu): found %.0f mounting points, %.0f with those of all mounts, expected "
        "at most %d in all: a longer spacing gives fewer",
        kinds[mount->kind], between, quote, mount->name, quote, worst + 1, most, all, SP_MOUNTING_POINTS);
}

static double step_at(double from, double to, size_t i, size_t count)
{
    return count > 1 ? from + (to - from) * (double)i / (double)(count - 1) : from;
}

sp_vec3 sp_port_place(const sp_setup *setup, const sp_mount *mount, double depth)
{
    sp_vec3 place = sp_along(mount->position, depth, mount->axis);
    if (!(mount->depth_step.count > 0))
        return place;
    place = sp_setup_outside(setup, place);
    place = sp_v(nearbyint(place.x * NM) / NM, nearbyint(place.y * NM) / NM, nearbyint(place.z * NM) / NM);
    return sp_sub(place, setup->origin);
}

static bool port_sites(const sp_evaluator *evaluator, const sp_mount *mount, uint32_t index, sp_sites *sites,
                       sp_error *error)
{
    const sp_setup *setup = sp_evaluator_setup(evaluator);
    size_t count = (size_t)sp_mount_points_along(mount->depth_to - mount->depth_from, mount->depth_spacing);
    uint32_t nearest = sp_tracer_nearest_triangle(sp_evaluator_tracer(evaluator), SP_NONE, mount->position);
    double last = -1;
    for (size_t i = 0; i < count; i++) {
        double depth =
            sp_step_nearest(mount->depth_step, mount->depth_from, step_at(mount->depth_from, mount->depth_to, i, count),
                            mount->depth_from, mount->depth_to);
        sp_site site = {.position = sp_port_place(setup, mount, depth),
                        .axis = mount->axis,
                        .mount = index,
                        .own = nearest == SP_NONE ? SP_NONE : setup->mesh->part[nearest]};
        if (depth > last && !append(sites, &site, error))
            return false;
        last = depth;
    }
    return true;
}

static bool box_sites(const sp_mount *mount, uint32_t index, sp_sites *sites, sp_error *error)
{
    size_t nx = (size_t)sp_mount_points_along(mount->to.x - mount->from.x, mount->spacing),
           ny = (size_t)sp_mount_points_along(mount->to.y - mount->from.y, mount->spacing),
           nz = (size_t)sp_mount_points_along(mount->to.z - mount->from.z, mount->spacing);
    for (size_t k = 0; k < nz; k++)
        for (size_t j = 0; j < ny; j++)
            for (size_t i = 0; i < nx; i++) {
                sp_site site = {.position = sp_v(step_at(mount->from.x, mount->to.x, i, nx),
                                                 step_at(mount->from.y, mount->to.y, j, ny),
                                                 step_at(mount->from.z, mount->to.z, k, nz)),
                                .axis = mount->axis,
                                .mount = index,
                                .own = SP_NONE};
                if (!append(sites, &site, error))
                    return false;
            }
    return true;
}

static bool line_sites(const sp_mount *mount, uint32_t index, sp_sites *sites, sp_error *error)
{
    sp_vec3 along = sp_sub(mount->to, mount->from);
    size_t count = (size_t)sp_mount_points_along(sp_length(along), mount->spacing);
    for (size_t i = 0; i < count; i++) {
        sp_site site = {.position = sp_along(mount->from, step_at(0, 1, i, count), along),
                        .axis = mount->axis,
                        .mount = index,
                        .own = SP_NONE};
        if (!append(sites, &site, error))
            return false;
    }
    return true;
}

static sp_site stood_off(const sp_setup *setup, const sp_mount *mount, uint32_t index, uint32_t triangle, sp_vec3 point,
                         bool back)
{
    sp_vec3 normal = sp_triangle_normal(setup->mesh, triangle);
    if (back)
        normal = sp_scale(normal, -1);
    return (sp_site){.position = sp_setup_told(setup, sp_along(point, sp_mount_standoff(mount), normal)),
                     .axis = normal,
                     .mount = index,
                     .own = setup->mesh->part[triangle]};
}

/* van der Corput's sequence in the given base */
static double radical_inverse(size_t i, size_t base)
{
    double value = 0, digit = 1.0 / (double)base;
    for (; i; i /= base, digit /= (double)base)
        value += digit * (double)(i % base);
    return value;
}

/* Points spread evenly by area over one side of the mount's triangles, each stood off. */
static bool surface_samples(const sp_evaluator *evaluator, const sp_mount *mount, uint32_t index, sp_sites *samples,
                            sp_error *error)
{
    const sp_setup *setup = sp_evaluator_setup(evaluator);
    const sp_mesh *mesh = setup->mesh;
    double total = 0;
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        if (sp_mount_has(mesh, mount, t))
            total += sp_triangle_area(mesh, t);
    if (!(total > 0))
        return true;
    /* a part smaller than a square of the spacing has its choice of points all the same */
    double per_area = SAMPLES_PER_SITE / fmin(mount->spacing * mount->spacing, total);
    double passed = 0.5; /* the first sample lies half a sample's area in */
    size_t number = 0;
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        if (!sp_mount_has(mesh, mount, t))
            continue;
        passed += sp_triangle_area(mesh, t) * per_area;
        for (; (double)number + 1 <= passed; number++) {
            double u = radical_inverse(number + 1, 2), v = radical_inverse(number + 1, 3);
            if (u + v > 1) {
                u = 1 - u;
                v = 1 - v;
            }
            sp_vec3 point = sp_triangle_point(mesh, t, u, v);
            unsigned wet = sp_evaluator_wet_at(evaluator, t, u, v);
            for (unsigned side = 0; side < 2; side++) {
                sp_site site = stood_off(setup, mount, index, t, point, side == 1);
                if ((wet >> side & 1) && !append(samples, &site, error))
                    return false;
            }
        }
    }
    return true;
}

/* Farthest-point sampling: each site is the sample farthest from those already taken, until none is a spacing away.
 * Both sides of a sheet are far from one another. */
static bool surface_sites(const sp_evaluator *evaluator, const sp_mount *mount, uint32_t index, sp_sites *sites,
                          sp_error *error)
{
    sp_sites samples = {0};
    double *distance = NULL;
    bool done = surface_samples(evaluator, mount, index, &samples, error);
    if (done && samples.count) {
        distance = malloc(samples.count * sizeof *distance);
        if (!distance)
            done = sp_fail_memory(error);
    }
    for (size_t i = 0; distance && i < samples.count; i++)
        distance[i] = INFINITY;
    for (size_t next = 0; done && next < samples.count;) {
        sp_site taken = samples.items[next];
        done = append(sites, &taken, error);
        double farthest = mount->spacing;
        next = samples.count;
        for (size_t i = 0; i < samples.count; i++) {
            if (sp_dot(samples.items[i].axis, taken.axis) > 0)
                distance[i] = fmin(distance[i], sp_distance(samples.items[i].position, taken.position));
            if (distance[i] >= farthest && (next == samples.count || distance[i] > farthest)) {
                farthest = distance[i];
                next = i;
            }
        }
    }
    free(distance);
    sp_sites_free(&samples);
    return done;
}

static bool lance_blocked(const sp_evaluator *evaluator, sp_vec3 from, sp_vec3 to, uint32_t own)
{
    const sp_tracer *tracer = sp_evaluator_tracer(evaluator);
    const sp_mesh *mesh = sp_tracer_mesh(tracer);
    sp_ray ray = {.origin = from, .velocity = sp_sub(to, from), .t_max = 1, .skip = SP_NONE};
    while (sp_length(ray.velocity) > 0) {
        sp_hit hit = sp_trace_nearest(tracer, &ray, sp_v(0, 0, 0));
        if (hit.triangle == SP_NONE)
            return false;
        if (mesh->part[hit.triangle] != own)
            return true;
        ray.t_min = hit.t;
    }
    return false;
}

bool sp_site_allowed(const sp_evaluator *evaluator, const sp_place_options *options, const sp_site *site)
{
    const sp_mount *mount = &options->mounts[site->mount];
    if (!sp_evaluator_is_clear(evaluator, site->position, options->clearance, site->own) ||
        !sp_evaluator_inside(evaluator, site->position))
        return false;
    return mount->kind != SP_MOUNT_PORT || !lance_blocked(evaluator, mount->position, site->position, site->own);
}

bool sp_site_project(const sp_evaluator *evaluator, const sp_place_options *options, sp_site *site, sp_vec3 point)
{
    const sp_setup *setup = sp_evaluator_setup(evaluator);
    const sp_mesh *mesh = setup->mesh;
    const sp_mount *mount = &options->mounts[site->mount];
    uint32_t triangle = sp_tracer_nearest_triangle(sp_evaluator_tracer(evaluator), site->own, point);
    if (triangle == SP_NONE)
        return false;
    bool back = sp_dot(sp_triangle_normal(mesh, triangle), site->axis) < 0;
    if (!(sp_evaluator_wet(evaluator, triangle) >> back & 1))
        return false;
    *site = stood_off(setup, mount, site->mount, triangle, sp_triangle_nearest(mesh, triangle, point), back);
    return true;
}

static bool mount_sites(const sp_evaluator *evaluator, const sp_mount *mount, uint32_t index, sp_sites *sites,
                        sp_error *error)
{
    switch (mount->kind) {
    case SP_MOUNT_PORT:
        return port_sites(evaluator, mount, index, sites, error);
    case SP_MOUNT_SURFACE:
        return surface_sites(evaluator, mount, index, sites, error);
    case SP_MOUNT_LINE:
        return line_sites(mount, index, sites, error);
    case SP_MOUNT_BOX:
        return box_sites(mount, index, sites, error);
    }
    return sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0, "a mount of unknown kind %d", (int)mount->kind);
}

/* All mounts' sites, in their order, whether or not a nozzle may be there. */
static bool list_sites(const sp_evaluator *evaluator, const sp_place_options *options, sp_sites *sites, sp_error *error)
{
    *sites = (sp_sites){0};
    if (!check_points(sp_evaluator_setup(evaluator)->mesh, options, error))
        return false;
    for (size_t m = 0; m < options->mount_count; m++)
        if (!mount_sites(evaluator, &options->mounts[m], (uint32_t)m, sites, error)) {
            sp_sites_free(sites);
            return false;
        }
    for (size_t i = 0; i < sites->count; i++)
        sites->items[i].position = sp_setup_told(sp_evaluator_setup(evaluator), sites->items[i].position);
    return true;
}

/* Keeps the sites that are allowed, in order. */
static bool sift(const sp_evaluator *evaluator, const sp_place_options *options, sp_sites *sites, sp_error *error)
{
    bool *allowed = calloc(sites->count ? sites->count : 1, sizeof *allowed);
    if (!allowed)
        return sp_fail_memory(error);
    int threads = sp_threads(&options->run);
#pragma omp parallel for num_threads(threads) schedule(dynamic, 4)
    for (size_t i = 0; i < sites->count; i++)
        allowed[i] = sp_site_allowed(evaluator, options, &sites->items[i]);
    size_t kept = 0;
    for (size_t i = 0; i < sites->count; i++)
        if (allowed[i])
            sites->items[kept++] = sites->items[i];
    free(allowed);
    sites->count = kept;
    return true;
}

bool sp_sites_create(const sp_evaluator *evaluator, const sp_place_options *options, sp_sites *sites, sp_error *error)
{
    if (!list_sites(evaluator, options, sites, error))
        return false;
    size_t all = sites->count;
    bool done = sift(evaluator, options, sites, error);
    if (done && !sites->count)
        done = sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                       "place: none of %zu mounting points is inside the cavity and %g m clear of surfaces", all,
                       options->clearance);
    if (!done)
        sp_sites_free(sites);
    return done;
}

bool sp_place_count_points(const sp_evaluator *evaluator, const sp_place_options *options, size_t *all, size_t *usable,
                           sp_error *error)
{
    if (!evaluator || !options || !sp_run_is_valid(&options->run, error) || !sp_mounts_are_valid(options, error))
        return false;
    sp_sites sites;
    if (!list_sites(evaluator, options, &sites, error))
        return false;
    for (size_t m = 0; m < options->mount_count; m++)
        all[m] = usable[m] = 0;
    for (size_t i = 0; i < sites.count; i++)
        all[sites.items[i].mount]++;
    bool done = sift(evaluator, options, &sites, error);
    for (size_t i = 0; done && i < sites.count; i++)
        usable[sites.items[i].mount]++;
    sp_sites_free(&sites);
    return done;
}

void sp_sites_free(sp_sites *sites)
{
    free(sites->items);
    *sites = (sp_sites){0};
}
