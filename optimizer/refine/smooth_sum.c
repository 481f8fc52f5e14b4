#include "refine/smooth_sum.h"

#include "team.h"

#include <stdlib.h>
#include <string.h>

#define SURE 16.0 /* widths above the threshold where nothing is missing any more */

/* What is missing at a patch: the product of what each nozzle alone, all hits together, and films leave dry. */
typedef struct {
    double weight;   /* root of the patch's area, as a share of all: the solver's tolerances are absolute, and must not
                      * know the unit of length */
    double alone;    /* what no nozzle covers alone */
    double together; /* what all hits together do not cover; 1 where they do not add up */
    double film;     /* 1 where it is not asked for */
    double by_flux;  /* how `together` changes per flux */
    double by_film;  /* how `film` changes per film of all nozzles */
} sp_smooth_miss;

/* The link behind the last of the same nozzle's at a patch. */
static size_t end_of_group(const sp_smooth_objective *smooth, size_t patch, size_t first)
{
    size_t end = first + 1;
    while (end < smooth->start[patch + 1] && smooth->links[end].nozzle == smooth->links[first].nozzle)
        end++;
    return end;
}

/* The share of a patch that a nozzle's arrivals leave dry, links `first` to before `end`. */
static double left_dry(const sp_smooth_objective *smooth, size_t first, size_t end)
{
    double cover = 0;
    for (size_t l = first; l < end; l++)
        cover += smooth->nozzles[smooth->links[l].nozzle].arrivals.alone[smooth->links[l].arrival];
    return cover > 1 ? 0 : 1 - cover; /* and not a number where it is none */
}

static void miss_of_hits(const sp_smooth_objective *smooth, size_t patch, sp_smooth_miss *at)
{
    const sp_search *search = smooth->search;
    double sum = (double)search->kept_hit[patch];
    at->together = 1;
    at->alone = sum >= 1 ? 0 : (double)search->kept_dry[patch];
    for (size_t l = smooth->start[patch], end; l < smooth->start[patch + 1]; l = end) {
        end = end_of_group(smooth, patch, l);
        at->alone *= left_dry(smooth, l, end);
        for (size_t k = l; k < end; k++)
            sum += smooth->nozzles[smooth->links[k].nozzle].arrivals.flux[smooth->links[k].arrival];
    }
    if (search->alone || sum <= 0)
        return;
    double widths = log(sum) / smooth->width.coverage;
    if (widths < -SURE)
        return;
    double cover = widths > SURE ? 1 : sp_smooth_step(widths);
    at->together = 1 - cover;
    at->by_flux = -cover * (1 - cover) / (smooth->width.coverage * sum);
}

/* What all but this nozzle leave dry alone. */
static double alone_but(const sp_smooth_objective *smooth, size_t patch, uint32_t nozzle)
{
    double miss = smooth->search->kept_hit[patch] >= 1 ? 0 : (double)smooth->search->kept_dry[patch];
    for (size_t l = smooth->start[patch], end; l < smooth->start[patch + 1]; l = end) {
        end = end_of_group(smooth, patch, l);
        if (smooth->links[l].nozzle != nozzle)
            miss *= left_dry(smooth, l, end);
    }
    return miss;
}

/* A patch's row of the Jacobian in the making, all zero but for the columns that are listed. */
typedef struct {
    double *row;
    size_t *columns, used;
} sp_smooth_row;

static void add_slope(sp_smooth_row *row, size_t column, double slope)
{
    if (slope == 0)
        return;
    if (row->row[column] == 0)
        row->columns[row->used++] = column;
    row->row[column] += slope;
}

/* Adds what the films' slopes make of the miss, `by_film` that of all films together. */
static void add_film(const sp_smooth_objective *smooth, size_t patch, double by_film, sp_smooth_row *row)
{
    for (size_t i = 0; by_film != 0 && i < smooth->film.count; i++) {
        const sp_smooth_runoff *runs = &smooth->film.runs[i];
        for (size_t k = 0; k < runs->parameters->count; k++)
            add_slope(row, runs->first + k, by_film * (double)runs->slope[k * smooth->search->patch_count + patch]);
    }
}

/* Adds a patch's row of the Jacobian, which is never held, to the normal matrix and the gradient. */
static void add_row(const sp_smooth_objective *smooth, size_t patch, const sp_smooth_miss *at, double *row,
                    size_t *columns, double *gradient, double *normal)
{
    size_t n = smooth->unknowns;
    sp_smooth_row own_row = {row, columns, 0};
    double weight = at->weight, miss = at->alone * at->together * at->film;
    for (size_t l = smooth->start[patch]; l < smooth->start[patch + 1]; l++) {
        const sp_smooth_nozzle *own = &smooth->nozzles[smooth->links[l].nozzle];
        size_t arrival = smooth->links[l].arrival;
        if (own->arrivals.alone[arrival] <= 0 && own->arrivals.flux[arrival] <= 0)
            continue;
        double by_alone = -weight * at->together * at->film * alone_but(smooth, patch, smooth->links[l].nozzle);
        double by_flux = weight * at->alone * at->film * at->by_flux;
        for (size_t k = 0; k < own->parameters->count; k++) {
            size_t slope = k * own->sight->count + arrival;
            add_slope(&own_row, own->first + k,
                      by_alone * own->arrivals.alone_slope[slope] + by_flux * own->arrivals.flux_slope[slope]);
        }
    }
    add_film(smooth, patch, weight * at->alone * at->together * at->by_film, &own_row);
    size_t used = own_row.used;
    for (size_t i = 0; i < used; i++) {
        gradient[columns[i]] += row[columns[i]] * weight * miss;
        for (size_t j = 0; j < used; j++)
            if (columns[j] <= columns[i])
                normal[columns[i] * n + columns[j]] += row[columns[i]] * row[columns[j]];
    }
    for (size_t i = 0; i < used; i++)
        row[columns[i]] = 0;
}

static sp_smooth_miss miss_at(const sp_smooth_objective *smooth, size_t patch)
{
    sp_smooth_miss at = {.weight = sqrt((double)smooth->search->area[patch]), .film = 1};
    miss_of_hits(smooth, patch, &at);
    if (!smooth->film.count)
        return at;
    at.film = 1 - sp_smooth_film_cover(&smooth->film, patch, &at.by_film);
    at.by_film = -at.by_film;
    return at;
}

/* Sums one chunk of the patches. `row` (all zero) and `columns` are the chunk's own scratch. */
static void sum_chunk(sp_smooth_objective *smooth, size_t chunk, bool slopes, double *row, size_t *columns)
{
    size_t n = smooth->unknowns, patches = smooth->search->patch_count;
    double *gradient = &smooth->chunk_gradient[chunk * n], *normal = &smooth->chunk_normal[chunk * n * n], cost = 0;
    if (slopes) {
        memset(gradient, 0, n * sizeof *gradient);
        memset(normal, 0, n * n * sizeof *normal);
    }
    for (size_t p = patches * chunk / SP_SMOOTH_CHUNKS; p < patches * (chunk + 1) / SP_SMOOTH_CHUNKS; p++) {
        if ((smooth->start[p] == smooth->start[p + 1] && !smooth->film.count) || smooth->search->area[p] <= 0)
            continue;
        sp_smooth_miss at = miss_at(smooth, p);
        double miss = at.alone * at.together * at.film;
        cost += at.weight * at.weight * miss * miss;
        if (slopes && miss > 0)
            add_row(smooth, p, &at, row, columns, gradient, normal);
    }
    smooth->chunk_cost[chunk] = cost;
}

/* What all threads that sum share. */
typedef struct {
    sp_smooth_objective *smooth;
    bool slopes;
    double *rows;    /* [SP_SMOOTH_CHUNKS][unknowns] */
    size_t *columns; /* the same */
} summing;

static void sum_part(void *user, size_t chunk)
{
    const summing *summing = user;
    size_t at = chunk * summing->smooth->unknowns;
    sum_chunk(summing->smooth, chunk, summing->slopes, &summing->rows[at], &summing->columns[at]);
}

bool sp_smooth_sum(sp_smooth_objective *smooth, bool slopes)
{
    size_t n = smooth->unknowns;
    summing summing = {smooth, slopes, calloc(SP_SMOOTH_CHUNKS * n, sizeof *summing.rows),
                       malloc(SP_SMOOTH_CHUNKS * n * sizeof *summing.columns)};
    bool done = summing.rows && summing.columns;
    if (done) {
        sp_team_do(SP_SMOOTH_CHUNKS, sp_threads(&smooth->search->options->run), sum_part, &summing);
        for (size_t chunk = 1; chunk < SP_SMOOTH_CHUNKS; chunk++) {
            smooth->chunk_cost[0] += smooth->chunk_cost[chunk];
            for (size_t i = 0; slopes && i < n; i++)
                smooth->chunk_gradient[i] += smooth->chunk_gradient[chunk * n + i];
            for (size_t i = 0; slopes && i < n * n; i++)
                smooth->chunk_normal[i] += smooth->chunk_normal[chunk * n * n + i];
        }
    }
    free(summing.rows);
    free(summing.columns);
    return done;
}
