/* A chart whose outline is simple has no overlaps; only in others is every triangle held against those around it. */
#include "atlas/overlap.h"

#include "atlas/charts/outline.h"
#include "atlas/charts/sheets.h"
#include "atlas/plane.h"
#include "mesh/adjacent.h"

#include <stdlib.h>
#include <string.h>

typedef struct {
    const sp_atlas *atlas;
    sp_half_edges edges;
    uint32_t *list;       /* [triangle_count], the triangles by chart */
    size_t *start;        /* [chart_count + 2], where each chart's begin */
    uint32_t *link;       /* [3 triangle_count], corners that are one point of a chart are linked */
    uint32_t *number;     /* [3 triangle_count], of the points of the chart in hand, else SP_NONE */
    sp_segment *segments; /* [3 times the triangles of the largest chart], of the chart in hand */
    sp_plane *plane;
} search;

static const double *corner(const search *s, uint32_t at)
{
    return s->atlas->uv[at / 3][at % 3];
}

/* Whether an edge's two sides are one edge of the chart, to the last bit. */
static bool is_whole(const search *s, uint32_t half_edge)
{
    uint32_t other = s->edges.opposite[half_edge];
    return other != SP_NONE && s->atlas->chart[half_edge / 3] == s->atlas->chart[other / 3] &&
           memcmp(corner(s, half_edge), corner(s, sp_around(other)), 2 * sizeof(double)) == 0 &&
           memcmp(corner(s, sp_around(half_edge)), corner(s, other), 2 * sizeof(double)) == 0;
}

/* Returns the largest chart's number of triangles. */
static size_t list_by_chart(const search *s)
{
    const sp_atlas *atlas = s->atlas;
    size_t most = 0;
    memset(s->start, 0, (atlas->chart_count + 2) * sizeof *s->start);
    for (size_t t = 0; t < atlas->triangle_count; t++)
        s->start[atlas->chart[t] + 2]++;
    for (size_t c = 2; c < atlas->chart_count + 2; c++) {
        most = s->start[c] > most ? s->start[c] : most;
        s->start[c] += s->start[c - 1];
    }
    for (uint32_t t = 0; t < atlas->triangle_count; t++)
        s->list[s->start[atlas->chart[t] + 1]++] = t;
    return most;
}

static void link_corners(const search *s)
{
    size_t corners = 3 * s->atlas->triangle_count;
    for (uint32_t h = 0; h < corners; h++) {
        s->link[h] = h;
        s->number[h] = SP_NONE;
    }
    for (uint32_t h = 0; h < corners; h++)
        if (is_whole(s, h)) {
            sp_link(s->link, h, sp_around(s->edges.opposite[h]));
            sp_link(s->link, sp_around(h), s->edges.opposite[h]);
        }
}

static uint32_t number_of(const search *s, uint32_t at, uint32_t *count)
{
    uint32_t *number = &s->number[sp_linked(s->link, at)];
    if (*number == SP_NONE)
        *number = (*count)++;
    return *number;
}

static bool is_anticlockwise(const double uv[3][2])
{
    return (uv[1][0] - uv[0][0]) * (uv[2][1] - uv[0][1]) > (uv[1][1] - uv[0][1]) * (uv[2][0] - uv[0][0]);
}

static sp_boundary_test outline_of(const search *s, const uint32_t *list, size_t count)
{
    size_t segments = 0;
    uint32_t points = 0;
    for (size_t i = 0; i < count; i++)
        if (!is_anticlockwise((const double(*)[2])s->atlas->uv[list[i]]))
            return (sp_boundary_test){.memory = true};
    for (size_t i = 0; i < count; i++)
        for (uint32_t h = 3 * list[i]; h < 3 * list[i] + 3; h++)
            if (!is_whole(s, h))
                s->segments[segments++] = (sp_segment){number_of(s, h, &points), number_of(s, sp_around(h), &points),
                                                       corner(s, h), corner(s, sp_around(h))};
    sp_boundary_test outline = sp_test_boundary(s->segments, segments, points);
    for (size_t i = 0; i < count; i++)
        for (uint32_t h = 3 * list[i]; h < 3 * list[i] + 3; h++)
            s->number[sp_linked(s->link, h)] = SP_NONE;
    return outline;
}

static bool try_pairs(const search *s, const uint32_t *list, size_t count, sp_overlaps *found, sp_error *error)
{
    bool done = true;
    sp_plane_clear(s->plane);
    for (size_t i = 0; done && i < count; i++) {
        size_t more = sp_plane_overlaps(s->plane, (const double(*)[2])s->atlas->uv[list[i]], SIZE_MAX, &found->tests);
        found->triangle = more && !found->count ? list[i] : found->triangle;
        found->count += more;
        done = sp_plane_add(s->plane, list[i], error);
    }
    return done;
}

static bool look_through(const search *s, size_t most, sp_overlaps *found, sp_error *error)
{
    for (size_t c = 0; c < s->atlas->chart_count && found->count < most; c++) {
        const uint32_t *list = s->list + s->start[c];
        size_t count = s->start[c + 1] - s->start[c];
        if (count < 2)
            continue;
        sp_boundary_test outline = outline_of(s, list, count);
        found->tests += outline.tests;
        if (!outline.memory)
            return sp_fail_memory(error);
        if (!outline.simple && !try_pairs(s, list, count, found, error))
            return false;
    }
    return true;
}

bool sp_find_overlaps(const sp_atlas *atlas, const sp_mesh *mesh, size_t most, sp_overlaps *found, sp_error *error)
{
    search s = {.atlas = atlas};
    *found = (sp_overlaps){.triangle = SP_NONE};
    if (!sp_adjacent_create(mesh, &s.edges, error))
        return false;
    size_t triangles = atlas->triangle_count;
    s.list = malloc((triangles + 1) * sizeof *s.list);
    s.start = malloc((atlas->chart_count + 2) * sizeof *s.start);
    s.link = malloc((3 * triangles + 1) * sizeof *s.link);
    s.number = malloc((3 * triangles + 1) * sizeof *s.number);
    s.plane = sp_plane_create((const double(*)[3][2])atlas->uv, triangles, error);
    bool done = s.list && s.start && s.link && s.number && s.plane;
    s.segments = done ? malloc((3 * list_by_chart(&s) + 1) * sizeof *s.segments) : NULL;
    if (!s.segments) {
        sp_fail_memory(error);
    } else {
        link_corners(&s);
        done = look_through(&s, most, found, error);
    }
    done = done && s.segments;
    sp_half_edges_destroy(&s.edges);
    sp_plane_destroy(s.plane);
    free(s.list);
    free(s.start);
    free(s.link);
    free(s.number);
    free(s.segments);
    return done;
}
