/* What a placement has made when refinement begins, for programs that go on from there in their own way. One thread. */
#ifndef SCENES_PLACEMENT_H
#define SCENES_PLACEMENT_H

#include "search/find.h"

#include <sprayplan/sprayplan.h>

typedef struct {
    sp_scene *scene;
    sp_evaluator *fine;
    sp_place_options options;
    sp_deadline deadline;
    sp_sites sites;
    sp_candidates candidates;
    sp_evaluator *coarse; /* NULL: the search sees `fine` */
    sp_visibility visibility;
    sp_search search;
    sp_pool pool;
    sp_front front;
} placement;

/* Ends the program where that fails, as fail() does. The placement must stay where it is; the caller closes it. */
void placement_open(const char *scene, placement *p);
void placement_close(placement *p);
/* Says what is wrong and ends the program. */
_Noreturn void fail(const sp_error *error);

#endif
