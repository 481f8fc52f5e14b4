#include "attainable/reflected.h"

#include "attainable/patch_at.h"

#include <stdlib.h>

#define JETS 1048576.0   /* all together */
#define JETS_LEAST 256.0 /* of a mounting point and a launch */
#define JETS_MOST 16384.0
#define BOUNCES 3
#define SHARE 0.1  /* of the time left, at most: it explains what is dry and finds no nozzle */
#define MOUTH 1e-7 /* texels that a jet flies off a wall before anything stops it */

/* One jet, from wall to wall; marks the patches that it meets after its first reflection. */
static void follow(const sp_evaluator *coarse, sp_launch launch, sp_ray ray, bool *met)
{
    const sp_setup *setup = sp_evaluator_setup(coarse);
    for (int bounce = 0; bounce <= BOUNCES; bounce++) {
        sp_meeting meeting = sp_evaluator_meet(coarse, launch, &ray, bounce > 0);
        sp_hit hit = meeting.hit;
        if (hit.triangle == SP_NONE)
            return;
        sp_vec3 velocity = meeting.velocity, normal = sp_triangle_normal(setup->mesh, hit.triangle);
        double across = sp_dot(velocity, normal);
        uint32_t patch = bounce ? sp_patch_of(coarse, hit.triangle, hit.u, hit.v, across > 0) : SP_NONE;
        if (patch != SP_NONE) {
#pragma omp atomic write
            met[patch] = true;
        }
        const sp_surface *surface = &setup->surfaces[setup->mesh->part[hit.triangle]];
        if (!(surface->restitution > 0) || !(surface->rebound > 0))
            return;
        ray.origin = meeting.point;
        ray.velocity = sp_along(velocity, -(1 + surface->restitution) * across, normal);
        double speed = sp_length(ray.velocity);
        if (!(speed > 0))
            return;
        ray.t_min = MOUTH * sp_evaluator_fidelity(coarse)->texel / speed;
    }
}

/* Jets over all directions that a site's nozzles can be aimed at, spread evenly (Swinbank and Purser 2006). */
static void follow_site(const sp_search *search, const sp_site *site, size_t launch, size_t jets, bool *met)
{
    static const double golden = 0.61803398874989484820;
    double half_angle = sp_visibility_needed(search->options, search->candidates, site, launch);
    sp_launch own = search->candidates->launches[launch];
    sp_frame frame = sp_nozzle_frame(site->axis, 0, sp_evaluator_setup(search->coarse)->up);
    if (half_angle < 0)
        return;
    for (size_t i = 0; i < jets; i++) {
        double z = 1 - (1 - cos(half_angle)) * ((double)i + 0.5) / (double)jets, turns = (double)i * golden;
        double longitude = 2 * M_PI * (turns - floor(turns)), radius = sqrt(fmax(0, 1 - z * z));
        sp_vec3 direction = sp_v(radius * cos(longitude), radius * sin(longitude), z);
        sp_ray ray = {.origin = site->position,
                      .velocity = sp_scale(sp_frame_axis(&frame, direction), own.speed),
                      .t_max = INFINITY,
                      .skip = SP_NONE};
        follow(search->coarse, own, ray, met);
    }
}

/* Marks the coarse patches that reflected jets of all sites meet, as far as time goes. */
static void follow_all(const sp_search *search, sp_deadline *deadline, bool *met)
{
    size_t launches = search->candidates->launch_count, views = search->sites->count * launches;
    size_t jets = (size_t)fmin(JETS_MOST, fmax(JETS_LEAST, JETS / (double)views));
    double until = (1 - SHARE) * sp_deadline_left(deadline);
    bool late = false;
#pragma omp parallel for num_threads(sp_threads(&search->options->run)) schedule(dynamic, 1) reduction(|| : late)
    for (size_t i = 0; i < views; i++) {
        if (!sp_deadline_goes_on(deadline, "attainable", 1) || sp_deadline_left(deadline) < until)
            late = true;
        else
            follow_site(search, &search->sites->items[i / launches], i % launches, jets, met);
    }
    if (late)
        sp_deadline_cut(deadline, "attainable");
}

bool sp_bounces(const sp_evaluator *fine, const sp_search *search, sp_deadline *deadline, sp_reason *reasons,
                sp_error *error)
{
    size_t patches = sp_evaluator_patches(fine)->count, unseen = 0;
    for (size_t p = 0; p < patches; p++)
        unseen += reasons[p] == SP_REASON_NO_LINE;
    if (!unseen || !sp_setup_throws_back(sp_evaluator_setup(fine)))
        return true;
    bool *met = calloc(search->patch_count ? search->patch_count : 1, sizeof *met);
    if (!met)
        return sp_fail_memory(error);
    follow_all(search, deadline, met);
    for (size_t p = 0; p < patches; p++) {
        uint32_t patch = reasons[p] == SP_REASON_NO_LINE ? sp_coarse_patch(fine, search->coarse, p) : SP_NONE;
        if (patch != SP_NONE && met[patch])
            reasons[p] = SP_REASON_REFLECTION;
    }
    free(met);
    return true;
}
