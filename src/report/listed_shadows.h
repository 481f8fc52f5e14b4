/* The shadows of a design that the page lists, and where they are. */
#ifndef REPORT_LISTED_SHADOWS_H
#define REPORT_LISTED_SHADOWS_H

#include "page.h"

typedef struct {
    size_t count; /* at most SP_PAGE_SHADOWS */
    sp_shadow shadow[SP_PAGE_SHADOWS];
    size_t patches;
    uint32_t *number; /* [patches], from 1 as the page has them, 0 in no shadow that is listed; owned */
} sp_listed_shadows;

/* Of a design with an evaluator. */
bool sp_listed_shadows_find(sp_listed_shadows *listed, const sp_design *design, sp_error *error);
/* Accepts what is all zeros. */
void sp_listed_shadows_free(sp_listed_shadows *listed);

#endif
