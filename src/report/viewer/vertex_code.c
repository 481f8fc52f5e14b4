/* surface.js does the same the other way round, operation by operation: whatever is changed here is changed there. */
#include "vertex_code.h"

#include "packed.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MOST 0x1p49 /* of a number: sums of three, and twice that, are whole */
#define MOST_DIGITS 60
#define NEARLY_ALL 0.99

static double read_back(const sp_vertices_encoded *format, double number)
{
    return number / format->parts * format->unit;
}

static double number_of(const sp_vertices_encoded *format, double value)
{
    return rint(fmin(fmax(value / format->unit * format->parts, -MOST), MOST));
}

static size_t count_whole(const sp_mesh *mesh, const sp_vertices_encoded *format)
{
    const double *values = &mesh->vertices[0].x;
    size_t whole = 0;
    for (size_t i = 0; i < 3 * mesh->vertex_count; i++)
        whole += read_back(format, number_of(format, values[i])) == values[i];
    return whole;
}

/* The base to this power. */
static double step_of(const sp_vertices_encoded *format, int power)
{
    double step = 1;
    while (power-- > 0)
        step *= format->base;
    return step;
}

/* How many zeros a number has at least behind its digits. */
static int zeros_of(const sp_vertices_encoded *format, double number)
{
    int zeros = 0;
    for (double limit = step_of(format, format->digits); fabs(number) >= limit && zeros < MOST_DIGITS; zeros++)
        limit *= format->base;
    return zeros;
}

/* The fewest digits that nearly all numbers have. */
static void find_digits(const sp_mesh *mesh, sp_vertices_encoded *format)
{
    const double *values = &mesh->vertices[0].x;
    size_t count = 3 * mesh->vertex_count, fitting = 0;
    for (format->digits = 1; format->digits < MOST_DIGITS && (double)fitting < NEARLY_ALL * (double)count;) {
        fitting = 0;
        for (size_t i = 0; i < count; i++) {
            double number = number_of(format, values[i]);
            fitting += fmod(number, step_of(format, zeros_of(format, number))) == 0;
        }
        format->digits += (double)fitting < NEARLY_ALL * (double)count;
    }
}

/* That under which most coordinates are whole: decimals, or binary fractions as floats of single precision are. */
static sp_vertices_encoded format_of(const sp_mesh *mesh)
{
    static const double units[] = {1, 1e-3, 1e-2, 0.0254, 0.3048};
    static const double binary[] = {0x1p20, 0x1p28, 0x1p36};
    sp_vertices_encoded best = {1, 1, 10, 1};
    size_t most = 0;
    for (size_t u = 0; u < sizeof units / sizeof *units; u++)
        for (int i = 0; i < 10 + 3; i++) {
            sp_vertices_encoded tried = {i < 10 ? pow(10, i) : binary[i - 10], units[u], i < 10 ? 10 : 2, 1};
            size_t whole = count_whole(mesh, &tried);
            if (whole > most) {
                most = whole;
                best = tried;
            }
        }
    find_digits(mesh, &best);
    return best;
}

/* What is learnt of numbers along each axis: how far they are off, by about the size of that of the axis before. */
typedef struct {
    sp_number_model zeros[3], off[3][17], missed;
} models;

/* The numbers that vertices become when they are read back, as they are encoded. */
typedef struct {
    const sp_vertices_encoded *format;
    double (*number)[3]; /* [vertices encoded], those that are known */
    sp_coder *coder;
    models *models;
} encoder;

static void encode(const encoder *t, sp_vec3 place, const double expected[3], double number[3])
{
    const double value[3] = {place.x, place.y, place.z};
    int before = 0;
    for (int k = 0; k < 3; k++) {
        double whole = number_of(t->format, value[k]);
        int zeros = zeros_of(t->format, whole);
        double step = step_of(t->format, zeros), near = floor(expected[k] / step + 0.5);
        double off = rint(whole / step) - near;
        sp_code_number(t->coder, &t->models->zeros[k], zeros - zeros_of(t->format, expected[k]));
        before = sp_code_number(t->coder, &t->models->off[k][(before + 3) / 4], (int64_t)off);
        number[k] = (near + off) * step;
        sp_code_number(t->coder, &t->models->missed, sp_packed_apart(value[k], read_back(t->format, number[k])));
    }
}

/* Over the edge that its triangle was reached over as far as the triangle on its other side, or else where the vertex
 * encoded before is. */
static void expect(const encoder *t, const sp_triangle_order *walk, uint32_t triangle, uint32_t vertex,
                   double number[3])
{
    uint32_t gate = triangle == SP_NONE ? SP_NONE : walk->gate[triangle];
    if (gate == SP_NONE) {
        memcpy(number, vertex ? t->number[vertex - 1] : (double[]){0, 0, 0}, sizeof *t->number);
        return;
    }
    const uint32_t *v = walk->corners[gate / 3];
    uint32_t a = v[gate % 3], b = v[(gate % 3 + 1) % 3], other = v[(gate % 3 + 2) % 3];
    for (int k = 0; k < 3; k++)
        number[k] = t->number[a][k] + t->number[b][k] - t->number[other][k];
}

static void encode_all(const encoder *t, const sp_mesh *mesh, const sp_triangle_order *walk)
{
    double expected[3];
    uint32_t fresh = 0;
    for (uint32_t i = 0; i < walk->count; i++)
        for (int k = 0; k < 3; k++)
            if (walk->corners[i][k] == fresh) {
                expect(t, walk, i, fresh, expected);
                encode(t, mesh->vertices[walk->vertex[fresh]], expected, t->number[fresh]);
                fresh++;
            }
    for (; fresh < walk->vertex_count; fresh++) {
        expect(t, walk, SP_NONE, fresh, expected);
        encode(t, mesh->vertices[walk->vertex[fresh]], expected, t->number[fresh]);
    }
}

bool sp_vertices_encode(const sp_mesh *mesh, const sp_triangle_order *walk, sp_coder *coder,
                        sp_vertices_encoded *format)
{
    *format = format_of(mesh);
    encoder t = {.format = format,
                 .number = malloc((walk->vertex_count + 1) * sizeof *t.number),
                 .coder = coder,
                 .models = calloc(1, sizeof *t.models)};
    bool done = t.number && t.models;
    if (done)
        encode_all(&t, mesh, walk);
    free(t.number);
    free(t.models);
    return done;
}
