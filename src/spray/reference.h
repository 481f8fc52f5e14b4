/* What a coverage is compared with: what holds at single points. */
#ifndef SPRAY_REFERENCE_H
#define SPRAY_REFERENCE_H

#include "nozzle_bodies.h"
#include "watch.h"

#include <sprayplan/points.h>

struct sp_reference {
    sp_evaluator truth; /* the evaluator but for how liquid flies; owns nothing */
    sp_bodies bodies;
    sp_evaluator *walls; /* on which film is routed once more; NULL where it is not asked for, as what follows */
    sp_coverage *film;   /* theirs; of the deposits film alone is known */
    sp_watch *watch;     /* NULL, or: who asks whether to go on, of points */
};

/* point_verdict.c: whether what arrives at each point covers it, whatever runs down; [count], the caller's. False, with
 * an error, where memory ran out or the reference's watch stops. */
bool sp_judge_sprayed(const sp_reference *reference, const sp_point *points, size_t count, bool *covered,
                      sp_error *error);

#endif
