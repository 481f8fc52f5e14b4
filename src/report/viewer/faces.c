/* surface.js does the same the other way round: whatever is changed here is changed there. */
#include "faces.h"

#include <stdlib.h>
#include <string.h>
#include <zlib.h>

#define STEPS 32     /* triangles at a vertex that are looked at, the latest first */
#define FARTHEST 255 /* triangles back: a byte, of which 0 means none */

enum { FACES_DIFFERENCES, FACES_EDGES };

typedef struct {
    const sp_mesh *mesh;
    uint32_t *first, *next; /* [vertices], [corners]: the latest corner at each vertex, the one before; SP_NONE */
    uint8_t *lags, *turns;  /* [triangles]: how far back its neighbour lies; on which edges of either they meet */
    int64_t *before;        /* [corners]: the others, each as what it is less than the next vertex that none has had */
    size_t turned, told;
    uint32_t fresh; /* the next vertex */
} teller;

/* The latest corner from which an edge leads from `from` to `to`; SP_NONE. */
static uint32_t edge_corner(const teller *t, uint32_t from, uint32_t to)
{
    uint32_t corner = t->first[from];
    for (int steps = 0; corner != SP_NONE && steps < STEPS; corner = t->next[corner], steps++)
        if (t->mesh->triangles[corner / 3][(corner + 1) % 3] == to)
            return corner;
    return SP_NONE;
}

static void tell_vertex(teller *t, uint32_t vertex)
{
    t->before[t->told++] = (int64_t)t->fresh - vertex;
    t->fresh = vertex >= t->fresh ? vertex + 1 : t->fresh;
}

static void tell(teller *t, uint32_t triangle)
{
    const uint32_t *v = t->mesh->triangles[triangle];
    uint32_t best = SP_NONE, edge = 0;
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t corner = edge_corner(t, v[(k + 1) % 3], v[k]);
        if (corner != SP_NONE && triangle - corner / 3 <= FARTHEST && (best == SP_NONE || corner > best)) {
            best = corner;
            edge = k;
        }
    }
    t->lags[triangle] = best == SP_NONE ? 0 : (uint8_t)(triangle - best / 3);
    if (best != SP_NONE)
        t->turns[t->turned++] = (uint8_t)(3 * (best % 3) + edge);
    for (uint32_t k = best == SP_NONE ? 0 : 2; k < 3; k++)
        tell_vertex(t, v[(k + (best == SP_NONE ? 0 : edge)) % 3]);
    for (uint32_t k = 0; k < 3; k++) {
        t->next[3 * triangle + k] = t->first[v[k]];
        t->first[v[k]] = 3 * triangle + k;
    }
}

static bool pack_edges(const sp_mesh *mesh, sp_packed *packed)
{
    size_t count = mesh->triangle_count;
    teller t = {.mesh = mesh,
                .first = malloc((mesh->vertex_count + 1) * sizeof *t.first),
                .next = malloc((3 * count + 1) * sizeof *t.next),
                .lags = malloc(count + 1),
                .turns = malloc(count + 1),
                .before = malloc((3 * count + 1) * sizeof *t.before)};
    bool done = t.first && t.next && t.lags && t.turns && t.before;
    if (done) {
        memset(t.first, 0xff, mesh->vertex_count * sizeof *t.first);
        for (uint32_t i = 0; i < count; i++)
            tell(&t, i);
        sp_packed_words(packed, (const uint32_t[]){FACES_EDGES}, 1, false);
        sp_packed_bytes(packed, t.lags, count);
        sp_packed_bytes(packed, t.turns, t.turned);
        sp_packed_numbers(packed, t.before, t.told);
    }
    free(t.first);
    free(t.next);
    free(t.lags);
    free(t.turns);
    free(t.before);
    return done;
}

/* Bytes when deflated, 0 where memory runs out. */
static uLongf deflated(const sp_packed *packed)
{
    uLongf size = compressBound(packed->length);
    uint8_t *bytes = packed->failed ? NULL : malloc(size);
    if (!bytes || compress2(bytes, &size, (const Bytef *)packed->text, packed->length, Z_BEST_COMPRESSION) != Z_OK)
        size = 0;
    free(bytes);
    return size;
}

bool sp_faces_pack(const sp_mesh *mesh, sp_packed *packed)
{
    sp_packed edges = {0}, differences = {0};
    bool done = pack_edges(mesh, &edges);
    sp_packed_words(&differences, (const uint32_t[]){FACES_DIFFERENCES}, 1, false);
    sp_packed_split(&differences, mesh->triangles[0], 3 * mesh->triangle_count);
    uLongf by_edges = done ? deflated(&edges) : 0, by_differences = done ? deflated(&differences) : 0;
    done = by_edges > 0 && by_differences > 0;
    const sp_packed *less = by_edges < by_differences ? &edges : &differences;
    if (done)
        sp_text_append(packed, less->text, less->length);
    free(edges.text);
    free(differences.text);
    return done;
}
