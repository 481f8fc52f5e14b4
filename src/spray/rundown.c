#include "rundown.h"

#include "resolution.h"

#include <stdlib.h>
#include <string.h>

#define CELLS_MOST 30000.0 /* film varies over lengths far above a texel's: 80 mm instead of 5 change .4 points */
#define BANDS 64           /* of height, in which the outline is measured */

/* The evaluator of all wet sides, with nothing asked for. */
static sp_evaluator *create_walls(const sp_evaluator *evaluator, sp_error *error)
{
    sp_evaluator *walls = sp_evaluator_share(evaluator, evaluator->fidelity.texel, error);
    if (!walls)
        return NULL;
    walls->everything = true;
    walls->fidelity.texel = fmax(walls->fidelity.texel, sp_texel_of(walls, CELLS_MOST));
    walls->setup.criterion = (sp_criterion){.incidence = M_PI / 2};
    walls->fidelity.method = SP_METHOD_INVERSE;
    walls->fidelity.reflections = 0;
    walls->fidelity.splat = SP_SPLAT_NEAREST;
    if (sp_texels_create(walls, NULL, error))
        return walls;
    sp_evaluator_destroy(walls);
    return NULL;
}

static void find_cells(const sp_evaluator *evaluator, sp_rundown *rundown)
{
    const sp_patches *patches = &evaluator->patches;
    for (size_t i = 0; i < patches->count; i++) {
        uint32_t triangle = patches->triangle[i];
        double u, v;
        sp_triangle_weights(evaluator->setup.mesh, triangle, patches->point[i], &u, &v);
        rundown->cell[i] =
            rundown->walls
                ->texel_patch[sp_atlas_texel(rundown->walls->atlas, triangle, u, v)][patches->side[i] == SP_SIDE_BACK];
    }
}

static int rising(const void *left, const void *right)
{
    double a = *(const double *)left, b = *(const double *)right;
    return (a > b) - (a < b);
}

/* Adds the sideways extent of a wall that rises from `from` to `to`, in bands from 0 on, to all that it crosses. */
static void add_extent(double length[BANDS], double from, double to, double extent)
{
    int last = (int)fmin(fmax(to, 0), BANDS - 1);
    for (int i = (int)fmin(fmax(from, 0), BANDS - 1); i <= last; i++) {
        double within = fmin(to, i + 1) - fmax(from, i);
        length[i] += to > from ? extent * fmax(0, within) / (to - from) : extent;
    }
}

/* The median, over bands of equal height, of Σ area sin(slope) / height. A cell may be higher than a band. */
static double measure_outline(const sp_evaluator *walls)
{
    const sp_patches *cells = &walls->patches;
    sp_vec3 up = sp_unit(walls->setup.up);
    double low = INFINITY, high = -INFINITY, length[BANDS] = {0};
    for (size_t i = 0; i < cells->count; i++) {
        low = fmin(low, sp_dot(cells->point[i], up));
        high = fmax(high, sp_dot(cells->point[i], up));
    }
    double band = (high - low) / BANDS;
    for (size_t i = 0; band > 0 && i < cells->count; i++) {
        double slope = sp_length(sp_cross(cells->normal[i], up)), at = (sp_dot(cells->point[i], up) - low) / band;
        double half = 0.5 * slope * cells->length[i] / band;
        add_extent(length, at - half, at + half, cells->area[i] * slope / band);
    }
    qsort(length, BANDS, sizeof *length, rising);
    return length[BANDS / 2];
}

bool sp_rundown_create(sp_evaluator *evaluator, sp_error *error)
{
    if (!(evaluator->setup.criterion.film > 0))
        return true;
    sp_rundown *rundown = evaluator->rundown = calloc(1, sizeof *rundown);
    if (!rundown)
        return sp_fail_memory(error);
    rundown->cell = malloc((evaluator->patches.count + 1) * sizeof *rundown->cell);
    if (!rundown->cell)
        return sp_fail_memory(error);
    rundown->walls = create_walls(evaluator, error);
    if (!rundown->walls)
        return false;
    const sp_evaluator *walls = rundown->walls;
    rundown->film = sp_film_create(&(sp_film_surface){.mesh = walls->setup.mesh,
                                                      .atlas = walls->atlas,
                                                      .tracer = walls->tracer,
                                                      .cells = &walls->patches,
                                                      .cell_of = (const uint32_t(*)[2])walls->texel_patch,
                                                      .down = sp_scale(sp_unit(walls->setup.up), -1)},
                                   error);
    if (!rundown->film)
        return false;
    find_cells(evaluator, rundown);
    rundown->outline = measure_outline(walls);
    return true;
}

void sp_rundown_destroy(sp_rundown *rundown)
{
    if (!rundown)
        return;
    sp_evaluator_destroy(rundown->walls);
    sp_film_destroy(rundown->film);
    free(rundown->cell);
    free(rundown);
}

bool sp_rundown_find(const sp_rundown *rundown, const sp_layout *layout, sp_coverage *coverage, sp_error *error)
{
    const sp_patches *cells = &rundown->walls->patches;
    sp_coverage *arriving = sp_evaluate_inverse(rundown->walls, layout, error);
    double *flow = arriving ? arriving->deposits.flux : NULL, *film = malloc((cells->count + 1) * sizeof *film);
    sp_film_balance *balance = &coverage->film;
    *balance = (sp_film_balance){.known = true};
    for (size_t i = 0; flow && i < cells->count; i++) {
        flow[i] *= cells->area[i];
        balance->arriving += flow[i];
    }
    sp_film_ends ends = {0};
    bool done = flow && (film || sp_fail_memory(error)) && sp_film_run(rundown->film, flow, film, &ends, error);
    for (size_t i = 0; done && i < coverage->deposits.count; i++)
        coverage->deposits.film[i] = rundown->cell[i] == SP_NONE ? 0 : film[rundown->cell[i]];
    balance->left = ends.left;
    balance->astray = ends.astray;
    balance->held = ends.held;
    balance->per_outline = rundown->outline > 0 ? balance->arriving / rundown->outline : 0;
    sp_coverage_destroy(arriving);
    free(film);
    return done;
}
