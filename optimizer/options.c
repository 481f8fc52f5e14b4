#include <sprayplan/place.h>

#include <math.h>

sp_place_options sp_place_options_default(void)
{
    return (sp_place_options){
        .objective = SP_OBJECTIVE_AREA_PER_WATER,
        .coverage = 0.99,
        .max_water = INFINITY,
        .refine = {.position = -1, .axis = 15 * M_PI / 180, .roll = true, .angle = INFINITY, .flow = INFINITY},
    };
}

static bool takes(const sp_nozzle_type *type, const char *expected, sp_error *error)
{
    return type->pattern != SP_PATTERN_ROTATING ||
           sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0, "place: type %s rotates, which is not supported yet; expected %s",
                   type->name, expected);
}

bool sp_place_takes(const sp_place_options *options, sp_error *error)
{
    for (size_t i = 0; i < options->type_count; i++)
        if (!takes(options->types[i], "types that do not, named under place: types", error))
            return false;
    for (size_t i = 0; options->kept && i < options->kept->count; i++)
        if (options->kept->nozzles[i].keep &&
            !takes(options->kept->nozzles[i].type, "nozzles that do not among those to keep", error))
            return false;
    return true;
}
