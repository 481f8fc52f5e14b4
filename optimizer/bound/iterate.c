#include "bound/iterate.h"

#include "bound/pdhg.h"

#include <math.h>
#include <string.h>

#define LOOK 25 /* iterations between two looks at the bound */

bool sp_dual_iterate(sp_dual *dual, const sp_rows *rows, const sp_dual_task *task, sp_error *error)
{
    sp_pdhg h;
    if (!sp_pdhg_create(dual, rows, task, &h, error))
        return false;
    dual->bound = INFINITY;
    dual->reached = -INFINITY;
    for (size_t i = 1; i <= task->iterations; i++) {
        sp_pdhg_step(&h);
        if (i % LOOK == 0 && (sp_pdhg_look(&h, i) || !sp_cover_goes_on(dual->cover)))
            break;
    }
    memcpy(dual->dual_resource, h.dual_resource, h.resources * sizeof *h.dual_resource);
    sp_pdhg_free(&h);
    return true;
}
