/* triangle_order.js does the same the other way round: whatever is changed here is changed there. */
#include "triangle_order.h"

#include "mesh/key_sort.h"

#include <stdlib.h>
#include <string.h>

#define STEPS 32  /* corners at a vertex that are looked at, the latest first */
#define GUESSES 6 /* vertices that a triangle may be closed with */
#define FULL 7    /* triangles around a vertex */

typedef struct {
    sp_bit_model reached[3][FULL + 1][FULL + 1], known[3][FULL + 1][FULL + 1], guess[GUESSES], turn[2][9][4];
    sp_number_model vertex, chart;
} models;

typedef struct {
    const sp_mesh *mesh;
    const sp_atlas *atlas;
    sp_triangle_order *walk;
    sp_coder *coder;
    models *models;
    uint64_t *edges;     /* [3 triangles], from and to of what leads from each corner to the next, ascending */
    uint32_t *corner_of; /* [3 triangles], their corners */
    uint32_t *by_chart;  /* [triangles] */
    bool *encoded;       /* [triangles of the mesh] */
    uint32_t *number;    /* [vertices of the mesh], as they are encoded; SP_NONE: not yet */
    uint32_t *first;     /* [vertices], the latest encoded corner at each, SP_NONE: none */
    uint32_t *next;      /* [3 triangles], the one before at the same vertex */
    bool *met;           /* [3 triangles], whether a triangle is encoded on the other side of this edge */
    uint8_t *around;     /* [vertices], encoded triangles, FULL at most */
    uint32_t *queue;     /* [3 triangles], edges of encoded corners that may lead on */
    size_t queued, taken, encoded_count;
    uint32_t fresh; /* vertices encoded */
} walker;

static uint32_t after(uint32_t corner)
{
    return corner % 3 == 2 ? corner - 2 : corner + 1;
}

static uint32_t at(const walker *w, uint32_t corner)
{
    return w->walk->corners[corner / 3][corner % 3];
}

/* Marks an edge and one that leads the other way as met, where there is one. */
static void meet(walker *w, uint32_t corner)
{
    uint32_t from = at(w, corner), to = at(w, after(corner)), other = w->first[to];
    for (int steps = 0; other != SP_NONE && steps < STEPS; steps++, other = w->next[other])
        if (!w->met[other] && at(w, after(other)) == from) {
            w->met[other] = w->met[corner] = true;
            return;
        }
}

/* Puts in the triangle encoded last, whose corners stand. */
static void put_in(walker *w)
{
    uint32_t start = 3 * (uint32_t)w->encoded_count++;
    for (uint32_t corner = start; corner < start + 3; corner++)
        if (!w->met[corner])
            meet(w, corner);
    for (uint32_t corner = start; corner < start + 3; corner++) {
        uint32_t vertex = at(w, corner);
        w->next[corner] = w->first[vertex];
        w->first[vertex] = corner;
        w->around[vertex] += w->around[vertex] < FULL;
    }
    for (uint32_t corner = start; corner < start + 3; corner++)
        if (!w->met[corner])
            w->queue[w->queued++] = corner;
}

static void guess(uint32_t vertex, uint32_t guesses[GUESSES], int *count)
{
    for (int i = 0; i < *count; i++)
        if (guesses[i] == vertex)
            return;
    if (*count < GUESSES)
        guesses[(*count)++] = vertex;
}

/* Vertices that the rim of what is encoded goes on with from the ends of an edge of it. */
static int find_guesses(const walker *w, uint32_t gate, uint32_t guesses[GUESSES])
{
    uint32_t from = at(w, gate), to = at(w, after(gate));
    int count = 0;
    uint32_t corner = w->first[to];
    for (int steps = 0; corner != SP_NONE && steps < STEPS; steps++, corner = w->next[corner])
        if (!w->met[corner] && at(w, after(corner)) != from)
            guess(at(w, after(corner)), guesses, &count);
    corner = w->first[from];
    for (int steps = 0; corner != SP_NONE && steps < STEPS; steps++, corner = w->next[corner]) {
        uint32_t before = after(after(corner));
        if (!w->met[before] && at(w, before) != to && before / 3 != gate / 3)
            guess(at(w, before), guesses, &count);
    }
    return count;
}

static uint32_t number_of(walker *w, uint32_t vertex)
{
    if (w->number[vertex] == SP_NONE) {
        w->walk->vertex[w->fresh] = vertex;
        w->number[vertex] = w->fresh++;
    }
    return w->number[vertex];
}

/* By itself. */
static uint32_t encode_vertex(walker *w, uint32_t vertex)
{
    uint32_t fresh = w->fresh, number = number_of(w, vertex);
    sp_code_number(w->coder, &w->models->vertex, (int64_t)fresh - number);
    return number;
}

static uint32_t encode_far(walker *w, uint32_t gate, int classes, const uint32_t guesses[], int count, uint32_t vertex)
{
    const uint8_t *around = w->around;
    bool known = w->number[vertex] != SP_NONE;
    sp_code_bit(w->coder, &w->models->known[classes][around[at(w, gate)]][around[at(w, after(gate))]], known);
    if (!known)
        return number_of(w, vertex);
    for (int i = 0; i < count; i++) {
        bool hit = guesses[i] == w->number[vertex];
        sp_code_bit(w->coder, &w->models->guess[i], hit);
        if (hit)
            return guesses[i];
    }
    return encode_vertex(w, vertex);
}

/* Whether a corner of the mesh lies where another one does. */
static bool same_spot(const walker *w, uint32_t one, uint32_t two)
{
    const double *a = w->atlas->uv[one / 3][one % 3], *b = w->atlas->uv[two / 3][two % 3];
    return a[0] == b[0] && a[1] == b[1];
}

/* The corner of a triangle that is not encoded yet, of the chart, from which an edge leads back along the gate;
 * SP_NONE.
 */
static uint32_t beyond(const walker *w, uint32_t gate)
{
    const sp_triangle_order *walk = w->walk;
    uint32_t triangle = walk->triangle[gate / 3], own = 3 * triangle + gate % 3, end = after(own);
    uint64_t from = w->mesh->triangles[triangle][end % 3], to = w->mesh->triangles[triangle][own % 3];
    uint64_t sought = from << 32 | to;
    size_t low = 0, high = 3 * walk->count;
    while (low < high) {
        size_t middle = (low + high) / 2;
        if (w->edges[w->corner_of[middle]] < sought)
            low = middle + 1;
        else
            high = middle;
    }
    for (; low < 3 * walk->count && w->edges[w->corner_of[low]] == sought; low++) {
        uint32_t corner = w->corner_of[low];
        if (!w->encoded[corner / 3] && w->atlas->chart[corner / 3] == walk->chart[gate / 3] &&
            same_spot(w, corner, end) && same_spot(w, after(corner), own))
            return corner;
    }
    return SP_NONE;
}

static void begin(walker *w, uint32_t triangle, uint32_t gate, uint32_t far)
{
    sp_triangle_order *walk = w->walk;
    walk->triangle[w->encoded_count] = triangle;
    walk->chart[w->encoded_count] = w->atlas->chart[triangle];
    walk->gate[w->encoded_count] = gate;
    walk->far[w->encoded_count] = (uint8_t)far;
    w->encoded[triangle] = true;
}

static void pass(walker *w, uint32_t gate)
{
    uint32_t guesses[GUESSES], corner = beyond(w, gate), from = at(w, gate), to = at(w, after(gate));
    int count = find_guesses(w, gate, guesses), classes = count < 2 ? count : 2;
    sp_code_bit(w->coder, &w->models->reached[classes][w->around[from]][w->around[to]], corner != SP_NONE);
    if (corner == SP_NONE)
        return;
    uint32_t own = corner % 3, far = (own + 2) % 3, *corners = w->walk->corners[w->encoded_count];
    corners[own] = to;
    corners[(own + 1) % 3] = from;
    corners[far] = encode_far(w, gate, classes, guesses, count, w->mesh->triangles[corner / 3][far]);
    sp_bit_model *turn = w->models->turn[corners[far] + 1 == w->fresh][3 * w->walk->far[gate / 3] + gate % 3];
    sp_code_bit(w->coder, &turn[1], own == 2);
    if (own < 2)
        sp_code_bit(w->coder, &turn[2], own == 1);
    begin(w, corner / 3, gate, far);
    w->met[gate] = w->met[3 * w->encoded_count + own] = true;
    put_in(w);
}

static void start(walker *w, uint32_t triangle)
{
    uint32_t *corners = w->walk->corners[w->encoded_count];
    uint32_t chart = w->atlas->chart[triangle];
    sp_code_number(w->coder, &w->models->chart,
                   (int64_t)chart - (w->encoded_count ? w->walk->chart[w->encoded_count - 1] : 0));
    for (int k = 0; k < 3; k++)
        corners[k] = encode_vertex(w, w->mesh->triangles[triangle][k]);
    begin(w, triangle, SP_NONE, 0);
    put_in(w);
}

static void walk_all(walker *w)
{
    for (size_t i = 0; i < w->walk->count; i++) {
        if (w->encoded[w->by_chart[i]])
            continue;
        start(w, w->by_chart[i]);
        while (w->taken < w->queued) {
            uint32_t gate = w->queue[w->taken++];
            if (!w->met[gate])
                pass(w, gate);
        }
    }
    for (uint32_t i = 0; i < w->mesh->vertex_count; i++)
        number_of(w, i);
}

/* Edges by their ends, triangles by their charts. */
static bool sort(walker *w)
{
    size_t count = w->walk->count;
    uint64_t *keys = malloc((count + 1) * sizeof *keys);
    for (size_t i = 0; keys && i < count; i++)
        keys[i] = w->atlas->chart[i];
    for (uint32_t i = 0; i < 3 * count; i++) {
        uint32_t end = after(i);
        w->edges[i] = (uint64_t)w->mesh->triangles[i / 3][i % 3] << 32 | w->mesh->triangles[end / 3][end % 3];
    }
    bool done = keys && sp_order_by_key(keys, count, w->by_chart) && sp_order_by_key(w->edges, 3 * count, w->corner_of);
    free(keys);
    return done;
}

static bool make_room(walker *w)
{
    sp_triangle_order *walk = w->walk;
    size_t triangles = walk->count + 1, vertices = walk->vertex_count + 1;
    walk->triangle = malloc(triangles * sizeof *walk->triangle);
    walk->vertex = malloc(vertices * sizeof *walk->vertex);
    walk->corners = malloc(triangles * sizeof *walk->corners);
    walk->chart = malloc(triangles * sizeof *walk->chart);
    walk->gate = malloc(triangles * sizeof *walk->gate);
    walk->far = malloc(triangles);
    w->models = calloc(1, sizeof *w->models);
    w->edges = malloc(3 * triangles * sizeof *w->edges);
    w->corner_of = malloc(3 * triangles * sizeof *w->corner_of);
    w->by_chart = malloc(triangles * sizeof *w->by_chart);
    w->encoded = calloc(triangles, sizeof *w->encoded);
    w->number = malloc(vertices * sizeof *w->number);
    w->first = malloc(vertices * sizeof *w->first);
    w->next = malloc(3 * triangles * sizeof *w->next);
    w->met = calloc(3 * triangles, sizeof *w->met);
    w->around = calloc(vertices, sizeof *w->around);
    w->queue = malloc(3 * triangles * sizeof *w->queue);
    bool done = walk->triangle && walk->vertex && walk->corners && walk->chart && walk->gate && walk->far &&
                w->models && w->edges && w->corner_of && w->by_chart && w->encoded && w->number && w->first &&
                w->next && w->met && w->around && w->queue;
    if (done) {
        memset(w->number, 0xff, vertices * sizeof *w->number);
        memset(w->first, 0xff, vertices * sizeof *w->first);
    }
    return done;
}

bool sp_triangle_order_create(sp_triangle_order *walk, const sp_mesh *mesh, const sp_atlas *atlas, sp_coder *coder)
{
    *walk = (sp_triangle_order){.count = mesh->triangle_count, .vertex_count = mesh->vertex_count};
    walker w = {.mesh = mesh, .atlas = atlas, .walk = walk, .coder = coder};
    bool done = make_room(&w) && sort(&w);
    if (done)
        walk_all(&w);
    free(w.models);
    free(w.edges);
    free(w.corner_of);
    free(w.by_chart);
    free(w.encoded);
    free(w.number);
    free(w.first);
    free(w.next);
    free(w.met);
    free(w.around);
    free(w.queue);
    return done;
}

void sp_triangle_order_free(sp_triangle_order *walk)
{
    free(walk->triangle);
    free(walk->vertex);
    free(walk->corners);
    free(walk->chart);
    free(walk->gate);
    free(walk->far);
    *walk = (sp_triangle_order){0};
}
