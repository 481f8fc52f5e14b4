#include "atlas/charts/sheets.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Triangles thinner than this, height over longest edge, weigh as if they were this thick: what they lack in area they
 * would have in stiffness, and iterations would spend themselves on them. */
#define LEAST_THICKNESS 0.02

#define EXACT_DEFECT 1e-6 /* rad, round-off */
#define FLAT_DEFECT 1e-4  /* rad, the most that is none */
#define SHARP_DEFECT 0.8  /* rad; the corner of a box has π/2 */

static bool measure(sp_sheets *sheets, uint32_t t, sp_error *error)
{
    const uint32_t *corner = sheets->mesh->triangles[t];
    const sp_vec3 *at = sheets->mesh->vertices;
    sp_vec3 b = sp_sub(at[corner[1]], at[corner[0]]), c = sp_sub(at[corner[2]], at[corner[0]]), a = sp_sub(c, b);
    double twice = sp_length(sp_cross(b, c)), *shape = sheets->shape[t];
    shape[0] = sp_length(b);
    shape[1] = sp_dot(b, c) / shape[0];
    shape[2] = twice / shape[0];
    if (!isfinite(shape[0]) || !isfinite(shape[1]) || !isfinite(shape[2]) || !isfinite(shape[0] * shape[2]))
        return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0, "triangle %u is too large or too thin to be laid flat", t);
    double longest = fmax(sp_dot(a, a), fmax(sp_dot(b, b), sp_dot(c, c)));
    double thick = fmax(twice, LEAST_THICKNESS * longest);
    sheets->weight[t][0] = (float)(sp_dot(a, c) / thick);
    sheets->weight[t][1] = (float)(sp_dot(b, c) / thick);
    sheets->weight[t][2] = (float)(-sp_dot(a, b) / thick);
    return true;
}

/* The angle between the edges that meet at a corner. */
static double angle_at(const sp_sheets *sheets, uint32_t t, int k)
{
    const double *s = sheets->shape[t];
    if (k == 0)
        return atan2(s[2], s[1]);
    return k == 1 ? atan2(s[2], s[0] - s[1]) : atan2(s[0] * s[2], s[1] * (s[1] - s[0]) + s[2] * s[2]);
}

static bool find_bends(sp_sheets *sheets)
{
    const sp_mesh *mesh = sheets->mesh;
    double *sum = calloc(mesh->vertex_count + 1, sizeof *sum);
    if (!sum)
        return false;
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        for (int k = 0; k < 3; k++)
            sum[mesh->triangles[t][k]] += angle_at(sheets, t, k);
    for (size_t v = 0; v < mesh->vertex_count; v++) {
        double defect = fabs(2 * acos(-1) - sum[v]);
        sheets->bend[v] = defect <= EXACT_DEFECT   ? SP_BEND_EXACT
                          : defect <= FLAT_DEFECT  ? SP_BEND_NONE
                          : defect <= SHARP_DEFECT ? SP_BEND_SMOOTH
                                                   : SP_BEND_SHARP;
    }
    free(sum);
    return true;
}

bool sp_sheets_create(sp_sheets *sheets, const sp_mesh *mesh, const uint32_t *twin, sp_error *error)
{
    size_t count = mesh->triangle_count + 1;
    *sheets = (sp_sheets){.mesh = mesh, .twin = twin, .share = SP_STRAIN_SHARE};
    sheets->shape = malloc(count * sizeof *sheets->shape);
    sheets->weight = malloc(count * sizeof *sheets->weight);
    sheets->owner = malloc(count * sizeof *sheets->owner);
    sheets->local = malloc(count * sizeof *sheets->local);
    sheets->bend = malloc(mesh->vertex_count + 1);
    bool good = sheets->shape && sheets->weight && sheets->owner && sheets->local && sheets->bend;
    if (!good)
        sp_fail_memory(error);
    for (uint32_t t = 0; good && t < mesh->triangle_count; t++) {
        sheets->owner[t] = sheets->local[t] = SP_NONE;
        good = measure(sheets, t, error);
        sheets->square += good ? 0.5 * sheets->shape[t][0] * sheets->shape[t][2] : 0;
    }
    sheets->square = sqrt(sheets->square);
    if (good && !find_bends(sheets)) {
        sp_fail_memory(error);
        good = false;
    }
    if (!good)
        sp_sheets_destroy(sheets);
    return good;
}

void sp_sheets_destroy(sp_sheets *sheets)
{
    for (size_t i = 0; i < sheets->count; i++)
        sp_sheet_free(&sheets->items[i]);
    free(sheets->items);
    free(sheets->shape);
    free(sheets->weight);
    free(sheets->bend);
    free(sheets->owner);
    free(sheets->local);
    *sheets = (sp_sheets){0};
}

double sp_edge_length(const sp_sheets *sheets, uint32_t half_edge)
{
    const double *shape = sheets->shape[half_edge / 3];
    if (half_edge % 3 == 0)
        return shape[0];
    return half_edge % 3 == 1 ? hypot(shape[1] - shape[0], shape[2]) : hypot(shape[1], shape[2]);
}

bool sp_sheet_allocate(sp_sheet *sheet, size_t triangle_count, size_t vertex_count)
{
    *sheet = (sp_sheet){.triangle_count = triangle_count, .vertex_count = vertex_count};
    sheet->triangle = malloc((triangle_count + 1) * sizeof *sheet->triangle);
    sheet->corner = malloc((triangle_count + 1) * sizeof *sheet->corner);
    sheet->at = malloc((vertex_count + 1) * sizeof *sheet->at);
    if (sheet->triangle && sheet->corner && sheet->at)
        return true;
    sp_sheet_free(sheet);
    return false;
}

void sp_sheet_free(sp_sheet *sheet)
{
    free(sheet->triangle);
    free(sheet->corner);
    free(sheet->at);
    *sheet = (sp_sheet){0};
}

void sp_sheet_identify(sp_sheet *sheet, uint32_t *link, uint32_t *number)
{
    for (uint32_t v = 0; v < sheet->vertex_count; v++)
        number[v] = 1; /* at first how many become one */
    for (uint32_t v = 0; v < sheet->vertex_count; v++) {
        uint32_t root = sp_linked(link, v);
        if (root == v)
            continue;
        number[root]++;
        for (int k = 0; k < 2; k++)
            sheet->at[root][k] += sheet->at[v][k];
    }
    uint32_t kept = 0;
    for (uint32_t v = 0; v < sheet->vertex_count; v++) {
        if (link[v] != v) {
            number[v] = number[link[v]];
            continue;
        }
        for (int k = 0; k < 2; k++)
            sheet->at[kept][k] = sheet->at[v][k] / number[v];
        number[v] = kept++;
    }
    sheet->vertex_count = kept;
    for (size_t i = 0; i < sheet->triangle_count; i++)
        for (int k = 0; k < 3; k++)
            sheet->corner[i][k] = number[sheet->corner[i][k]];
}

bool sp_sheets_add(sp_sheets *sheets, const sp_sheet *sheet)
{
    if (sheets->count == sheets->capacity) {
        size_t capacity = sheets->capacity ? 2 * sheets->capacity : 64;
        sp_sheet *items = realloc(sheets->items, capacity * sizeof *items);
        if (!items)
            return false;
        sheets->items = items;
        sheets->capacity = capacity;
    }
    for (size_t i = 0; i < sheet->triangle_count; i++) {
        sheets->owner[sheet->triangle[i]] = (uint32_t)sheets->count;
        sheets->local[sheet->triangle[i]] = (uint32_t)i;
    }
    sheets->items[sheets->count++] = *sheet;
    return true;
}
