/* Goods on their way past the nozzles: where they are when they are looked at, and what is in the way of liquid then.
 *
 * What stands and what moves have a tracer each. Goods that are `offset` from where the mesh has them are met by a ray
 * just when the mesh's are by the ray that starts as far back. */
#ifndef SPRAY_MOVERS_H
#define SPRAY_MOVERS_H

#include "nozzle/scramble.h"
#include "spray/drag/chain.h"
#include "spray/state/state.h"

typedef enum { SP_STANDING, SP_MOVING } sp_motion;

/* By sp_motion. */
typedef struct sp_movers {
    sp_mesh *mesh[2];     /* the parts of the setup's, by their numbers there */
    sp_tracer *tracer[2]; /* of these */
    uint32_t *whole[2];   /* [triangles of each], in the setup's mesh */
    uint32_t *own;        /* [triangles of the setup's mesh], in the one of these that has it */
} sp_movers;

/* NULL on error. */
sp_movers *sp_movers_create(const sp_setup *setup, sp_error *error);
/* Accepts NULL. */
void sp_movers_destroy(sp_movers *movers);

static inline sp_motion sp_motion_of(const sp_evaluator *evaluator, uint32_t triangle)
{
    const sp_setup *setup = &evaluator->setup;
    return setup->surfaces[setup->mesh->part[triangle]].moves ? SP_MOVING : SP_STANDING;
}

/* How far the goods are (m) when a share of the pass is over. */
static inline sp_vec3 sp_pass_offset(const sp_evaluator *evaluator, double share)
{
    const sp_sweep *sweep = &evaluator->setup.sweep;
    return sp_along(sweep->from, share, sp_sub(sweep->to, sweep->from));
}
/* The share of the pass that is over when a patch is looked at in one of the evaluator's positions, each of which
 * stands for as much of it. They are a texel apart at most, and lie a little farther on for one patch than for the
 * next, so that what patches in a row miss of the edge of a spray or shadow is not the same for all. */
static inline double sp_pass_share(const sp_evaluator *evaluator, uint32_t patch, size_t position)
{
    double phase = sp_fraction(patch * UINT64_C(0x9e3779b97f4a7c15)); /* Weyl's sequence */
    return ((double)position + phase) / (double)evaluator->positions;
}
/* How many there are on texels of this length (m), and m from one to the next. */
size_t sp_pass_positions(const sp_setup *setup, double texel);
double sp_pass_step(const sp_evaluator *evaluator);

/* Whether one of the two is in the way of a ray, which is given where it flies, with a triangle of the setup's mesh
 * to skip and what pulls at it (m/s²), while the goods are at `offset`. */
bool sp_movers_occlude(const sp_evaluator *evaluator, sp_motion motion, const sp_ray *ray, sp_vec3 acceleration,
                       sp_vec3 offset);
/* How far the goods are (m) while jet `index` of a nozzle flies: jets are spread evenly over the pass, whichever way
 * they fly. 0 where nothing moves. */
sp_vec3 sp_jet_offset(const sp_evaluator *evaluator, uint64_t index);
/* What each ray hits first, pulled at so (m/s²), goods being offset[i] from where the mesh has them; the same as the
 * tracer's where nothing moves. `hits` [count], triangles of the setup's mesh, is the caller's. */
void sp_jets_hit(const sp_evaluator *evaluator, const sp_ray *rays, sp_vec3 acceleration, const sp_vec3 *offset,
                 size_t count, int threads, sp_hit *hits);
/* The same of drops that air holds back. */
void sp_drops_land(const sp_evaluator *evaluator, const sp_drag *drag, const sp_ray *rays, sp_vec3 acceleration,
                   const sp_vec3 *offset, size_t count, int threads, sp_landing *landings);

#endif
