/* surface.js does the same the other way round, operation by operation: whatever is changed here is changed there. */
#include "places.h"

#include "faces.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MOST 0x1p49 /* of a number: sums of three, and twice that, are whole */
#define MOST_DIGITS 60
#define NEARLY_ALL 0.99
#define STEPS 32 /* around a vertex, in search of a triangle */

static double read_back(const sp_places_told *told, double number)
{
    return number / told->parts * told->unit;
}

static double number_of(const sp_places_told *told, double value)
{
    return rint(fmin(fmax(value / told->unit * told->parts, -MOST), MOST));
}

static size_t count_whole(const sp_mesh *mesh, const sp_places_told *told)
{
    const double *values = &mesh->vertices[0].x;
    size_t whole = 0;
    for (size_t i = 0; i < 3 * mesh->vertex_count; i++)
        whole += read_back(told, number_of(told, values[i])) == values[i];
    return whole;
}

/* The base to this power. */
static double step_of(const sp_places_told *told, int power)
{
    double step = 1;
    while (power-- > 0)
        step *= told->base;
    return step;
}

/* How many zeros a number has at least behind its digits. */
static int zeros_of(const sp_places_told *told, double number)
{
    int zeros = 0;
    for (double limit = step_of(told, told->digits); fabs(number) >= limit && zeros < MOST_DIGITS; zeros++)
        limit *= told->base;
    return zeros;
}

/* The fewest digits that nearly all numbers have. */
static void find_digits(const sp_mesh *mesh, sp_places_told *told)
{
    const double *values = &mesh->vertices[0].x;
    size_t count = 3 * mesh->vertex_count, fitting = 0;
    for (told->digits = 1; told->digits < MOST_DIGITS && (double)fitting < NEARLY_ALL * (double)count;) {
        fitting = 0;
        for (size_t i = 0; i < count; i++) {
            double number = number_of(told, values[i]);
            fitting += fmod(number, step_of(told, zeros_of(told, number))) == 0;
        }
        told->digits += (double)fitting < NEARLY_ALL * (double)count;
    }
}

/* That under which most coordinates are whole: decimals, or binary fractions as floats of single precision are. */
static sp_places_told told_of(const sp_mesh *mesh)
{
    static const double units[] = {1, 1e-3, 1e-2, 0.0254, 0.3048};
    static const double binary[] = {0x1p20, 0x1p28, 0x1p36};
    sp_places_told best = {1, 1, 10, 1};
    size_t most = 0;
    for (size_t u = 0; u < sizeof units / sizeof *units; u++)
        for (int i = 0; i < 10 + 3; i++) {
            sp_places_told tried = {i < 10 ? pow(10, i) : binary[i - 10], units[u], i < 10 ? 10 : 2, 1};
            size_t whole = count_whole(mesh, &tried);
            if (whole > most) {
                most = whole;
                best = tried;
            }
        }
    find_digits(mesh, &best);
    return best;
}

typedef struct {
    const sp_mesh *mesh;
    const sp_places_told *told;
    double (*number)[3];    /* [vertices], of those that are known */
    bool *known;            /* [vertices] */
    uint32_t *first, *next; /* [vertices], [3 triangles]: corners at each vertex of the triangles before */
    uint32_t last;          /* vertex told before, SP_NONE: none */
    size_t count;           /* of numbers told */
    uint8_t *zeros;         /* [3 vertices], more than expected */
    int64_t *off;           /* [3 vertices] */
    int64_t *missed;        /* [3 vertices], by vertex */
} teller;

/* The third corner of the latest triangle on the edge from a to b, SP_NONE for none. */
static uint32_t beyond(const teller *t, uint32_t a, uint32_t b)
{
    uint32_t corner = t->first[a];
    for (int steps = 0; corner != SP_NONE && steps < STEPS; steps++, corner = t->next[corner]) {
        const uint32_t *v = t->mesh->triangles[corner / 3];
        uint32_t i = corner % 3;
        if (v[(i + 1) % 3] == b || v[(i + 2) % 3] == b)
            return v[(i + 1) % 3] == b ? v[(i + 2) % 3] : v[(i + 1) % 3];
    }
    return SP_NONE;
}

/* Over the edge from a to b as far as the triangle on its other side, or else where a neighbour is. */
static void expect(const teller *t, uint32_t a, uint32_t b, double number[3])
{
    bool both = a != SP_NONE && b != SP_NONE && t->known[a] && t->known[b];
    uint32_t other = both ? beyond(t, a, b) : SP_NONE;
    uint32_t near = a != SP_NONE && t->known[a] ? a : b != SP_NONE && t->known[b] ? b : t->last;
    for (int k = 0; k < 3; k++)
        number[k] = other != SP_NONE  ? t->number[a][k] + t->number[b][k] - t->number[other][k]
                    : near != SP_NONE ? t->number[near][k]
                                      : 0;
}

static void tell(teller *t, uint32_t vertex, uint32_t a, uint32_t b)
{
    const double *value = &t->mesh->vertices[vertex].x;
    double expected[3];
    expect(t, a, b, expected);
    for (int k = 0; k < 3; k++, t->count++) {
        double number = number_of(t->told, value[k]);
        int zeros = zeros_of(t->told, number);
        double step = step_of(t->told, zeros), off = rint(number / step) - floor(expected[k] / step + 0.5);
        t->zeros[t->count] = (uint8_t)(zeros - zeros_of(t->told, expected[k]));
        t->off[t->count] = (int64_t)off;
        t->number[vertex][k] = (floor(expected[k] / step + 0.5) + off) * step;
        t->missed[3 * (size_t)vertex + (size_t)k] = sp_packed_apart(value[k], read_back(t->told, t->number[vertex][k]));
    }
    t->known[vertex] = true;
    t->last = vertex;
}

static void tell_all(teller *t)
{
    const sp_mesh *mesh = t->mesh;
    for (size_t i = 0; i < mesh->triangle_count; i++) {
        const uint32_t *v = mesh->triangles[i];
        for (int k = 0; k < 3; k++)
            if (!t->known[v[k]])
                tell(t, v[k], v[(k + 1) % 3], v[(k + 2) % 3]);
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t corner = 3 * (uint32_t)i + k;
            t->next[corner] = t->first[v[k]];
            t->first[v[k]] = corner;
        }
    }
    for (uint32_t i = 0; i < mesh->vertex_count; i++)
        if (!t->known[i])
            tell(t, i, SP_NONE, SP_NONE);
}

bool sp_places_pack(const sp_mesh *mesh, sp_packed *packed, sp_places_told *told)
{
    size_t count = mesh->vertex_count;
    *told = told_of(mesh);
    teller t = {.mesh = mesh,
                .told = told,
                .number = malloc((count + 1) * sizeof *t.number),
                .known = calloc(count + 1, sizeof *t.known),
                .first = malloc((count + 1) * sizeof *t.first),
                .next = malloc((3 * mesh->triangle_count + 1) * sizeof *t.next),
                .last = SP_NONE,
                .zeros = malloc(3 * count + 1),
                .off = malloc((3 * count + 1) * sizeof *t.off),
                .missed = malloc((3 * count + 1) * sizeof *t.missed)};
    bool done = t.number && t.known && t.first && t.next && t.zeros && t.off && t.missed;
    if (done) {
        memset(t.first, 0xff, count * sizeof *t.first);
        tell_all(&t);
        done = sp_faces_pack(mesh, packed);
        sp_packed_bytes(packed, t.zeros, 3 * count);
        sp_packed_numbers(packed, t.off, 3 * count);
        sp_packed_numbers(packed, t.missed, 3 * count);
    }
    free(t.number);
    free(t.known);
    free(t.first);
    free(t.next);
    free(t.zeros);
    free(t.off);
    free(t.missed);
    return done;
}
