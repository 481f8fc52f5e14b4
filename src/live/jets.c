/* Ways that a few jets of a nozzle fly, to be drawn. */
#include "live/state.h"
#include "spray/paths.h"

#include <stdlib.h>
#include <string.h>

/* From where it is to its end: a jet's first leg from its pattern's place, any other from the end of the one before. */
static void write_leg(const sp_paths *paths, const sp_nozzle *patterns, size_t i, double row[SP_LIVE_LEG_NUMBERS])
{
    const sp_path_leg *leg = &paths->legs[i];
    bool begins = i == 0 || paths->legs[i - 1].jet != leg->jet;
    sp_vec3 from = begins ? patterns[paths->pattern[leg->jet]].position : paths->legs[i - 1].end;
    const double numbers[SP_LIVE_LEG_NUMBERS] = {from.x,     from.y,     from.z,    leg->end.x,
                                                 leg->end.y, leg->end.z, leg->rise, leg->bounce};
    memcpy(row, numbers, sizeof numbers);
}

size_t sp_live_fly(sp_live *live, size_t index)
{
    sp_nozzle nozzle;
    sp_paths paths = {0};
    live->error = (sp_error){0};
    if (!live->evaluator || !sp_live_nozzle_on(live, index, &nozzle) ||
        !sp_paths_fly(live->evaluator, &nozzle, &paths, &live->error))
        return 0;
    const sp_setup *setup = sp_evaluator_setup(live->evaluator);
    sp_nozzle *patterns = malloc(sp_nozzle_pattern_count(&nozzle) * sizeof *patterns);
    free(live->legs);
    live->legs = malloc((paths.leg_count + 1) * sizeof *live->legs);
    size_t count = patterns && live->legs ? paths.leg_count : 0;
    if (count)
        sp_nozzle_patterns(&nozzle, &setup->liquid, setup->up, patterns);
    for (size_t i = 0; i < count; i++)
        write_leg(&paths, patterns, i, live->legs[i]);
    free(patterns);
    sp_paths_free(&paths);
    return count;
}
