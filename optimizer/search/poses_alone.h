/* What each of a few candidate poses does alone, on the patches that layouts are measured on. */
#ifndef OPTIMIZER_POSES_ALONE_H
#define OPTIMIZER_POSES_ALONE_H

#include "deadline/deadline.h"
#include "scoring/search.h"
#include "spray/alone.h"

typedef struct {
    const sp_evaluator *evaluator;
    size_t count, patches;
    sp_pose *poses;  /* [count], by site: those that may stand there */
    sp_alone *alone; /* [count + 1], the last of the kept nozzles */
    double *area;    /* [patches], m² to be cleaned */
} sp_poses_alone;

/* All poses; none where they are more than `most`, or numbers about them too many to keep. Freed by the caller, after
 * failure too. */
bool sp_poses_alone_list(const sp_search *search, const sp_evaluator *evaluator, size_t most, sp_poses_alone *poses,
                         sp_error *error);
/* Evaluates each; *done is false where time ran out before the last, in the stage of that name. */
bool sp_poses_alone_evaluate(const sp_search *search, sp_deadline *deadline, const char *stage, sp_poses_alone *poses,
                             bool *done, sp_error *error);
void sp_poses_alone_free(sp_poses_alone *poses);

#endif
