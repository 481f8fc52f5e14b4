#include "lit_share.h"

#include "spray/wet/cuts.h"

#include <stdlib.h>
#include <string.h>

#define JETS_A_CELL 12 /* so that hardly any cell within a spray is missed by all */

static double corner_side(const double a[2], const double b[2], const double p[2])
{
    return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
}

/* A patch's own cells in the making. */
typedef struct {
    const sp_evaluator *evaluator;
    uint32_t triangle;
    sp_texel_place place;
    uint64_t cells;
} cell_count;

/* Adds the cells whose middles lie in a convex piece of a triangle. */
static void add_cells(void *user, const sp_vec3 *polygon, int corners, double area)
{
    (void)area;
    cell_count *count = user;
    const double(*uv)[2] = (const double(*)[2])count->evaluator->atlas->uv[count->triangle];
    double corner[SP_PIECE_POINTS][2];
    for (int i = 0; i < corners; i++) {
        double u, v;
        sp_triangle_weights(count->evaluator->setup.mesh, count->triangle, polygon[i], &u, &v);
        for (int axis = 0; axis < 2; axis++)
            corner[i][axis] = (1 - u - v) * uv[0][axis] + u * uv[1][axis] + v * uv[2][axis];
    }
    for (unsigned i = 0; i < SP_LIT_EDGE * SP_LIT_EDGE && corners > 2; i++) {
        double p[2] = {count->place.x + (i % SP_LIT_EDGE + 0.5) / SP_LIT_EDGE,
                       count->place.y + (i / SP_LIT_EDGE + 0.5) / SP_LIT_EDGE};
        bool in = true;
        for (int k = 0; k < corners; k++)
            in = in && corner_side(corner[k], corner[(k + 1) % corners], p) >= 0;
        count->cells |= (uint64_t)in << i;
    }
}

static uint64_t own_cells(const sp_evaluator *evaluator, uint32_t patch)
{
    const sp_fragments *fragments = &evaluator->fragments;
    uint32_t texel = evaluator->patches.texel[patch];
    cell_count count = {.evaluator = evaluator, .place = sp_atlas_place(evaluator->atlas, texel)};
    for (uint32_t f = fragments->start[texel]; f < fragments->start[texel + 1]; f++) {
        count.triangle = fragments->items[f].triangle;
        sp_counted_pieces(evaluator, texel, &fragments->items[f], evaluator->patches.side[patch] == SP_SIDE_BACK,
                          add_cells, &count);
    }
    return count.cells;
}

bool sp_lit_create(const sp_evaluator *evaluator, sp_lit *lit, sp_error *error)
{
    size_t patches = evaluator->patches.count, room = patches ? patches : 1;
    *lit = (sp_lit){malloc(room * sizeof *lit->own), malloc(room * sizeof *lit->hit), malloc(room * sizeof *lit->jets)};
    if (!lit->own || !lit->hit || !lit->jets) {
        sp_lit_free(lit);
        return sp_fail_memory(error);
    }
#pragma omp parallel for schedule(dynamic, 1024) num_threads(sp_thread_count(evaluator->setup.run.threads))
    for (size_t i = 0; i < patches; i++)
        lit->own[i] = own_cells(evaluator, (uint32_t)i);
    sp_lit_clear(evaluator, lit);
    return true;
}

void sp_lit_free(sp_lit *lit)
{
    free(lit->own);
    free(lit->hit);
    free(lit->jets);
    *lit = (sp_lit){0};
}

void sp_lit_clear(const sp_evaluator *evaluator, sp_lit *lit)
{
    memset(lit->hit, 0, evaluator->patches.count * sizeof *lit->hit);
    memset(lit->jets, 0, evaluator->patches.count * sizeof *lit->jets);
}

static unsigned cell_of(double place)
{
    return (unsigned)fmin((place - floor(place)) * SP_LIT_EDGE, SP_LIT_EDGE - 1);
}

unsigned sp_lit_cell(const sp_evaluator *evaluator, uint32_t triangle, double u, double v)
{
    const double(*uv)[2] = (const double(*)[2])evaluator->atlas->uv[triangle];
    double w = 1 - u - v;
    unsigned x = cell_of(w * uv[0][0] + u * uv[1][0] + v * uv[2][0]);
    return cell_of(w * uv[0][1] + u * uv[1][1] + v * uv[2][1]) * SP_LIT_EDGE + x;
}

static int count_cells(uint64_t cells)
{
    return __builtin_popcountll(cells);
}

/* Cells that have one of `others` beside them. */
static uint64_t beside(uint64_t others)
{
    const uint64_t first = 0x0101010101010101, last = first << (SP_LIT_EDGE - 1);
    return (others & ~last) << 1 | (others & ~first) >> 1 | others << SP_LIT_EDGE | others >> SP_LIT_EDGE;
}

/* Every block of 2 x 2, 4 x 4, ... cells (2^level along an edge) of which one is set. */
static uint64_t joined(uint64_t cells, int level)
{
    uint64_t whole = 0;
    int edge = 1 << level;
    for (int y = 0; y < SP_LIT_EDGE; y += edge)
        for (int x = 0; x < SP_LIT_EDGE; x += edge) {
            uint64_t row = (((uint64_t)1 << edge) - 1) << x, block = 0;
            for (int k = 0; k < edge; k++)
                block |= row << (y + k) * SP_LIT_EDGE;
            whole |= cells & block ? block : 0;
        }
    return whole;
}

/* Whether jets have hit cells all over the patch, as far as so many can tell. */
static bool is_lit_all_over(const sp_lit *lit, uint32_t patch)
{
    uint64_t own = lit->own[patch];
    for (int level = 0; 1 << level < SP_LIT_EDGE; level++)
        if ((uint64_t)lit->jets[patch] << 2 * level >= (uint64_t)JETS_A_CELL * (uint64_t)count_cells(own))
            return own && !(own & ~joined(lit->hit[patch], level));
    return false;
}

/* Jets per area (1/m²) of the patches beside it that are lit all over; 0 where there are none. */
static double density_beside(const sp_evaluator *evaluator, const sp_lit *lit, uint32_t patch)
{
    const sp_patches *patches = &evaluator->patches;
    double jets = 0, area = 0;
    for (uint32_t i = patches->neighbour_start[patch]; i < patches->neighbour_start[patch + 1]; i++) {
        uint32_t other = patches->neighbours[i];
        if (!is_lit_all_over(lit, other))
            continue;
        jets += lit->jets[other];
        area += patches->area[other];
    }
    return area > 0 ? jets / area : 0;
}

/* The finest blocks of which the jets tell whether they are lit: a patch's lit cells then; 0 where none do. */
static uint64_t lit_blocks(const sp_lit *lit, uint32_t patch, int *level)
{
    for (*level = 0; 1 << *level < SP_LIT_EDGE; (*level)++) {
        uint64_t hit = joined(lit->hit[patch], *level) & lit->own[patch];
        if ((uint64_t)lit->jets[patch] << 2 * *level >= (uint64_t)JETS_A_CELL * (uint64_t)count_cells(hit) && hit)
            return hit;
    }
    return 0;
}

static double share_of_cells(const sp_lit *lit, uint32_t patch)
{
    int level;
    uint64_t own = lit->own[patch], hit = lit_blocks(lit, patch, &level);
    if (!hit)
        return 1;
    double rim = count_cells(hit & joined(beside(own & ~hit), level));
    return (count_cells(hit) - 0.5 * rim) / count_cells(own);
}

sp_edge_samples sp_lit_samples(const sp_lit *lit, uint32_t patch)
{
    int level;
    return (sp_edge_samples){lit->own[patch] & ~lit_blocks(lit, patch, &level), lit->own[patch]};
}

double sp_lit_share(const sp_evaluator *evaluator, const sp_lit *lit, uint32_t patch)
{
    if (is_lit_all_over(lit, patch))
        return 1;
    double density = density_beside(evaluator, lit, patch);
    if (density > 0)
        return fmin(1, lit->jets[patch] / (density * evaluator->patches.area[patch]));
    return share_of_cells(lit, patch);
}
