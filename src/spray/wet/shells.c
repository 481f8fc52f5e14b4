/* A part whose triangles close is a solid by itself, also where it is welded to others along edges: bodies that touch
 * in one file share their corners. What is left over may be closed by several parts together, as a vessel is by its
 * shell and its heads; sheets welded to it, which have free edges, are peeled off before that is asked. */
#include "spray/wet/shells.h"

#include "spray/wet/same_corners.h"

#include "mesh/disjoint_sets.h"
#include "mesh/half_edge.h"

#include <stdlib.h>

/* What is known while shells are being found. */
typedef struct {
    const sp_mesh *mesh;
    sp_half_edges edges;
    uint32_t *edge;   /* [3 triangles], where in edges.order the half edge's edge begins */
    uint32_t *parent; /* [triangles], disjoint sets */
    bool *open;       /* [triangles], of a set's root: some edge does not close */
    bool *loose;      /* [triangles], peeled off */
    bool apart;       /* triangles of different parts do not hang together */
} shell_search;

/* Whether two triangles at one edge hang together there. */
static bool hang_together(const shell_search *search, uint32_t a, uint32_t b)
{
    return search->loose[a] == search->loose[b] && (!search->apart || search->mesh->part[a] == search->mesh->part[b]);
}

/* How often the edge of half edge `h` runs its way more than the other, among what hangs together with it. */
static int surplus(const shell_search *search, uint32_t h, size_t *uses)
{
    size_t first = search->edge[h], count = sp_half_edges_of_edge(search->mesh, &search->edges, first);
    int sum = 0;
    *uses = 0;
    for (size_t i = first; i < first + count; i++) {
        uint32_t other = search->edges.order[i];
        if (!hang_together(search, h / 3, other / 3))
            continue;
        ++*uses;
        sum += sp_half_edge_from(search->mesh, other) == sp_half_edge_from(search->mesh, h) ? 1 : -1;
    }
    return sum;
}

/* Triangles for which `among` holds are put into sets anew. */
static void gather_shells(shell_search *search, const bool *among)
{
    size_t triangles = search->mesh->triangle_count;
    for (uint32_t t = 0; t < triangles; t++) {
        if (!among || among[t])
            search->parent[t] = t;
    }
    for (size_t first = 0, count; first < 3 * triangles; first += count) {
        count = sp_half_edges_of_edge(search->mesh, &search->edges, first);
        for (size_t i = first; i < first + count; i++) {
            uint32_t a = search->edges.order[i] / 3;
            for (size_t k = first; k < i && (!among || among[a]); k++) {
                uint32_t b = search->edges.order[k] / 3;
                if ((!among || among[b]) && hang_together(search, a, b))
                    sp_set_join(search->parent, a, b);
            }
        }
    }
    for (uint32_t t = 0; t < triangles; t++)
        search->open[t] = false;
    for (uint32_t h = 0; h < 3 * triangles; h++) {
        size_t uses;
        if ((!among || among[h / 3]) && surplus(search, h, &uses) != 0)
            search->open[sp_set_root(search->parent, h / 3)] = true;
    }
}

/* Peels triangles with a free edge off what is left, until none has one. */
static bool peel(shell_search *search, const bool *left, sp_error *error)
{
    size_t triangles = search->mesh->triangle_count, waiting = 0;
    uint32_t *stack = malloc((3 * triangles + 1) * sizeof *stack);
    bool *queued = calloc(triangles + 1, 1);
    if (!stack || !queued) {
        free(stack);
        free(queued);
        return sp_fail_memory(error);
    }
    for (uint32_t t = (uint32_t)triangles; t-- > 0;) {
        search->loose[t] = !left[t]; /* nothing of closed parts takes part */
        if (left[t]) {
            stack[waiting++] = t;
            queued[t] = true;
        }
    }
    while (waiting > 0) {
        uint32_t t = stack[--waiting];
        queued[t] = false;
        bool is_free = false;
        for (uint32_t k = 0; k < 3; k++) {
            size_t uses;
            surplus(search, 3 * t + k, &uses);
            is_free = is_free || uses == 1;
        }
        if (search->loose[t] || !is_free)
            continue;
        search->loose[t] = true;
        for (uint32_t h = 3 * t; h < 3 * t + 3; h++) {
            size_t first = search->edge[h], count = sp_half_edges_of_edge(search->mesh, &search->edges, first);
            for (size_t i = first; i < first + count; i++) {
                uint32_t other = search->edges.order[i] / 3;
                if (!search->loose[other] && !queued[other]) {
                    stack[waiting++] = other;
                    queued[other] = true;
                }
            }
        }
    }
    free(stack);
    free(queued);
    return true;
}

static bool find_shells(shell_search *search, bool *closed, sp_error *error)
{
    size_t triangles = search->mesh->triangle_count;
    bool *left = malloc(triangles + 1);
    if (!left)
        return sp_fail_memory(error);
    search->apart = true;
    gather_shells(search, NULL);
    size_t remaining = 0;
    for (uint32_t t = 0; t < triangles; t++) {
        left[t] = search->open[sp_set_root(search->parent, t)];
        closed[t] = !left[t];
        remaining += left[t];
    }
    bool done = true;
    if (remaining > 0) {
        search->apart = false;
        done = peel(search, left, error);
        if (done)
            gather_shells(search, left);
        for (uint32_t t = 0; done && t < triangles; t++)
            closed[t] = closed[t] || (!search->loose[t] && !search->open[sp_set_root(search->parent, t)]);
    }
    free(left);
    return done;
}

static void grow_box(sp_shells *shells, uint32_t shell, sp_vec3 p)
{
    sp_vec3 *low = &shells->low[shell], *high = &shells->high[shell];
    *low = sp_v(fmin(low->x, p.x), fmin(low->y, p.y), fmin(low->z, p.z));
    *high = sp_v(fmax(high->x, p.x), fmax(high->y, p.y), fmax(high->z, p.z));
}

/* Volumes are reckoned about a corner of each shell, so that what is far from the origin loses nothing. */
static void measure_shells(sp_shells *shells, const shell_search *search)
{
    const sp_mesh *mesh = search->mesh;
    for (size_t s = 0; s < shells->count; s++) {
        shells->low[s] = sp_v(INFINITY, INFINITY, INFINITY);
        shells->high[s] = sp_scale(shells->low[s], -1);
        shells->simple[s] = shells->closed[s];
        shells->turn[s] = shells->closed[s];
        shells->widest[s] = SP_NONE;
    }
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        uint32_t shell = shells->of[t], widest = shells->widest[shell];
        for (int k = 0; k < 3; k++) {
            grow_box(shells, shell, mesh->vertices[mesh->triangles[t][k]]);
            if (search->edges.kind[3 * t + (uint32_t)k] != SP_EDGE_PAIRED)
                shells->simple[shell] = false;
        }
        if (widest == SP_NONE || sp_triangle_area(mesh, t) > sp_triangle_area(mesh, widest))
            shells->widest[shell] = t;
    }
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        uint32_t shell = shells->of[t];
        sp_vec3 p[3];
        for (int k = 0; k < 3; k++)
            p[k] = sp_sub(mesh->vertices[mesh->triangles[t][k]], shells->low[shell]);
        if (shells->closed[shell])
            shells->volume[shell] += sp_dot(p[0], sp_cross(p[1], p[2])) / 6;
    }
}

static bool allocate_shells(sp_shells *shells, size_t count)
{
    shells->count = count;
    shells->closed = calloc(count + 1, sizeof *shells->closed);
    shells->turn = calloc(count + 1, sizeof *shells->turn);
    shells->simple = calloc(count + 1, sizeof *shells->simple);
    shells->volume = calloc(count + 1, sizeof *shells->volume);
    shells->widest = calloc(count + 1, sizeof *shells->widest);
    shells->low = calloc(count + 1, sizeof *shells->low);
    shells->high = calloc(count + 1, sizeof *shells->high);
    return shells->closed && shells->turn && shells->simple && shells->volume && shells->widest && shells->low &&
           shells->high;
}

/* Numbers the sets in the order of their first triangles, which are their roots. */
static bool number_shells(sp_shells *shells, shell_search *search, const bool *closed)
{
    size_t triangles = search->mesh->triangle_count, count = 0;
    for (uint32_t t = 0; t < triangles; t++)
        shells->of[t] = search->parent[t] == t ? (uint32_t)count++ : 0;
    if (!allocate_shells(shells, count))
        return false;
    for (uint32_t t = 0; t < triangles; t++) {
        shells->of[t] = shells->of[sp_set_root(search->parent, t)];
        shells->closed[shells->of[t]] = closed[t];
    }
    measure_shells(shells, search);
    return true;
}

bool sp_shells_create(sp_shells *shells, const sp_mesh *mesh, double same, sp_error *error)
{
    *shells = (sp_shells){0};
    size_t triangles = mesh->triangle_count;
    sp_mesh welded = *mesh; /* but for its triangles borrowed */
    welded.triangles = sp_same_corners(mesh, same, error);
    if (!welded.triangles)
        return false;
    shell_search search = {.mesh = &welded,
                           .edge = malloc((3 * triangles + 1) * sizeof *search.edge),
                           .parent = malloc((triangles + 1) * sizeof *search.parent),
                           .open = calloc(triangles + 1, 1),
                           .loose = calloc(triangles + 1, 1)};
    bool *closed = calloc(triangles + 1, 1);
    shells->of = calloc(triangles + 1, sizeof *shells->of);
    bool done = search.edge && search.parent && search.open && search.loose && closed && shells->of;
    if (!done)
        sp_fail_memory(error);
    done = done && sp_half_edges_create(&welded, &search.edges, error);
    for (size_t first = 0, count; done && first < 3 * triangles; first += count) {
        count = sp_half_edges_of_edge(&welded, &search.edges, first);
        for (size_t i = first; i < first + count; i++)
            search.edge[search.edges.order[i]] = (uint32_t)first;
    }
    done = done && find_shells(&search, closed, error) &&
           (number_shells(shells, &search, closed) || sp_fail_memory(error));
    sp_half_edges_destroy(&search.edges);
    free(search.edge);
    free(search.parent);
    free(search.open);
    free(search.loose);
    free(closed);
    free(welded.triangles);
    if (!done)
        sp_shells_destroy(shells);
    return done;
}

void sp_shells_destroy(sp_shells *shells)
{
    free(shells->of);
    free(shells->closed);
    free(shells->turn);
    free(shells->simple);
    free(shells->volume);
    free(shells->widest);
    free(shells->low);
    free(shells->high);
    *shells = (sp_shells){0};
}
