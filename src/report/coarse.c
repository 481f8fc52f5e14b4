#include "coarse.h"

#include "mesh/grow.h"

#include <stdlib.h>
#include <string.h>

/* Grids whose cells grow by a twelfth: each keeps about a fifth more triangles than the one before. */
#define GRIDS 112
#define GRIDS_TO_HALVE 8 /* the finest has 2^(112 / 8) cells along the longest edge of the box */
#define CELL_BITS 20     /* of a coordinate in a cell's number */

/* A drawn vertex, and the cell that it is in. */
typedef struct {
    uint64_t cell;
    uint32_t part, vertex;
} placed;

/* A vertex of the coarse surface: one for each chart that has corners in the cell. */
typedef struct {
    uint32_t chart; /* SP_NONE for all that needs no cleaning */
    uint32_t next;  /* of the same cluster, SP_NONE: the last */
    double off;     /* m²: how far its texel is from its place, squared */
} made;

typedef struct {
    sp_drawn_surface *surface; /* as it was */
    const sp_evaluator *evaluator;
    sp_vec3 low;
    double longest;
    placed *placed;    /* [vertices], by part, cell and vertex */
    uint32_t *cluster; /* [vertices] */
    size_t clusters;
    uint32_t *middle;      /* [clusters], the vertex that stands for each */
    uint32_t *first;       /* [clusters], of what is made there */
    sp_drawn_surface made; /* what it becomes */
    made *more;            /* [made vertices] */
    size_t room, more_room, range_room;
} coarsener;

static sp_vec3 place_of(const coarsener *c, uint32_t vertex)
{
    return sp_evaluator_setup(c->evaluator)->mesh->vertices[c->surface->vertices[vertex].at];
}

static int by_cell(const void *left, const void *right)
{
    const placed *a = left, *b = right;
    if (a->part != b->part)
        return a->part < b->part ? -1 : 1;
    if (a->cell != b->cell)
        return a->cell < b->cell ? -1 : 1;
    return (a->vertex > b->vertex) - (a->vertex < b->vertex);
}

static double cell_edge(const coarsener *c, int grid)
{
    return c->longest / exp2((double)grid / GRIDS_TO_HALVE);
}

static void group(coarsener *c, int grid)
{
    double edge = cell_edge(c, grid), last = ceil(c->longest / edge) - 1;
    const sp_drawn_surface *s = c->surface;
    size_t range = 0;
    for (uint32_t i = 0; i < s->vertex_count; i++) {
        while (i >= s->ranges[range].vertex_end)
            range++;
        sp_vec3 from = sp_sub(place_of(c, i), c->low);
        uint64_t cell = 0;
        for (int k = 0; k < 3; k++)
            cell = cell << CELL_BITS | (uint64_t)fmin(floor((&from.x)[k] / edge), last);
        c->placed[i] = (placed){cell, s->ranges[range].part, i};
    }
    qsort(c->placed, s->vertex_count, sizeof *c->placed, by_cell);
    c->clusters = 0;
    for (size_t i = 0; i < s->vertex_count; i++) {
        const placed *own = &c->placed[i];
        c->clusters += i == 0 || own->cell != own[-1].cell || own->part != own[-1].part;
        c->cluster[own->vertex] = (uint32_t)(c->clusters - 1);
    }
}

static bool stays(const coarsener *c, size_t triangle)
{
    const uint32_t *v = c->surface->corners[triangle];
    uint32_t p = c->cluster[v[0]], q = c->cluster[v[1]], r = c->cluster[v[2]];
    return p != q && q != r && r != p;
}

static size_t count_left(const coarsener *c)
{
    size_t left = 0;
    for (size_t i = 0; i < c->surface->triangle_count; i++)
        left += stays(c, i);
    return left;
}

/* Groups by the finest grid that leaves few enough; by one of a single cell, which leaves none, where all others leave
 * too many. */
static int find_grid(coarsener *c, size_t most)
{
    int fits = 0, fails = GRIDS + 1;
    while (fails - fits > 1) {
        int tried = (fits + fails) / 2;
        group(c, tried);
        *(count_left(c) > most ? &fails : &fits) = tried;
    }
    group(c, fits);
    return fits;
}

/* Of each cluster the vertex nearest to the middle of all. */
static void find_middles(coarsener *c)
{
    size_t count = c->surface->vertex_count, end;
    for (size_t from = 0; from < count; from = end) {
        sp_vec3 sum = {0};
        uint32_t cluster = c->cluster[c->placed[from].vertex];
        for (end = from; end < count && c->cluster[c->placed[end].vertex] == cluster; end++)
            sum = sp_add(sum, place_of(c, c->placed[end].vertex));
        sp_vec3 middle = sp_scale(sum, 1.0 / (double)(end - from));
        double least = INFINITY;
        for (size_t i = from; i < end; i++) {
            double off = sp_distance(place_of(c, c->placed[i].vertex), middle);
            if (off < least) {
                least = off;
                c->middle[cluster] = c->placed[i].vertex;
            }
        }
    }
}

static uint32_t chart_of(const coarsener *c, const sp_drawn_range *range, size_t triangle)
{
    return range->page == SP_NONE ? SP_NONE : sp_evaluator_atlas(c->evaluator)->chart[c->surface->triangles[triangle]];
}

/* What a chart has in a cluster, SP_NONE where that is nothing yet. */
static uint32_t find_made(const coarsener *c, uint32_t cluster, uint32_t chart)
{
    uint32_t i = c->first[cluster];
    while (i != SP_NONE && c->more[i].chart != chart)
        i = c->more[i].next;
    return i;
}

/* The texel of a corner goes with what its chart has there if it is nearer than any before. */
static void offer_texel(coarsener *c, uint32_t number, uint32_t vertex)
{
    sp_vec3 apart = sp_sub(place_of(c, vertex), place_of(c, c->middle[c->cluster[vertex]]));
    double off = sp_dot(apart, apart);
    if (off >= c->more[number].off)
        return;
    c->more[number].off = off;
    memcpy(c->made.vertices[number].uv, c->surface->vertices[vertex].uv, sizeof c->made.vertices[number].uv);
}

/* The number of what stands for a corner, made where there is none; SP_NONE when memory runs out. */
static uint32_t make(coarsener *c, uint32_t vertex, uint32_t chart)
{
    uint32_t cluster = c->cluster[vertex], found = find_made(c, cluster, chart);
    if (found != SP_NONE)
        return found;
    size_t number = c->made.vertex_count;
    if (!sp_grow(&c->made.vertices, &c->room, number + 1, sizeof *c->made.vertices) ||
        !sp_grow(&c->more, &c->more_room, number + 1, sizeof *c->more))
        return SP_NONE;
    c->made.vertices[number] = (sp_drawn_vertex){c->surface->vertices[c->middle[cluster]].at, {0, 0}};
    c->more[number] = (made){chart, c->first[cluster], INFINITY};
    c->first[cluster] = (uint32_t)number;
    c->made.vertex_count++;
    return (uint32_t)number;
}

static bool make_triangle(coarsener *c, const sp_drawn_range *range, size_t triangle)
{
    sp_drawn_surface *s = &c->made;
    for (int k = 0; k < 3; k++) {
        uint32_t number = make(c, c->surface->corners[triangle][k], chart_of(c, range, triangle));
        if (number == SP_NONE)
            return false;
        s->corners[s->triangle_count][k] = number;
    }
    s->triangles[s->triangle_count++] = c->surface->triangles[triangle];
    return true;
}

/* What of a range stays; a range of which nothing does is none. `part_first`: the vertex that its part begins with. */
static bool make_range(coarsener *c, const sp_drawn_range *range, size_t part_first)
{
    sp_drawn_surface *s = &c->made;
    sp_drawn_range own = *range;
    own.first = s->triangle_count;
    own.vertex_first = part_first;
    for (size_t i = range->first; i < range->first + range->count; i++)
        if (stays(c, i) && !make_triangle(c, range, i))
            return false;
    own.count = s->triangle_count - own.first;
    own.vertex_end = s->vertex_count;
    if (own.count > 0)
        s->ranges[s->range_count++] = own;
    return true;
}

static bool make_all(coarsener *c)
{
    const sp_drawn_surface *s = c->surface;
    size_t part_first = 0;
    for (size_t r = 0; r < s->range_count; r++) {
        if (r == 0 || s->ranges[r].part != s->ranges[r - 1].part)
            part_first = c->made.vertex_count;
        if (!make_range(c, &s->ranges[r], part_first))
            return false;
    }
    return true;
}

/* Triangles that go tell where texels are as well. */
static void settle_texels(coarsener *c)
{
    const sp_drawn_surface *s = c->surface;
    for (size_t r = 0; r < s->range_count; r++)
        for (size_t i = s->ranges[r].first; i < s->ranges[r].first + s->ranges[r].count; i++)
            for (int k = 0; k < 3; k++) {
                uint32_t vertex = s->corners[i][k];
                uint32_t number = find_made(c, c->cluster[vertex], chart_of(c, &s->ranges[r], i));
                if (number != SP_NONE)
                    offer_texel(c, number, vertex);
            }
}

static bool open_grids(coarsener *c)
{
    size_t vertices = c->surface->vertex_count;
    sp_vec3 low, high;
    sp_mesh_box(sp_evaluator_setup(c->evaluator)->mesh, &low, &high);
    c->low = low;
    c->longest = fmax(fmax(high.x - low.x, high.y - low.y), high.z - low.z);
    c->placed = malloc((vertices + 1) * sizeof *c->placed);
    c->cluster = malloc((vertices + 1) * sizeof *c->cluster);
    return c->placed && c->cluster;
}

/* Of the grid that was found. */
static bool make_coarse(coarsener *c)
{
    size_t left = count_left(c);
    c->middle = malloc((c->clusters + 1) * sizeof *c->middle);
    c->first = malloc((c->clusters + 1) * sizeof *c->first);
    c->made.corners = malloc((left + 1) * sizeof *c->made.corners);
    c->made.triangles = malloc((left + 1) * sizeof *c->made.triangles);
    c->made.ranges = malloc((c->surface->range_count + 1) * sizeof *c->made.ranges);
    if (!c->middle || !c->first || !c->made.corners || !c->made.triangles || !c->made.ranges)
        return false;
    memset(c->first, 0xff, c->clusters * sizeof *c->first);
    find_middles(c);
    if (!make_all(c))
        return false;
    settle_texels(c);
    return true;
}

bool sp_drawn_surface_coarsen(sp_drawn_surface *surface, const sp_evaluator *evaluator, size_t most, double *cell,
                              sp_error *error)
{
    *cell = 0;
    if (surface->triangle_count <= most)
        return true;
    coarsener c = {.surface = surface, .evaluator = evaluator};
    bool done = open_grids(&c);
    if (done) {
        *cell = sqrt(3) * cell_edge(&c, find_grid(&c, most));
        done = make_coarse(&c);
    }
    free(c.placed);
    free(c.cluster);
    free(c.middle);
    free(c.first);
    free(c.more);
    if (done) {
        sp_drawn_surface_free(surface);
        *surface = c.made;
    } else {
        sp_drawn_surface_free(&c.made);
    }
    return done || sp_fail_memory(error);
}
