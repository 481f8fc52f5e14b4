/* Simulated annealing over layouts of all candidate poses: for what greedy orders and exchanges of the pool's poses do
 * not find, such as nozzles that suffice only together. */
#ifndef OPTIMIZER_SIMULATED_ANNEALING_H
#define OPTIMIZER_SIMULATED_ANNEALING_H

#include "scoring/scoring.h"

/* Simulated annealing (Kirkpatrick, Gelatt and Vecchi, Science 220, 1983) whose step takes one or two nozzles out and
 * puts in what gains most of a few candidate poses drawn at random (as ruin and recreate: Schrimpf and others, J.
 * Comput. Phys. 159, 2000), within an outlay of `budget` (m³/s). The partial layout becomes the layout met that covers
 * most. `effort`: patches gone through, which sets the number of steps. Runs on the thread that calls; the same for the
 * same seed. */
bool sp_simulated_annealing(const sp_search *search, double budget, double effort, uint64_t seed, sp_deadline *deadline,
                            sp_partial *partial, sp_error *error);

#endif
