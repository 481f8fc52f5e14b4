#include "listed_shadows.h"

#include <stdlib.h>
#include <string.h>

bool sp_listed_shadows_find(sp_listed_shadows *listed, const sp_design *design, sp_error *error)
{
    sp_shadow *all = NULL;
    size_t count = 0;
    *listed = (sp_listed_shadows){0};
    if (!sp_shadows(design->evaluator, design->coverage, NULL, &all, &count, error))
        return false;
    listed->count = count < SP_PAGE_SHADOWS ? count : SP_PAGE_SHADOWS;
    if (all)
        memcpy(listed->shadow, all, listed->count * sizeof *all);
    free(all);
    listed->patches = sp_evaluator_patches(design->evaluator)->count;
    listed->number = malloc((listed->patches + 1) * sizeof *listed->number);
    if (listed->number &&
        sp_shadow_numbers(design->evaluator, design->coverage, listed->shadow, listed->count, listed->number, error))
        return true;
    sp_listed_shadows_free(listed);
    return sp_fail_memory(error);
}

void sp_listed_shadows_free(sp_listed_shadows *listed)
{
    free(listed->number);
    *listed = (sp_listed_shadows){0};
}
