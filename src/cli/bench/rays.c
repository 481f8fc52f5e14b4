/* Rays as nozzles, cameras and reflections send them. */
#include "bench.h"
#include "random.h"

#include <stdlib.h>

static const double GRAVITY = 9.81;          /* m/s² */
static const double CONE = 120 * M_PI / 180; /* rad, full angle of the nozzle */
static const double CAMERA_AT = 1.2;         /* diagonals from the middle of the box */
/* Share of a flight at either end in which nothing blocks it: single precision, in which Embree works, must still tell
 * the target from what stands before it. */
static const double ENDS = 1e-5;
enum { SIGHTINGS = 256 };

static void enclose(bench_stage *stage)
{
    const sp_mesh *mesh = stage->mesh;
    stage->diagonal = sp_mesh_box(mesh, &stage->low, &stage->high);
    stage->speed = sqrt(2 * GRAVITY * stage->diagonal);
}

static sp_vec3 random_direction(uint64_t *state)
{
    double z = 2 * bench_uniform(state) - 1, azimuth = 2 * M_PI * bench_uniform(state), level = sqrt(1 - z * z);
    return sp_v(level * cos(azimuth), level * sin(azimuth), z);
}

static sp_vec3 middle(const bench_stage *stage)
{
    return sp_scale(sp_add(stage->low, stage->high), 0.5);
}

/* A line that comes from outside goes in at its first hit and out at its second. Of many such lines through the middle
 * of the box, the middle of the longest way inside. */
static sp_vec3 find_inside(const bench_stage *stage, const sp_tracer *tracer)
{
    sp_vec3 best = middle(stage), none = sp_v(0, 0, 0);
    double longest = 0;
    uint64_t state = 1;
    for (int i = 0; i < SIGHTINGS; i++) {
        sp_vec3 direction = random_direction(&state);
        sp_ray ray = {.origin = sp_along(middle(stage), -stage->diagonal, direction),
                      .velocity = direction,
                      .t_max = INFINITY,
                      .skip = SP_NONE};
        sp_hit in = sp_trace_nearest(tracer, &ray, none);
        if (in.triangle == SP_NONE)
            continue;
        ray.t_min = in.t;
        ray.skip = in.triangle;
        sp_hit out = sp_trace_nearest(tracer, &ray, none);
        if (out.triangle == SP_NONE || out.t - in.t <= longest)
            continue;
        longest = out.t - in.t;
        best = sp_ray_point(&ray, none, 0.5 * (in.t + out.t));
    }
    return best;
}

bool bench_stage_create(bench_stage *stage, const sp_tracer *tracer, sp_error *error)
{
    const sp_mesh *mesh = sp_tracer_mesh(tracer);
    *stage = (bench_stage){.mesh = mesh, .area = malloc((mesh->triangle_count + 1) * sizeof *stage->area)};
    if (!stage->area)
        return sp_fail_memory(error);
    stage->area[0] = 0;
    for (size_t t = 0; t < mesh->triangle_count; t++)
        stage->area[t + 1] = stage->area[t] + sp_triangle_area(mesh, (uint32_t)t);
    enclose(stage);
    stage->inside = find_inside(stage, tracer);
    return true;
}

void bench_stage_clear(bench_stage *stage)
{
    free(stage->area);
}

sp_vec3 bench_gravity(bench_trajectory trajectory)
{
    return sp_v(0, 0, trajectory == TRAJECTORY_PARABOLA ? -GRAVITY : 0);
}

static sp_ray start(const bench_stage *stage, sp_vec3 origin, sp_vec3 direction)
{
    return (sp_ray){
        .origin = origin, .velocity = sp_scale(direction, stage->speed), .t_max = INFINITY, .skip = SP_NONE};
}

/* Jets of a full cone that points down, in random order. */
static void make_cone(const bench_stage *stage, sp_ray *rays, size_t count)
{
    sp_nozzle_type type = {.pattern = SP_PATTERN_FULL_CONE, .angle = CONE};
    sp_spray spray = sp_spray_create(&type, CONE);
    sp_frame frame = sp_nozzle_frame(sp_v(0, 0, -1), 0, sp_v(0, 0, 1));
    uint64_t state = 2;
    for (size_t i = 0; i < count; i++) {
        sp_vec3 d = sp_spray_direction(&spray, i, count, 1);
        sp_ray ray =
            start(stage, stage->inside, sp_along(sp_along(sp_scale(frame.x, d.x), d.y, frame.y), d.z, frame.z));
        size_t at = (size_t)(bench_random(&state) % (i + 1)); /* Fisher and Yates, inside out */
        rays[i] = rays[at];
        rays[at] = ray;
    }
}

/* A picture of the mesh from outside, line by line. */
static void make_grid(const bench_stage *stage, sp_ray *rays, size_t count)
{
    sp_vec3 forward = sp_unit(sp_v(-0.6, -0.7, -0.4));
    sp_vec3 right = sp_unit(sp_cross(forward, sp_v(0, 0, 1))), down = sp_cross(forward, right);
    sp_vec3 eye = sp_along(middle(stage), -CAMERA_AT * stage->diagonal, forward);
    size_t edge = (size_t)ceil(sqrt((double)count));
    for (size_t i = 0; i < count; i++) {
        double x = ((double)(i % edge) + 0.5) / (double)edge - 0.5;
        double y = ((double)(i / edge) + 0.5) / (double)edge - 0.5;
        sp_vec3 aim = sp_along(sp_along(sp_scale(forward, CAMERA_AT), x, right), y, down);
        rays[i] = start(stage, eye, sp_unit(aim));
    }
}

/* Anywhere in the box, anywhere to. */
static void make_incoherent(const bench_stage *stage, sp_ray *rays, size_t count)
{
    sp_vec3 edge = sp_sub(stage->high, stage->low);
    uint64_t state = 3;
    for (size_t i = 0; i < count; i++) {
        double x = bench_uniform(&state), y = bench_uniform(&state), z = bench_uniform(&state);
        sp_vec3 origin = sp_add(stage->low, sp_v(x * edge.x, y * edge.y, z * edge.z));
        rays[i] = start(stage, origin, random_direction(&state));
    }
}

static uint32_t random_triangle(const bench_stage *stage, uint64_t *state)
{
    size_t low = 0, high = stage->mesh->triangle_count;
    double at = bench_uniform(state) * stage->area[high];
    while (high - low > 1) {
        size_t between = low + (high - low) / 2;
        if (stage->area[between] <= at)
            low = between;
        else
            high = between;
    }
    return (uint32_t)low;
}

/* From one point to points all over the surface, as visibility asks, in random order. */
static void make_surface(const bench_stage *stage, sp_vec3 gravity, sp_ray *rays, size_t count)
{
    uint64_t state = 4;
    for (size_t i = 0; i < count; i++) {
        uint32_t triangle = random_triangle(stage, &state);
        double root = sqrt(bench_uniform(&state)), v = root * bench_uniform(&state);
        sp_vec3 way = sp_sub(sp_triangle_point(stage->mesh, triangle, 1 - root, v), stage->inside);
        double time = fmax(sp_length(way) / stage->speed, 1e-9);
        rays[i] = (sp_ray){.origin = stage->inside,
                           .velocity = sp_along(sp_scale(way, 1 / time), -0.5 * time, gravity),
                           .t_min = ENDS * time,
                           .t_max = (1 - ENDS) * time,
                           .skip = triangle};
    }
}

void bench_rays_make(const bench_stage *stage, bench_mode mode, bench_trajectory trajectory, sp_ray *rays, size_t count)
{
    switch (mode) {
    case MODE_CONE:
        make_cone(stage, rays, count);
        break;
    case MODE_GRID:
        make_grid(stage, rays, count);
        break;
    case MODE_INCOHERENT:
        make_incoherent(stage, rays, count);
        break;
    default:
        make_surface(stage, bench_gravity(trajectory), rays, count);
        break;
    }
}

/* Widens span by t where the parabola, at t, is in the box or on it. */
static void take_time(const bench_stage *stage, const sp_ray *ray, sp_vec3 gravity, double t, double span[2])
{
    double slack = 1e-9 * stage->diagonal;
    sp_vec3 p = sp_ray_point(ray, gravity, t);
    if (!(t >= ray->t_min) || !(t <= ray->t_max) || p.x < stage->low.x - slack || p.y < stage->low.y - slack ||
        p.z < stage->low.z - slack || p.x > stage->high.x + slack || p.y > stage->high.y + slack ||
        p.z > stage->high.z + slack)
        return;
    span[0] = fmin(span[0], t);
    span[1] = fmax(span[1], t);
}

/* A parabola is first and last in the box where it starts or ends, or where it crosses one of the six planes. */
void bench_ray_span(const bench_stage *stage, const sp_ray *ray, sp_vec3 gravity, double span[2])
{
    const double at[3] = {ray->origin.x, ray->origin.y, ray->origin.z};
    const double v[3] = {ray->velocity.x, ray->velocity.y, ray->velocity.z};
    const double g[3] = {gravity.x, gravity.y, gravity.z};
    const double planes[2][3] = {{stage->low.x, stage->low.y, stage->low.z},
                                 {stage->high.x, stage->high.y, stage->high.z}};
    span[0] = INFINITY;
    span[1] = -INFINITY;
    take_time(stage, ray, gravity, ray->t_min, span);
    if (isfinite(ray->t_max))
        take_time(stage, ray, gravity, ray->t_max, span);
    for (int side = 0; side < 2; side++)
        for (int axis = 0; axis < 3; axis++) {
            double c = at[axis] - planes[side][axis], discriminant = v[axis] * v[axis] - 2 * g[axis] * c;
            double q = -(v[axis] + copysign(sqrt(fmax(discriminant, 0)), v[axis]));
            if (discriminant < 0 || q == 0)
                continue;
            take_time(stage, ray, gravity, 2 * c / q, span);
            if (g[axis] != 0)
                take_time(stage, ray, gravity, q / g[axis], span);
        }
    /* Surface may lie in the very sides of the box. */
    double slack = fmax(1e-3 * (span[1] - span[0]), 0);
    span[0] = fmax(span[0] - slack, ray->t_min);
    span[1] = fmin(span[1] + slack, ray->t_max);
}
