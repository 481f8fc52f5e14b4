#include <sprayplan/place.h>

#include <math.h>

sp_place_options sp_place_options_default(void)
{
    return (sp_place_options){
        .objective = SP_OBJECTIVE_AREA_PER_WATER,
        .coverage = 0.99,
        .max_water = INFINITY,
        .mend_kept = true,
        .refine = {.position = -1, .axis = 15 * M_PI / 180, .roll = true, .angle = INFINITY, .flow = INFINITY},
    };
}
