/* Fields: what one nozzle brings to every patch. */
#ifndef OPTIMIZER_FIELD_H
#define OPTIMIZER_FIELD_H

#include "scoring/wetness.h"

/* A nozzle's spray in the world. */
typedef struct {
    sp_spray spray;
    sp_frame frame;
    double strength; /* flux over threshold per transfer, m²; INFINITY where any liquid covers */
    const sp_nozzle_type *type;
    double flow; /* m³/s */
} sp_posed_spray;

sp_posed_spray sp_posed_spray_of(const sp_search *search, const sp_nozzle *nozzle);

/* A field (see sp_placed) in the making, arrival by arrival. */
typedef struct {
    const sp_search *search;
    sp_posed_spray posed;
    sp_runoff *runoff; /* NULL: film is not asked for */
    double *arriving;  /* [patch_count], m³/s, the runoff's */
    double intensity;  /* m³/s per steradian, in units of the transfers that it will hear of */
    float *field;
} sp_field_making;

/* `scale`: of a unit of transfer, m². `field` [field_count] is the caller's. */
sp_field_making sp_field_begin(const sp_search *search, const sp_posed_spray *posed, double scale, float *field);
/* An arrival at `part` of a patch; one that does not pass the criterion's speed and incidence feeds the film alone. */
void sp_field_add(const sp_field_making *making, uint32_t patch, bool passes, sp_vec3 direction, double breadth,
                  double transfer, float part);
void sp_field_end(const sp_field_making *making);

/* Field of a spray at a view's mounting point; its strength is per transfer as the view has it. */
void sp_field_view(const sp_search *search, const sp_view *view, const sp_posed_spray *posed, float *field);
/* The same of a candidate pose. */
void sp_field_pose(const sp_search *search, sp_pose pose, float *field);
/* The same of any nozzle whose type is uniform, traced anew. With `wet` [patch_count], a partial layout's (NULL: none),
 * patches that it wets enough are left out: what the nozzle adds to that layout stays the same. */
bool sp_field_nozzle(const sp_search *search, const sp_nozzle *nozzle, const float *wet, float *field, sp_error *error);
/* One thread's memory for fields by the kernels, which are a little less exact and made much faster. */
typedef struct {
    const sp_view *view;
    const sp_cull *cull;      /* of the view and the variant's spray */
    float more;               /* share by which all is rounded upwards */
    float *share, *counts;    /* [largest view + 2 SP_LANES] */
    sp_run_of_arrivals *runs; /* [SP_BINS] */
} sp_field_scratch;
/* The field of a variant in a region that was turned to the pose. */
void sp_field_region(const sp_search *search, const sp_field_scratch *scratch, const sp_variant *variant,
                     const sp_region *region, float *field);

/* Flux over threshold per transfer of a view. */
double sp_variant_strength(const sp_search *search, const sp_variant *variant);
#endif
