/* Bounds that hold for every aim at the candidates' mounting points, not only for the candidates'. */
#ifndef OPTIMIZER_EVERY_AIM_H
#define OPTIMIZER_EVERY_AIM_H

#include "bound/bound.h"
#include "search/front.h"
#include "certificate/water_units.h"

/* What the certificate of the candidates has made, all borrowed. */
typedef struct {
    const sp_search *search;
    sp_deadline *deadline;
    const sp_cover *cover;
    const sp_water_units *units;
    const float *need;   /* [patches] */
    const size_t *ports; /* [mounts] */
    const sp_rows *rows; /* candidates that make good layouts, by the cover's tiers; and the layouts' own nozzles */
    const double *costs; /* [cost_count], m³/s: of mounts, each once */
    size_t cost_count;
} sp_aim_task;

/* Fills certificate->every_aim, and every_aim_bound of the front's points, after all else of them. */
bool sp_every_aim(const sp_aim_task *task, sp_front *front, sp_certificate *certificate, sp_error *error);

#endif
