/* Half-edge collapses in passes, after H. Hoppe, "Progressive Meshes" (1996): a vertex goes into the neighbour that
 * lies nearest to the planes around it (the memoryless quadric of P. Lindstrom and G. Turk, 1998). In each pass the
 * cheaper vertices go, none of them beside another; so all costs of a pass hold, and its order does not matter much. */
#include "atlas/charts/coarsen.h"

#include "mesh/min_max.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MOST_AROUND 14     /* triangles around a vertex */
#define LENGTH_WEIGHT 0.01 /* of the squared length of the edge that goes, against squared distances from planes */
#define LEAST_HEIGHT 0.2   /* of a new triangle over its longest edge, unless the old one had less */
#define LEAST_COSINE 0.87  /* by how much a triangle may turn */
#define SHARE 0.6          /* of the vertices that may go in a pass */
#define BUCKET_SHIFT 10    /* of keys, to find which are the cheaper ones */
#define KEY_SHIFT 11       /* costs are told apart to 2^-12 of themselves: more is round-off where shapes repeat */
#define KEYS (1u << (32 - KEY_SHIFT))
#define PINCHED 255 /* triangles around a vertex where the surface meets itself */
#define STALE (KEYS - 1)
#define NEVER (KEYS - 2)

typedef struct {
    const sp_mesh *mesh;
    uint32_t (*triangles)[3]; /* [triangle_count], the first corner SP_NONE once it has gone */
    uint32_t *twin;           /* [3 triangle_count] */
    uint32_t *first;          /* [vertex_count], a half-edge from it, SP_NONE once it has gone */
    uint32_t *towards;        /* [vertex_count], the half-edge along which it would go */
    uint32_t *key;            /* [vertex_count], what that costs */
    uint8_t *around;          /* [vertex_count], triangles; PINCHED where they do not all hang together */
    uint8_t *stays;           /* [vertex_count] */
    uint32_t *triangle_into;  /* [triangle_count], where a triangle has gone */
    uint32_t *vertex_into;    /* [vertex_count] */
    double scale;             /* of squared lengths */
    size_t left;              /* triangles */
} mesh_of;

static uint32_t begin(const mesh_of *m, uint32_t half_edge)
{
    return m->triangles[half_edge / 3][half_edge % 3];
}

/* The next half-edge from the same vertex, anticlockwise; SP_NONE beyond the surface's end. */
static uint32_t next_out(const mesh_of *m, uint32_t half_edge)
{
    return m->twin[sp_around(sp_around(half_edge))];
}

/* Half-edges from a vertex with surface all around it; 0 where it has not, or more than there is room for. */
static int list_around(const mesh_of *m, uint32_t vertex, uint32_t out[MOST_AROUND])
{
    int count = 0;
    uint32_t h = m->first[vertex];
    do {
        if (count == MOST_AROUND)
            return 0;
        out[count++] = h;
        h = next_out(m, h);
    } while (h != SP_NONE && h != out[0]);
    return h == SP_NONE ? 0 : count;
}

/* A triangle with sides a and b, in place of one whose normal is `before`: turned little, and not too thin. */
static bool is_sound(sp_vec3 a, sp_vec3 b, sp_vec3 before)
{
    sp_vec3 normal = sp_cross(a, b), c = sp_sub(b, a);
    double squared = sp_dot(normal, normal), along = sp_dot(normal, before);
    if (!(along > 0) || along * along < LEAST_COSINE * LEAST_COSINE * squared * sp_dot(before, before))
        return false;
    double longest = sp_greater(sp_dot(a, a), sp_greater(sp_dot(b, b), sp_dot(c, c)));
    return squared > LEAST_HEIGHT * LEAST_HEIGHT * longest * longest;
}

typedef struct {
    int count;
    uint32_t out[MOST_AROUND];
    sp_vec3 edge[MOST_AROUND], normal[MOST_AROUND];
    double weight[MOST_AROUND]; /* one over the area, doubled */
} star;

/* Whether all triangles stay sound that keep a corner when the middle goes to neighbour `to`. */
static bool may_go(const star *s, int to)
{
    for (int i = 0; i < s->count; i++) {
        int j = i + 1 < s->count ? i + 1 : 0;
        if (i != to && j != to &&
            !is_sound(sp_sub(s->edge[i], s->edge[to]), sp_sub(s->edge[j], s->edge[to]), s->normal[i]))
            return false;
    }
    return true;
}

static void measure_star(const mesh_of *m, uint32_t vertex, star *s, double *area)
{
    const sp_vec3 *at = m->mesh->vertices;
    for (int i = 0; i < s->count; i++)
        s->edge[i] = sp_sub(at[begin(m, sp_around(s->out[i]))], at[vertex]);
    *area = 0;
    for (int i = 0; i < s->count; i++) {
        s->normal[i] = sp_cross(s->edge[i], s->edge[i + 1 < s->count ? i + 1 : 0]);
        double length = sqrt(sp_dot(s->normal[i], s->normal[i]));
        *area += length;
        s->weight[i] = length > 0 ? 1 / length : 0;
    }
}

/* Costs are compared by the leading bits of a float, a little off so that round numbers do not fall between two. */
static uint32_t key_of(double cost)
{
    float rounded = (float)(1.0371 * cost);
    uint32_t bits;
    memcpy(&bits, &rounded, sizeof bits);
    return bits >> KEY_SHIFT < NEVER ? bits >> KEY_SHIFT : NEVER;
}

/* Finds where a vertex would go, and what it costs. */
static void appraise(mesh_of *m, uint32_t vertex)
{
    star s;
    double area, cost[MOST_AROUND];
    m->key[vertex] = NEVER;
    s.count = list_around(m, vertex, s.out);
    if (s.count == 0)
        return;
    measure_star(m, vertex, &s, &area);
    for (int j = 0; j < s.count; j++) {
        double sum = 0;
        for (int i = 0; i < s.count; i++) {
            double height = sp_dot(s.normal[i], s.edge[j]);
            sum += height * height * s.weight[i];
        }
        cost[j] = sum / area + LENGTH_WEIGHT * sp_dot(s.edge[j], s.edge[j]);
    }
    for (int tried = 0; tried < s.count; tried++) {
        int best = 0;
        for (int j = 1; j < s.count; j++)
            best = cost[j] < cost[best] * (1 - 1e-9) ? j : best;
        if (!(cost[best] < INFINITY))
            return;
        if (may_go(&s, best)) {
            m->towards[vertex] = s.out[best];
            m->key[vertex] = key_of(cost[best] * m->scale);
            return;
        }
        cost[best] = INFINITY;
    }
}

/* Whether a star is of three triangles or more, no neighbour reached twice. Two triangles laid on each other, as at the
 * corner of a doubled sheet, would otherwise be folded into each other, and neither would be left to stand for both. */
static bool is_simple(const mesh_of *m, const uint32_t *out, int count)
{
    for (int i = 0; i < count; i++)
        for (int k = 0; k < i; k++)
            if (begin(m, sp_around(out[i])) == begin(m, sp_around(out[k])))
                return false;
    return count >= 3;
}

/* Whether the ends of an edge have but two neighbours in common, so that the surface stays one. */
static bool may_join(const mesh_of *m, const uint32_t *out, int count, uint32_t half_edge)
{
    uint32_t twin = m->twin[half_edge], to = begin(m, twin);
    uint32_t left = m->twin[sp_around(half_edge)], right = m->twin[sp_around(sp_around(twin))];
    if (m->around[to] + count - 4 > MOST_AROUND || !is_simple(m, out, count) ||
        (left != SP_NONE && right != SP_NONE && left / 3 == right / 3))
        return false;
    int common = 0;
    uint32_t h = twin, last = SP_NONE;
    for (; h != SP_NONE; h = next_out(m, h)) { /* anticlockwise, then from the start clockwise */
        for (int i = 0; i < count; i++)
            common += begin(m, sp_around(h)) == begin(m, sp_around(out[i]));
        last = h;
        if (next_out(m, h) == twin)
            return common == 2;
    }
    uint32_t end = begin(m, sp_around(sp_around(last)));
    for (int i = 0; i < count; i++)
        common += end == begin(m, sp_around(out[i]));
    for (h = twin; m->twin[h] != SP_NONE;) {
        h = sp_around(m->twin[h]);
        for (int i = 0; i < count; i++)
            common += begin(m, sp_around(h)) == begin(m, sp_around(out[i]));
    }
    return common == 2;
}

/* Takes out the triangle left of a half-edge whose beginning goes to its end; what it covered goes to the triangle that
 * is drawn over it. */
static void close_up(mesh_of *m, uint32_t triangle, uint32_t kept, uint32_t beyond)
{
    m->twin[kept] = beyond;
    if (beyond != SP_NONE)
        m->twin[beyond] = kept;
    m->triangle_into[triangle] = kept / 3;
    m->triangles[triangle][0] = SP_NONE;
    m->left--;
}

static void collapse(mesh_of *m, uint32_t vertex, const uint32_t *out, int count)
{
    uint32_t half_edge = m->towards[vertex], twin = m->twin[half_edge], to = begin(m, twin);
    for (int i = 0; i < count; i++) {
        uint32_t other = begin(m, sp_around(out[i]));
        m->key[other] = m->stays[other] ? NEVER : STALE;
    }
    uint32_t left = begin(m, sp_around(sp_around(half_edge))), right = begin(m, sp_around(sp_around(twin)));
    for (int i = 0; i < count; i++)
        m->triangles[out[i] / 3][out[i] % 3] = to;
    uint32_t kept = m->twin[sp_around(sp_around(half_edge))], beyond = m->twin[sp_around(half_edge)];
    uint32_t other_kept = m->twin[sp_around(twin)], other_beyond = m->twin[sp_around(sp_around(twin))];
    close_up(m, half_edge / 3, kept, beyond);
    close_up(m, twin / 3, other_kept, other_beyond);
    m->first[to] = kept;
    m->first[left] = sp_around(kept);
    m->first[right] = other_kept;
    m->around[to] = (uint8_t)(m->around[to] + count - 4);
    m->around[left] -= m->around[left] != PINCHED;
    m->around[right] -= m->around[right] != PINCHED;
    m->first[vertex] = SP_NONE;
    m->key[vertex] = NEVER;
    m->vertex_into[vertex] = to;
}

/* The largest bucket of keys that go in this pass; 0 where none may. */
static uint32_t find_limit(const mesh_of *m)
{
    size_t counts[KEYS >> BUCKET_SHIFT] = {0}, all = 0, below = 0;
    for (size_t v = 0; v < m->mesh->vertex_count; v++)
        if (m->key[v] < NEVER) {
            counts[m->key[v] >> BUCKET_SHIFT]++;
            all++;
        }
    uint32_t limit = 0;
    for (uint32_t i = 0; i < KEYS >> BUCKET_SHIFT && (double)below < SHARE * (double)all; i++) {
        below += counts[i];
        limit = i;
    }
    return limit;
}

/* False when no vertex could go. */
static bool pass(mesh_of *m, size_t target)
{
    for (uint32_t v = 0; v < m->mesh->vertex_count; v++)
        if (m->key[v] == STALE)
            appraise(m, v);
    uint32_t limit = find_limit(m), out[MOST_AROUND];
    size_t before = m->left;
    for (uint32_t v = 0; v < m->mesh->vertex_count && m->left > target; v++) {
        if (m->key[v] >= NEVER || m->key[v] >> BUCKET_SHIFT > limit)
            continue;
        int count = list_around(m, v, out);
        if (may_join(m, out, count, m->towards[v]))
            collapse(m, v, out, count);
        else
            m->key[v] = NEVER;
    }
    return m->left < before;
}

/* What hangs together around a vertex is all that it has; else the surface is open or meets itself there. */
static void look_around(mesh_of *m, const uint32_t *used)
{
    for (uint32_t v = 0; v < m->mesh->vertex_count; v++) {
        m->stays[v] = 1;
        if (used[v] == 0)
            continue;
        uint32_t h = m->first[v], count = 0;
        do {
            count++;
            h = next_out(m, h);
        } while (h != SP_NONE && h != m->first[v]);
        m->stays[v] = h == SP_NONE;
        for (h = m->stays[v] ? m->first[v] : SP_NONE; h != SP_NONE && m->twin[h] != SP_NONE; count++)
            h = sp_around(m->twin[h]);
        m->around[v] = count == used[v] && count < PINCHED ? (uint8_t)count : PINCHED;
        m->stays[v] |= m->around[v] == PINCHED;
    }
}

/* Where the surface lies flat around a vertex, neither that vertex nor any beside it goes. */
static void keep_flat(mesh_of *m, const uint8_t *bend)
{
    for (size_t t = 0; t < m->mesh->triangle_count; t++)
        for (int k = 0; k < 3; k++)
            if (bend[m->triangles[t][k]] == SP_BEND_EXACT && m->around[m->triangles[t][k]] != PINCHED)
                m->stays[m->triangles[t][(k + 1) % 3]] |= 2;
    for (size_t v = 0; v < m->mesh->vertex_count; v++) {
        m->stays[v] |= bend[v] == SP_BEND_EXACT ? 2 : 0;
        m->key[v] = m->stays[v] ? NEVER : STALE;
    }
}

static bool begin_with(mesh_of *m, const sp_sheets *fine)
{
    size_t triangles = m->mesh->triangle_count, vertices = m->mesh->vertex_count;
    uint32_t *used = m->towards; /* until keys are made */
    double area = 0;
    memcpy(m->triangles, m->mesh->triangles, triangles * sizeof *m->triangles);
    memcpy(m->twin, fine->twin, 3 * triangles * sizeof *m->twin);
    memset(used, 0, vertices * sizeof *used);
    for (uint32_t v = 0; v < vertices; v++) {
        m->first[v] = SP_NONE;
        m->vertex_into[v] = v;
    }
    for (uint32_t t = 0; t < triangles; t++) {
        m->triangle_into[t] = t;
        area += 0.5 * fine->shape[t][0] * fine->shape[t][2];
        for (uint32_t k = 0; k < 3; k++) {
            used[m->triangles[t][k]]++;
            m->first[m->triangles[t][k]] = 3 * t + k;
        }
    }
    m->left = triangles;
    m->scale = (double)triangles / area;
    look_around(m, used);
    keep_flat(m, fine->bend);
    return area > 0;
}

/* Numbers what is left in its order, and says of everything else where it has gone. */
static bool take_out(mesh_of *m, sp_coarse *coarse)
{
    size_t triangles = m->mesh->triangle_count, vertices = m->mesh->vertex_count, count = 0;
    coarse->mesh.triangles = malloc((m->left + 1) * sizeof *coarse->mesh.triangles);
    coarse->twin = malloc((3 * m->left + 1) * sizeof *coarse->twin);
    uint32_t *number = m->towards; /* of what is left */
    for (uint32_t v = 0; v < vertices; v++)
        if (m->first[v] != SP_NONE)
            number[v] = (uint32_t)count++;
    coarse->mesh.vertex_count = count;
    coarse->mesh.vertices = malloc((count + 1) * sizeof *coarse->mesh.vertices);
    if (!coarse->mesh.triangles || !coarse->twin || !coarse->mesh.vertices)
        return false;
    for (uint32_t v = 0; v < vertices; v++)
        if (m->first[v] != SP_NONE)
            coarse->mesh.vertices[number[v]] = m->mesh->vertices[v];
    for (uint32_t v = 0; v < vertices; v++) {
        uint32_t into = sp_linked(m->vertex_into, v);
        coarse->vertex[v] = m->first[into] != SP_NONE ? number[into] : SP_NONE;
    }
    count = 0;
    for (uint32_t t = 0; t < triangles; t++)
        if (m->triangles[t][0] != SP_NONE)
            coarse->parent[t] = (uint32_t)count++;
    coarse->mesh.triangle_count = count;
    for (uint32_t t = 0; t < triangles; t++) {
        if (m->triangles[t][0] == SP_NONE) {
            coarse->parent[t] = coarse->parent[sp_linked(m->triangle_into, t)];
            continue;
        }
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t twin = m->twin[3 * t + k], here = coarse->parent[t];
            coarse->mesh.triangles[here][k] = number[m->triangles[t][k]];
            coarse->twin[3 * here + k] = twin == SP_NONE ? SP_NONE : 3 * coarse->parent[twin / 3] + twin % 3;
        }
    }
    return true;
}

bool sp_coarsen(const sp_sheets *fine, size_t target, sp_coarse *coarse)
{
    size_t triangles = fine->mesh->triangle_count + 1, vertices = fine->mesh->vertex_count + 1;
    mesh_of m = {.mesh = fine->mesh};
    *coarse = (sp_coarse){0};
    m.triangles = malloc(triangles * sizeof *m.triangles);
    m.twin = malloc(3 * triangles * sizeof *m.twin);
    m.first = malloc(vertices * sizeof *m.first);
    m.towards = malloc(vertices * sizeof *m.towards);
    m.key = malloc(vertices * sizeof *m.key);
    m.around = calloc(vertices, 1);
    m.stays = calloc(vertices, 1);
    m.triangle_into = malloc(triangles * sizeof *m.triangle_into);
    m.vertex_into = malloc(vertices * sizeof *m.vertex_into);
    coarse->parent = malloc(triangles * sizeof *coarse->parent);
    coarse->vertex = malloc(vertices * sizeof *coarse->vertex);
    bool good = m.triangles && m.twin && m.first && m.towards && m.key && m.around && m.stays && m.triangle_into &&
                m.vertex_into && coarse->parent && coarse->vertex;
    if (good && begin_with(&m, fine))
        while (m.left > target && pass(&m, target)) {
        }
    good = good && take_out(&m, coarse);
    free(m.triangles);
    free(m.twin);
    free(m.first);
    free(m.towards);
    free(m.key);
    free(m.around);
    free(m.stays);
    free(m.triangle_into);
    free(m.vertex_into);
    if (!good)
        sp_coarse_free(coarse);
    return good;
}

void sp_coarse_free(sp_coarse *coarse)
{
    free(coarse->mesh.vertices);
    free(coarse->mesh.triangles);
    free(coarse->twin);
    free(coarse->parent);
    free(coarse->vertex);
    *coarse = (sp_coarse){0};
}
