#include "refine/smooth_film.h"

#include <stdlib.h>

#define SURE 16.0 /* widths beyond the threshold where nothing changes any more */

bool sp_smooth_film_create(const sp_search *search, const sp_pose_parameters *parameters, const sp_sight *const *sights,
                           size_t count, double width, sp_smooth_film *film, sp_error *error)
{
    size_t patches = search->patch_count + 1, first = 0;
    *film =
        (sp_smooth_film){.search = search, .width = width, .count = count, .runs = calloc(count, sizeof *film->runs)};
    if (!film->runs)
        return sp_fail_memory(error);
    for (size_t i = 0; i < count; i++) {
        sp_smooth_runoff *own = &film->runs[i];
        size_t most = sights[i]->count + 1;
        *own = (sp_smooth_runoff){.parameters = &parameters[i], .sight = sights[i], .first = first};
        first += parameters[i].count;
        own->brought.amount = malloc(most * sizeof *own->brought.amount);
        own->brought.slope = malloc(most * SP_UNKNOWNS * sizeof *own->brought.slope);
        own->film = malloc(patches * sizeof *own->film);
        own->slope = malloc(patches * SP_UNKNOWNS * sizeof *own->slope);
        if (!own->brought.amount || !own->brought.slope || !own->film || !own->slope)
            return sp_fail_memory(error);
    }
    return true;
}

void sp_smooth_film_free(sp_smooth_film *film)
{
    for (size_t i = 0; film->runs && i < film->count; i++) {
        free(film->runs[i].brought.amount);
        free(film->runs[i].brought.slope);
        free(film->runs[i].film);
        free(film->runs[i].slope);
    }
    free(film->runs);
    *film = (sp_smooth_film){0};
}

/* The film of what the arrivals bring, or of a derivative of that. */
static void find_film(const sp_search *search, const sp_smooth_runoff *own, const double *brings, double times,
                      float *film)
{
    sp_runoff *runoff = sp_search_runoff(search);
    double *arriving = sp_runoff_arriving(runoff);
    const sp_nozzle *nozzle = &own->parameters->start;
    double flow = sp_nozzle_flow(nozzle, &sp_evaluator_setup(search->coarse)->liquid);
    for (size_t a = 0; a < own->sight->count; a++)
        arriving[own->sight->seen[a].patch] += times * brings[a];
    sp_runoff_find(runoff, nozzle->type, flow, film);
}

void sp_smooth_film_set(sp_smooth_film *film, size_t i, const double *chain)
{
    const sp_smooth_runoff *own = &film->runs[i];
    find_film(film->search, own, own->brought.amount, 1, own->film);
    for (size_t k = 0; chain && k < own->parameters->count; k++)
        find_film(film->search, own, &own->brought.slope[k * own->sight->count], chain[k],
                  &own->slope[k * film->search->patch_count]);
}

double sp_smooth_film_cover(const sp_smooth_film *film, size_t patch, double *rise)
{
    double sum = (double)film->search->kept_film[patch];
    for (size_t i = 0; i < film->count; i++)
        sum += (double)film->runs[i].film[patch];
    *rise = 0;
    double widths = sum > 0 ? log(sum) / film->width : -SURE;
    if (widths <= -SURE || widths >= SURE)
        return widths > 0;
    double cover = sp_smooth_step(widths);
    *rise = cover * (1 - cover) / (film->width * sum);
    return cover;
}
