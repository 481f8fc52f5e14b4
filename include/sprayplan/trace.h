/* Tracing: where a line or parabola first meets a mesh. */
#ifndef SPRAYPLAN_TRACE_H
#define SPRAYPLAN_TRACE_H

#include <sprayplan/export.h>
#include <sprayplan/mesh.h>
#include <sprayplan/run.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum {
    SP_ACCELERATOR_BVH,   /* wide bounding volume hierarchy (default); the others are for reference */
    SP_ACCELERATOR_SAH,   /* kd-tree by the surface area heuristic */
    SP_ACCELERATOR_NAIVE, /* kd-tree split at the spatial median of the longest side */
    SP_ACCELERATOR_NONE,  /* every triangle is tested */
} sp_accelerator;

/* x(t) = origin + velocity t + gravity t²/2 for t_min < t < t_max. */
typedef struct {
    sp_vec3 origin;   /* m */
    sp_vec3 velocity; /* m/s, any length, but 0 only with gravity */
    double t_min;     /* s, usually 0 */
    double t_max;     /* s, INFINITY for no end */
    uint32_t skip;    /* a triangle never hit (the one that the ray leaves or aims at), or SP_NONE */
} sp_ray;

typedef struct {
    double t;          /* s; INFINITY for a miss */
    double u, v;       /* weights of the second and third corner */
    uint32_t triangle; /* SP_NONE for a miss; of equal t the lowest number */
} sp_hit;

typedef struct sp_tracer sp_tracer;

/* Builds the accelerator. The mesh is borrowed and must outlive the tracer. `threads` as in sp_run; only the bvh is
 * built by more than one. Never fails for a valid mesh unless memory runs out. */
SP_API sp_tracer *sp_tracer_create(const sp_mesh *mesh, sp_accelerator accelerator, int threads, sp_error *error);
/* Accepts NULL. */
SP_API void sp_tracer_destroy(sp_tracer *tracer);
SP_API const sp_mesh *sp_tracer_mesh(const sp_tracer *tracer);
/* Bytes held besides the mesh. */
SP_API size_t sp_tracer_bytes(const sp_tracer *tracer);

/* One ray. `gravity` (m/s²) zero means a line. Triangles are hit from both sides. What meets an edge or a corner hits
 * at least one of the triangles there, lines all of them, so that nothing slips between two. All accelerators give the
 * same answer to the last bit. Safe to call from many threads. */
SP_API sp_hit sp_trace_nearest(const sp_tracer *tracer, const sp_ray *ray, sp_vec3 gravity);
/* True where anything but `skip` is hit within (t_min, t_max). */
SP_API bool sp_trace_occluded(const sp_tracer *tracer, const sp_ray *ray, sp_vec3 gravity);

/* Many rays: hits[count] / occluded[count] are the caller's. `threads` as in sp_run, of which more than
 * SP_THREADS are as many as that. */
SP_API void sp_trace_nearest_many(const sp_tracer *tracer, const sp_ray *rays, size_t count, sp_vec3 gravity,
                                  int threads, sp_hit *hits);
SP_API void sp_trace_occluded_many(const sp_tracer *tracer, const sp_ray *rays, size_t count, sp_vec3 gravity,
                                   int threads, bool *occluded);

/* Position and velocity at t. */
static inline sp_vec3 sp_ray_point(const sp_ray *ray, sp_vec3 gravity, double t)
{
    return sp_along(sp_along(ray->origin, t, ray->velocity), 0.5 * t * t, gravity);
}
static inline sp_vec3 sp_ray_velocity(const sp_ray *ray, sp_vec3 gravity, double t)
{
    return sp_along(ray->velocity, t, gravity);
}

#ifdef __cplusplus
}
#endif
#endif
