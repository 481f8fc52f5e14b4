/* The work of the 2008 study's tables 4.3 and 4.4: 1000 jets of a full cone, lines or parabolas, are traced, their
 * impacts reckoned, and the deposits written into the texture. */
#include "bench.h"

#include <stdlib.h>

enum { JETS = 1000, MOST_ROUNDS = 9 };
static const double ENOUGH = 0.3;     /* s of one row after which there is no further round */
static const double MOST_TESTS = 1e8; /* of triangles by the bare loop */

typedef struct {
    float jets, speed, incidence, incidence_min; /* sums, and the least */
} deposit;

/* What a texel of the study's texture records of a jet: that it came, how fast, how steeply. */
static void write_deposits(const sp_mesh *mesh, const sp_atlas *atlas, const sp_ray *rays, const sp_hit *hits,
                           size_t count, sp_vec3 gravity, deposit *texture)
{
    for (size_t i = 0; i < count; i++) {
        const sp_hit *hit = &hits[i];
        if (hit->triangle == SP_NONE)
            continue;
        sp_vec3 velocity = sp_ray_velocity(&rays[i], gravity, hit->t);
        double speed = sp_length(velocity);
        double cosine = fabs(sp_dot(velocity, sp_triangle_normal(mesh, hit->triangle))) / speed;
        float incidence = (float)acos(fmin(1, cosine));
        deposit *texel = &texture[sp_atlas_texel(atlas, hit->triangle, hit->u, hit->v)];
        if (!(texel->jets > 0) || incidence < texel->incidence_min)
            texel->incidence_min = incidence;
        texel->jets += 1;
        texel->speed += (float)speed;
        texel->incidence += incidence;
    }
}

/* The study shot its jets one by one. */
static void spray(const sp_tracer *tracer, const sp_ray *rays, size_t count, sp_vec3 gravity, sp_hit *hits)
{
    for (size_t i = 0; i < count; i++)
        hits[i] = sp_trace_nearest(tracer, &rays[i], gravity);
}

static bench_study_row measure(const sp_tracer *tracer, const sp_atlas *atlas, const sp_ray *rays, size_t count,
                               sp_vec3 gravity, deposit *texture)
{
    sp_hit hits[JETS];
    double seconds[MOST_ROUNDS], sum = 0;
    size_t rounds = 0;
    bench_study_row row = {.rays = count};
    while (rounds < MOST_ROUNDS && sum < ENOUGH) {
        double start = sp_now();
        spray(tracer, rays, count, gravity, hits);
        write_deposits(sp_tracer_mesh(tracer), atlas, rays, hits, count, gravity, texture);
        seconds[rounds] = sp_now() - start;
        sum += seconds[rounds++];
    }
    for (size_t i = 0; i < count; i++)
        row.hits += hits[i].triangle != SP_NONE;
    row.seconds = bench_median(seconds, rounds);
    return row;
}

bool bench_study(const bench_scaffold *scaffold, const bench_stage *stage, const sp_atlas *atlas, const sp_run *run,
                 bench_study_row rows[STUDY_ROWS], size_t *count, sp_error *error)
{
    sp_ray rays[JETS];
    double most = MOST_TESTS / (double)stage->mesh->triangle_count;
    size_t loop_jets = most > JETS ? JETS : most < 10 ? 10 : (size_t)most;
    deposit *texture = calloc(atlas->texel_count + 1, sizeof *texture);
    if (!texture)
        return sp_fail_memory(error);
    *count = 0;
    for (int trajectory = 0; trajectory < TRAJECTORIES; trajectory++)
        for (int at = 0; at < OWN; at++) {
            size_t jets = at == OWN_NONE ? loop_jets : JETS;
            bench_rays_make(stage, MODE_CONE, trajectory, rays, JETS);
            bench_study_row *row = &rows[(*count)++];
            *row = measure(scaffold->tracers[at], atlas, rays, jets, bench_gravity(trajectory), texture);
            row->accelerator = at;
            row->trajectory = trajectory;
            if (!run->progress(run->user, "study", (double)*count / STUDY_ROWS)) {
                free(texture);
                return sp_fail(error, SP_ERROR_INTERRUPTED, NULL, 0, 0, "interrupted");
            }
        }
    free(texture);
    return true;
}
