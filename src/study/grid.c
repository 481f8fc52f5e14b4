/* Which settings a study runs: every combination of what the scene leaves open and what would make a difference. */
#include "state.h"

#include <math.h>
#include <stdlib.h>

#define USUAL_TEXELS 100000  /* on all that counts, by the edge in the middle */
#define PASSING_TEXELS 10000 /* the same of goods that move, each looked at in a hundred positions and more */
#define MOST_JETS 10000000   /* of a nozzle */
#define MOST_JETS_IN_ALL 4e7 /* of all nozzles */
#define DRAG_JETS 10         /* times fewer where drag holds each back step by step */
#define JETS_WITH_BOUNCES 10 /* the same where each is followed through several walls */
enum { TEXELS = 4, FORWARD_TEXELS = 3, JET_STEPS = 3, BOUNCES = 4 };
static const double texel_steps[TEXELS] = {4, 2, 1, 0.5};
static const int bounce_steps[BOUNCES] = {0, 1, 2, 4};

bool sp_study_reflects(const sp_setup *setup)
{
    return setup->fidelity.reflections != 0 && setup->fidelity.method != SP_METHOD_INVERSE &&
           sp_setup_throws_back(setup);
}

sp_trajectory sp_study_reference_trajectory(const sp_setup *setup)
{
    sp_trajectory own = setup->fidelity.trajectory;
    return own == SP_TRAJECTORY_AUTO ? SP_TRAJECTORY_PARABOLA : own;
}

double sp_study_texel(const sp_setup *setup, double area)
{
    if (setup->fidelity.texel > 0)
        return setup->fidelity.texel;
    double texels = setup->sweep.speed > 0 ? PASSING_TEXELS : USUAL_TEXELS;
    double texel = sqrt(area / texels), power = pow(10, floor(log10(texel)));
    return round(texel / power) * power;
}

uint64_t sp_study_most_jets(const sp_setup *setup, size_t nozzles)
{
    if (setup->fidelity.jets > 0)
        return setup->fidelity.jets;
    uint64_t jets = MOST_JETS;
    double all = setup->fidelity.trajectory == SP_TRAJECTORY_DRAG ? MOST_JETS_IN_ALL / DRAG_JETS : MOST_JETS_IN_ALL;
    while (jets > 10000 && (double)jets * (double)nozzles > all)
        jets /= 10;
    return jets;
}

size_t sp_study_trajectories(const sp_setup *setup, sp_trajectory trajectories[SP_STUDY_TRAJECTORIES])
{
    sp_trajectory own = setup->fidelity.trajectory, reference = sp_study_reference_trajectory(setup);
    bool drag = own == SP_TRAJECTORY_DRAG, falls = setup->gravity > 0;
    size_t count = 0;
    if (drag || (own == SP_TRAJECTORY_AUTO && falls))
        trajectories[count++] = SP_TRAJECTORY_LINE;
    if (drag && falls)
        trajectories[count++] = SP_TRAJECTORY_PARABOLA;
    trajectories[count++] = reference;
    return count;
}

/* A grid while it is listed. */
typedef struct {
    const sp_setup *setup;
    double texel;
    uint64_t most_jets;
    size_t texels, forward_texels, jet_steps, bounces;
    sp_fidelity *cells;
    size_t count;
} listing;

static double texel_of(const listing *l, size_t step)
{
    return l->setup->fidelity.texel > 0 ? l->texel : l->texel * texel_steps[step];
}

static sp_fidelity *add(listing *l, sp_trajectory trajectory, sp_method method, size_t texel_step)
{
    sp_fidelity *cell = &l->cells[l->count++];
    *cell = l->setup->fidelity;
    cell->trajectory = trajectory;
    cell->method = method;
    cell->texel = texel_of(l, texel_step);
    cell->reflections = 0;
    cell->jets = 0;
    return cell;
}

/* Fewest jets first. */
static uint64_t jets_of(const listing *l, size_t step)
{
    uint64_t jets = l->most_jets;
    for (size_t i = step + 1; i < l->jet_steps; i++)
        jets /= 10;
    return jets;
}

static void add_forward(listing *l, sp_trajectory trajectory)
{
    for (size_t bounce = 0; bounce < l->bounces; bounce++)
        for (size_t step = 0; step < l->jet_steps; step++)
            for (size_t texel = 0; texel < l->forward_texels; texel++) {
                sp_fidelity *cell = add(l, trajectory, SP_METHOD_FORWARD, texel);
                cell->jets = jets_of(l, step);
                cell->reflections = l->bounces > 1 ? bounce_steps[bounce] : fmax(0, l->setup->fidelity.reflections);
            }
}

sp_fidelity *sp_study_grid(const sp_setup *setup, size_t nozzles, double texel, size_t *count, sp_error *error)
{
    const sp_fidelity *own = &setup->fidelity;
    bool reflects = sp_study_reflects(setup);
    listing l = {.setup = setup,
                 .texel = texel,
                 .most_jets = sp_study_most_jets(setup, nozzles),
                 .texels = own->texel > 0 ? 1 : TEXELS,
                 .forward_texels = own->texel > 0 ? 1 : FORWARD_TEXELS,
                 .jet_steps = own->jets > 0 ? 1 : JET_STEPS,
                 .bounces = reflects && own->reflections < 0 ? BOUNCES : 1,
                 .cells =
                     malloc(SP_STUDY_TRAJECTORIES * (TEXELS + FORWARD_TEXELS * JET_STEPS * BOUNCES) * sizeof *l.cells)};
    if (!l.cells)
        return sp_fail_memory(error);
    if (reflects && own->jets == 0)
        l.most_jets /= JETS_WITH_BOUNCES;
    sp_trajectory trajectories[SP_STUDY_TRAJECTORIES];
    size_t trajectory_count = sp_study_trajectories(setup, trajectories);
    for (size_t i = 0; i < trajectory_count; i++) {
        bool inverse = own->method != SP_METHOD_FORWARD && own->splat != SP_SPLAT_LINEAR && own->reflections <= 0;
        for (size_t step = 0; inverse && step < l.texels; step++)
            add(&l, trajectories[i], SP_METHOD_INVERSE, step);
        if (own->method != SP_METHOD_INVERSE)
            add_forward(&l, trajectories[i]);
    }
    *count = l.count;
    return l.cells;
}
