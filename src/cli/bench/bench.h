/* sprayplan bench: what its parts share. */
#ifndef CLI_BENCH_H
#define CLI_BENCH_H

#include "../atlas.h"
#include "../../clock.h"
#include "../cli.h"
#include "../embree/module.h"

typedef enum { MODE_CONE, MODE_GRID, MODE_INCOHERENT, MODE_SURFACE, MODES } bench_mode;
typedef enum { TRAJECTORY_LINE, TRAJECTORY_PARABOLA, TRAJECTORIES } bench_trajectory;
typedef enum { QUERY_NEAREST, QUERY_OCCLUDED, QUERIES } bench_query;
extern const char *const bench_mode_names[MODES];
extern const char *const bench_trajectory_names[TRAJECTORIES];
extern const char *const bench_query_names[QUERIES];

/* What is asked for. */
typedef struct {
    size_t rays;
    bool modes[MODES], trajectories[TRAJECTORIES];
    int threads;
} bench_wish;

/* Accelerators: ours first, then Embree's. */
enum { OWN_BVH, OWN_SAH, OWN_NAIVE, OWN_NONE, OWN, EMBREE_FAST = OWN, EMBREE_ROBUST, ACCELERATORS };
extern const char *const bench_accelerator_names[ACCELERATORS];

typedef struct {
    int accelerator, threads;
    double seconds; /* median */
    size_t bytes;   /* besides the mesh */
} bench_build_row;

/* The middle one of values[count], which get sorted. */
double bench_median(double *values, size_t count);

/* embree.c: the module's functions, or NULL with a note on standard error. */
const bench_embree *bench_embree_load(void);

/* scaffold.c: the mesh under every accelerator. */
typedef struct {
    const sp_mesh *mesh;
    const bench_embree *embree; /* NULL: not here */
    float *vertices;            /* [3 vertex_count + 1] */
    sp_tracer *tracers[OWN];
    bench_embree_scene *scenes[ACCELERATORS]; /* from EMBREE_FAST on */
    bench_build_row *builds;
    size_t build_count;
} bench_scaffold;
bool bench_scaffold_create(bench_scaffold *scaffold, const sp_mesh *mesh, int threads, const sp_run *run,
                           sp_error *error);
void bench_scaffold_clear(bench_scaffold *scaffold);

/* rays.c: where rays start and what they aim at. */
typedef struct {
    const sp_mesh *mesh;
    sp_vec3 low, high; /* box around the triangles, m */
    double diagonal;   /* m */
    double speed;      /* m/s: a parabola falls a quarter of the diagonal while it flies one */
    sp_vec3 inside;    /* a point with much room around it, inside the mesh where that is closed */
    double *area;      /* [triangle_count + 1], m², of all triangles before */
} bench_stage;
bool bench_stage_create(bench_stage *stage, const sp_tracer *tracer, sp_error *error);
void bench_stage_clear(bench_stage *stage);
sp_vec3 bench_gravity(bench_trajectory trajectory);
/* Fills rays[count] in the order in which they come before any sorting. */
void bench_rays_make(const bench_stage *stage, bench_mode mode, bench_trajectory trajectory, sp_ray *rays,
                     size_t count);
/* From when to when a parabola is in the box or close to it, s; first ≥ last where it never is. */
void bench_ray_span(const bench_stage *stage, const sp_ray *ray, sp_vec3 gravity, double span[2]);

/* sort.c: copies rays to `sorted` in the order of their directions along a Morton curve; order[i] is where sorted[i]
 * came from. False where memory runs out. */
bool bench_sort(const sp_ray *rays, size_t count, sp_ray *sorted, uint32_t *order);

/* trace.c */
typedef struct {
    int accelerator;
    char variant[24];
    bench_query query;
    bench_mode mode;
    bool sorted;
    bench_trajectory trajectory;
    int threads;
    size_t rays, hits;
    size_t wrong;  /* rays that hit another triangle than the reference says, or hit where it says none */
    size_t missed; /* rays that hit nothing where the reference says something */
    double rays_per_second, sort_seconds;
} bench_trace_row;
typedef struct {
    bench_trace_row *rows;
    size_t count, room;
} bench_trace;
bool bench_trace_all(const bench_scaffold *scaffold, const bench_stage *stage, const bench_wish *wish,
                     const sp_run *run, bench_trace *trace, sp_error *error);
void bench_trace_clear(bench_trace *trace);

/* study.c: the 2008 study's tables 4.3 and 4.4 for this mesh. */
typedef struct {
    int accelerator;
    bench_trajectory trajectory;
    size_t rays, hits;
    double seconds; /* median, with the deposits written */
} bench_study_row;
enum { STUDY_ROWS = OWN * TRAJECTORIES };
bool bench_study(const bench_scaffold *scaffold, const bench_stage *stage, const sp_atlas *atlas, const sp_run *run,
                 bench_study_row rows[STUDY_ROWS], size_t *count, sp_error *error);

/* Reading and welding. */
typedef struct {
    double seconds;
    size_t bytes;      /* of the mesh */
    size_t peak_bytes; /* while it was made */
} bench_load;

/* print.c */
typedef struct {
    const char *path;
    const bench_load *load;
    const bench_scaffold *scaffold;
    const bench_trace *trace;
    const bench_study_row *study;
    size_t study_count;
    const cli_atlas_work *atlas;
} bench_result;
bool bench_print_json(const bench_result *result);
void bench_print_table(const bench_result *result);

#endif
