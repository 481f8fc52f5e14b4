/* Images with speeds: their liquid in layers of one speed each, which are patterns on top of one another. */
#include "layers.h"

#include "patternation.h"

#include <assert.h>
#include <stdlib.h>

#define FASTEST 10.0 /* of the exit speed */
#define STEP 1.05    /* from one layer's speed to the next */

typedef struct {
    const float *values, *speeds;
    size_t columns, rows, count; /* of pixels, and of speeds */
    double angle;
    double speed[SP_SPEEDS]; /* [count], rising */
} layering;

/* False, with an error, where liquid has no speed. */
static bool find_range(const layering *image, double *slowest, double *fastest, sp_error *error)
{
    *slowest = INFINITY;
    *fastest = 0;
    for (size_t i = 0; i < image->rows * image->columns; i++) {
        double speed = (double)image->speeds[i];
        if (!(image->values[i] > 0))
            continue;
        if (!(speed > 0 && speed <= FASTEST))
            return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                           "a speed of %g found in column %zu of row %zu, expected one above 0, up to %g times the "
                           "exit speed, where there is liquid",
                           speed, i % image->columns + 1, i / image->columns + 1, FASTEST);
        *slowest = fmin(*slowest, speed);
        *fastest = fmax(*fastest, speed);
    }
    return true;
}

/* From the slowest to the fastest in equal proportions. */
static void set_speeds(layering *image, double slowest, double fastest)
{
    assert(slowest > 0 && slowest <= fastest);
    double steps = ceil(log(fastest / slowest) / log(STEP) - 1e-9);
    image->count = (size_t)fmin(SP_SPEEDS, fmax(1, steps + 1));
    for (size_t k = 0; k < image->count; k++)
        image->speed[k] = k ? slowest * pow(fastest / slowest, (double)k / (double)(image->count - 1)) : slowest;
}

/* The share of liquid of a speed that layer `k` has: what is between two is dealt out as a lever balances. */
static double share_at(const layering *image, size_t k, double speed)
{
    const double *own = &image->speed[k];
    if (speed < own[0])
        return k ? fmax(0, (speed - own[-1]) / (own[0] - own[-1])) : 1;
    return k + 1 < image->count ? fmax(0, (own[1] - speed) / (own[1] - own[0])) : 1;
}

/* False with an error; a layer without liquid has no patternation. */
static bool lay(const layering *image, size_t k, float *room, sp_speed_layer *layer, sp_error *error)
{
    bool any = false;
    for (size_t i = 0; i < image->rows * image->columns; i++) {
        bool wet = image->values[i] > 0;
        room[i] = wet ? (float)((double)image->values[i] * share_at(image, k, (double)image->speeds[i])) : 0;
        any = any || room[i] > 0;
    }
    *layer = (sp_speed_layer){.speed = image->speed[k]};
    if (!any)
        return true;
    layer->patternation = sp_patternation_create(room, image->columns, image->rows, image->angle, error);
    return layer->patternation != NULL;
}

/* All layers with liquid, and what share each has of it; 0 on error. */
static size_t lay_all(const layering *image, float *room, sp_speed_layer *layers, sp_error *error)
{
    size_t kept = 0;
    double all = 0;
    for (size_t k = 0; k < image->count; k++) {
        if (!lay(image, k, room, &layers[kept], error)) {
            while (kept > 0)
                sp_patternation_destroy(layers[--kept].patternation);
            return 0;
        }
        kept += layers[kept].patternation != NULL;
    }
    for (size_t k = 0; k < kept; k++)
        all += layers[k].patternation->liquid;
    assert(kept == 0 || all > 0);
    for (size_t k = 0; k < kept; k++)
        layers[k].share = layers[k].patternation->liquid / all;
    return kept;
}

size_t sp_patternation_layers(const float *values, const float *speeds, size_t columns, size_t rows, double angle,
                              sp_speed_layer layers[SP_SPEEDS], sp_error *error)
{
    layering image = {.values = values, .speeds = speeds, .columns = columns, .rows = rows, .angle = angle};
    double slowest, fastest;
    if (!speeds || !sp_patternation_check(values, columns, rows, angle, error) ||
        !find_range(&image, &slowest, &fastest, error))
        return 0;
    set_speeds(&image, slowest, fastest);
    float *room = malloc(rows * columns * sizeof *room);
    if (!room) {
        sp_fail_memory(error);
        return 0;
    }
    size_t kept = lay_all(&image, room, layers, error);
    free(room);
    return kept;
}

bool sp_type_needs_images(const sp_nozzle_type *type)
{
    bool needs = sp_type_is_measured(type);
    for (size_t i = 0; i < type->member_count; i++)
        needs |= sp_type_is_measured(&type->members[i].type);
    return needs;
}

/* In one place. */
bool sp_type_take_layers(sp_nozzle_type *type, const sp_speed_layer *layers, size_t count, sp_error *error)
{
    sp_member *members = calloc(count, sizeof *members);
    if (!members)
        return sp_fail_memory(error);
    for (size_t i = 0; i < count; i++) {
        members[i] = (sp_member){.type = *type, .axis = {0, 0, 1}, .share = layers[i].share, .speed = layers[i].speed};
        members[i].type.patternation = layers[i].patternation;
    }
    type->pattern = SP_PATTERN_CLUSTER;
    type->angle = type->angle_min = type->angle_max = 0;
    type->members = members;
    type->member_count = count;
    return true;
}
