/* Refines a mesh to about so many triangles, for measuring: the longest edges are halved, round after round, and each
 * new vertex is moved by a small share of its edge, so that nothing is flat or regular that was not: by 0.05, or what
 * the fourth argument says. No gaps arise, and the same mesh comes out everywhere: as OBJ, in the parts that
 * there were, or as binary STL where the file's name ends in .stl. */
#include <sprayplan/sprayplan.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NO_VERTEX = -1 };

typedef struct {
    uint32_t from, to; /* from < to */
    uint32_t slot;     /* 3 triangle + which of its edges */
} edge_use;

typedef struct {
    double length;
    size_t first; /* use */
} edge;

typedef struct {
    size_t vertex_count, triangle_count, vertex_room;
    sp_vec3 *vertices;
    uint32_t (*triangles)[3];
    uint32_t *part; /* [triangle_count] */
    double jitter;  /* of an edge's length */
} mesh;

static void *allocate(size_t count, size_t size)
{
    void *memory = count <= SIZE_MAX / size ? malloc(count * size + 1) : NULL;
    if (!memory) {
        fprintf(stderr, "refine_mesh: out of memory\n");
        exit(1);
    }
    return memory;
}

static int by_vertices(const void *left, const void *right)
{
    const edge_use *a = left, *b = right;
    if (a->from != b->from)
        return a->from < b->from ? -1 : 1;
    if (a->to != b->to)
        return a->to < b->to ? -1 : 1;
    return (a->slot > b->slot) - (a->slot < b->slot);
}

static int longest_first(const void *left, const void *right)
{
    const edge *a = left, *b = right;
    if (a->length != b->length)
        return a->length > b->length ? -1 : 1;
    return (a->first > b->first) - (a->first < b->first);
}

static edge_use *list_uses(const mesh *m)
{
    edge_use *uses = allocate(3 * m->triangle_count, sizeof *uses);
    for (size_t t = 0; t < m->triangle_count; t++)
        for (int k = 0; k < 3; k++) {
            uint32_t a = m->triangles[t][k], b = m->triangles[t][(k + 1) % 3];
            uses[3 * t + (size_t)k] = (edge_use){a < b ? a : b, a < b ? b : a, (uint32_t)(3 * t) + (uint32_t)k};
        }
    qsort(uses, 3 * m->triangle_count, sizeof *uses, by_vertices);
    return uses;
}

static bool same_edge(const edge_use *a, const edge_use *b)
{
    return a->from == b->from && a->to == b->to;
}

static edge *list_edges(const mesh *m, const edge_use *uses, size_t *count)
{
    size_t use_count = 3 * m->triangle_count;
    edge *edges = allocate(use_count, sizeof *edges);
    *count = 0;
    for (size_t i = 0; i < use_count; i++)
        if (i == 0 || !same_edge(&uses[i], &uses[i - 1]))
            edges[(*count)++] = (edge){sp_distance(m->vertices[uses[i].from], m->vertices[uses[i].to]), i};
    qsort(edges, *count, sizeof *edges, longest_first);
    return edges;
}

/* SplitMix64's finaliser (Steele, Lea and Flood 2014), in [-1, 1). */
static double random_about_zero(uint64_t x)
{
    x = (x + 0x9e3779b97f4a7c15u) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return (double)((x ^ (x >> 31)) >> 11) * 0x1p-52 - 1;
}

static uint32_t add_middle(mesh *m, const edge_use *use, double length)
{
    if (m->vertex_count == m->vertex_room) {
        m->vertex_room *= 2;
        m->vertices = realloc(m->vertices, m->vertex_room * sizeof *m->vertices);
        if (!m->vertices) {
            fprintf(stderr, "refine_mesh: out of memory\n");
            exit(1);
        }
    }
    uint64_t number = 3 * (uint64_t)m->vertex_count;
    sp_vec3 off = sp_v(random_about_zero(number), random_about_zero(number + 1), random_about_zero(number + 2));
    sp_vec3 middle = sp_scale(sp_add(m->vertices[use->from], m->vertices[use->to]), 0.5);
    m->vertices[m->vertex_count] = sp_along(middle, m->jitter * length, off);
    return (uint32_t)m->vertex_count++;
}

/* Puts the triangle's parts at parts[]; middles[k] is the new vertex on edge k, or NO_VERTEX. Where
 * a quadrangle between two of them remains, the shorter diagonal is drawn. */
static size_t cut(const mesh *m, const uint32_t corner[3], const long middles[3], uint32_t (*parts)[3])
{
    uint32_t ring[6];
    size_t length = 0, parts_count = 0;
    for (int k = 0; k < 3; k++) {
        ring[length++] = corner[k];
        if (middles[k] != NO_VERTEX)
            ring[length++] = (uint32_t)middles[k];
    }
    /* Cut off the corners between two new vertices; what is left is a triangle or a quadrangle. */
    uint32_t rest[6];
    size_t left = 0;
    for (size_t i = 0; i < length; i++) {
        uint32_t before = ring[(i + length - 1) % length], after = ring[(i + 1) % length];
        bool is_corner = ring[i] == corner[0] || ring[i] == corner[1] || ring[i] == corner[2];
        bool between = before != corner[0] && before != corner[1] && before != corner[2] && after != corner[0] &&
                       after != corner[1] && after != corner[2];
        if (is_corner && between)
            memcpy(parts[parts_count++], (uint32_t[3]){before, ring[i], after}, sizeof *parts);
        else
            rest[left++] = ring[i];
    }
    size_t turn = 0;
    if (left == 4 && length == 4) /* one edge halved: from its middle to the corner across */
        turn = middles[1] == NO_VERTEX;
    else if (left == 4)
        turn = sp_distance(m->vertices[rest[0]], m->vertices[rest[2]]) >
               sp_distance(m->vertices[rest[1]], m->vertices[rest[3]]);
    for (size_t i = 1; i + 1 < left; i++)
        memcpy(parts[parts_count++], (uint32_t[3]){rest[turn], rest[(turn + i) % left], rest[(turn + i + 1) % left]},
               sizeof *parts);
    return parts_count;
}

/* Halves the longest edges: a third of all, or as many as bring about `goal` triangles. */
static void refine_once(mesh *m, size_t goal)
{
    size_t edge_count, use_count = 3 * m->triangle_count;
    edge_use *uses = list_uses(m);
    edge *edges = list_edges(m, uses, &edge_count);
    long(*middles)[3] = allocate(m->triangle_count, sizeof *middles);
    for (size_t i = 0; i < use_count; i++)
        middles[i / 3][i % 3] = NO_VERTEX;
    size_t halved = edge_count / 3 + 1, added = 0;
    for (size_t i = 0; i < halved && m->triangle_count + added < goal; i++) {
        const edge_use *use = &uses[edges[i].first];
        long middle = (long)add_middle(m, use, edges[i].length);
        for (const edge_use *of = use; of < uses + use_count && same_edge(of, use); of++, added++)
            middles[of->slot / 3][of->slot % 3] = middle;
    }
    uint32_t(*pieces)[3] = allocate(m->triangle_count + added, sizeof *pieces);
    uint32_t *part = allocate(m->triangle_count + added, sizeof *part);
    size_t count = 0;
    for (size_t t = 0; t < m->triangle_count; t++)
        for (size_t end = count + cut(m, m->triangles[t], middles[t], &pieces[count]); count < end; count++)
            part[count] = m->part[t];
    free(m->triangles);
    free(m->part);
    m->triangles = pieces;
    m->part = part;
    m->triangle_count = count;
    free(middles);
    free(edges);
    free(uses);
}

static void write_obj(const mesh *m, const sp_mesh *coarse, FILE *file)
{
    for (size_t i = 0; i < m->vertex_count; i++)
        fprintf(file, "v %.9g %.9g %.9g\n", m->vertices[i].x, m->vertices[i].y, m->vertices[i].z);
    for (size_t t = 0; t < m->triangle_count; t++) {
        if (coarse->part_count > 1 && (t == 0 || m->part[t] != m->part[t - 1]))
            fprintf(file, "o %s\n", coarse->parts[m->part[t]].name);
        fprintf(file, "f %u %u %u\n", m->triangles[t][0] + 1, m->triangles[t][1] + 1, m->triangles[t][2] + 1);
    }
}

/* Little-endian, whatever this machine is. */
static unsigned char *put_word(unsigned char *at, uint32_t word)
{
    for (int i = 0; i < 4; i++)
        *at++ = (unsigned char)(word >> 8 * i);
    return at;
}

/* Binary; without normals, which readers take from the corners. */
static void write_stl(const mesh *m, FILE *file)
{
    unsigned char header[84] = "refined";
    put_word(header + 80, (uint32_t)m->triangle_count);
    fwrite(header, sizeof header, 1, file);
    for (size_t t = 0; t < m->triangle_count; t++) {
        unsigned char record[50] = {0}, *at = record + 12;
        for (int k = 0; k < 3; k++) {
            sp_vec3 p = m->vertices[m->triangles[t][k]];
            const float numbers[3] = {(float)p.x, (float)p.y, (float)p.z};
            for (int axis = 0; axis < 3; axis++) {
                uint32_t word;
                memcpy(&word, &numbers[axis], sizeof word);
                at = put_word(at, word);
            }
        }
        fwrite(record, sizeof record, 1, file);
    }
}

static bool write_mesh(const mesh *m, const sp_mesh *coarse, const char *path)
{
    FILE *file = fopen(path, "wb");
    if (!file)
        return false;
    const char *dot = strrchr(path, '.');
    if (dot && strcmp(dot, ".stl") == 0)
        write_stl(m, file);
    else
        write_obj(m, coarse, file);
    bool bad = ferror(file);
    return !fclose(file) && !bad;
}

int main(int count, char **arguments)
{
    char *end = NULL, *rest = "";
    bool complete = count == 4 || count == 5;
    long goal = complete ? strtol(arguments[2], &end, 10) : 0;
    double jitter = count == 5 ? strtod(arguments[4], &rest) : 0.05;
    if (goal < 1 || goal > 100000000 || *end || *rest || !(jitter >= 0 && jitter < 0.5)) {
        fprintf(stderr, "usage: refine_mesh MESH TRIANGLES OUT.obj|OUT.stl [JITTER]\n");
        return 2;
    }
    sp_error error = {0};
    sp_mesh *coarse = sp_mesh_load(arguments[1], 1, &error);
    if (!coarse) {
        char text[1400];
        sp_error_text(&error, text, sizeof text);
        fprintf(stderr, "%s\n", text);
        return 1;
    }
    mesh m = {coarse->vertex_count, coarse->triangle_count, coarse->vertex_count + 1, NULL, NULL, NULL, jitter};
    m.vertices = allocate(m.vertex_room, sizeof *m.vertices);
    m.triangles = allocate(m.triangle_count, sizeof *m.triangles);
    memcpy(m.vertices, coarse->vertices, m.vertex_count * sizeof *m.vertices);
    m.part = allocate(m.triangle_count, sizeof *m.part);
    memcpy(m.triangles, coarse->triangles, m.triangle_count * sizeof *m.triangles);
    memcpy(m.part, coarse->part, m.triangle_count * sizeof *m.part);
    while (m.triangle_count < (size_t)goal)
        refine_once(&m, (size_t)goal);
    bool good = write_mesh(&m, coarse, arguments[3]);
    if (!good)
        perror(arguments[3]);
    free(m.vertices);
    free(m.triangles);
    free(m.part);
    sp_mesh_destroy(coarse);
    return good ? 0 : 1;
}
