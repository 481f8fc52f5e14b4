/* Film, or the dose of goods that move, nozzle by nozzle, for who adds up those of many layouts. */
#include "falling_film.h"
#include "nozzle/pattern.h"
#include "stream_spread.h"

#include <stdlib.h>
#include <string.h>

struct sp_runoff {
    const sp_evaluator *walls;
    sp_stream_spread discs;
    double *arriving;  /* [patches], m³/s */
    double *spread;    /* [patches], the same once streams have spread over their discs */
    double *flow;      /* the film's own */
    double *per_width; /* [patches], m²/s */
};

/* What a film takes besides. */
static bool create_film(sp_runoff *runoff, sp_error *error)
{
    const sp_evaluator *walls = runoff->walls;
    size_t room = walls->patches.count + 1;
    runoff->spread = malloc(room * sizeof *runoff->spread);
    runoff->flow = malloc(sp_film_flows(walls->falling_film->film) * sizeof *runoff->flow);
    runoff->per_width = malloc(room * sizeof *runoff->per_width);
    return sp_stream_spread_create(&walls->patches, &runoff->discs, error) &&
           ((runoff->spread && runoff->flow && runoff->per_width) || sp_fail_memory(error));
}

sp_runoff *sp_runoff_create(const sp_evaluator *walls, sp_error *error)
{
    if (!walls)
        return NULL;
    bool film = walls->falling_film && walls->falling_film->walls == walls;
    bool dose = walls->movers && walls->setup.criterion.flux > 0;
    if (!film && !dose) {
        sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0,
                "runoff: expected an evaluator of all wet sides, made for searching, and a criterion of film, or goods "
                "that move and a dose");
        return NULL;
    }
    sp_runoff *runoff = calloc(1, sizeof *runoff);
    if (!runoff)
        return sp_fail_memory(error);
    runoff->walls = walls;
    runoff->arriving = calloc(walls->patches.count + 1, sizeof *runoff->arriving);
    if ((runoff->arriving || sp_fail_memory(error)) && (dose || create_film(runoff, error)))
        return runoff;
    sp_runoff_destroy(runoff);
    return NULL;
}

void sp_runoff_destroy(sp_runoff *runoff)
{
    if (!runoff)
        return;
    sp_stream_spread_free(&runoff->discs);
    free(runoff->arriving);
    free(runoff->spread);
    free(runoff->flow);
    free(runoff->per_width);
    free(runoff);
}

double *sp_runoff_arriving(sp_runoff *runoff)
{
    return runoff->arriving;
}

/* What arrives stays where it does. */
static void find_dose(sp_runoff *runoff, float *dose)
{
    const sp_evaluator *walls = runoff->walls;
    for (size_t i = 0; i < walls->patches.count; i++)
        dose[i] = (float)(runoff->arriving[i] / (walls->patches.area[i] * walls->setup.criterion.flux));
    memset(runoff->arriving, 0, walls->patches.count * sizeof *runoff->arriving);
}

void sp_runoff_find(sp_runoff *runoff, const sp_nozzle_type *type, double flow, float *film)
{
    const sp_evaluator *walls = runoff->walls;
    size_t count = walls->patches.count;
    double *from = runoff->arriving;
    if (walls->movers) {
        find_dose(runoff, film);
        return;
    }
    if (sp_type_is_stream(type)) {
        from = runoff->spread;
        memset(from, 0, count * sizeof *from);
        sp_stream_spread_add(&runoff->discs, &walls->setup.liquid, flow, runoff->arriving, from);
    }
    sp_film_run_in(walls->falling_film->film, from, runoff->flow, runoff->per_width, NULL);
    memset(runoff->arriving, 0, count * sizeof *runoff->arriving);
    double scale = 1 / walls->setup.criterion.film;
    for (size_t i = 0; i < count; i++)
        film[i] = (float)(runoff->per_width[i] * scale);
}
