/* Each face is judged at its middle. Where several triangles lie on each other there, one stands for all of them: a
 * sheet rather than a side of a solid, of equals the lowest; the others touch it and do not count. What the space just
 * beyond either side is, material or not, the winding number says. */
#include "spray/wet/faces.h"

#include <stdlib.h>
#include <string.h>

#define BEYOND 2.0     /* contacts: how far beyond a side its space is judged */
#define OFF_EDGES 0.05 /* of the way to the middle: lines of sight start no nearer to an edge */

static double area_of_piece(const sp_triangle_piece *piece)
{
    double twice = 0;
    for (int i = 0; i < piece->count; i++) {
        const double *p = piece->at[i], *q = piece->at[(i + 1) % piece->count];
        twice += p[0] * q[1] - p[1] * q[0];
    }
    return fabs(twice); /* of the triangle's, whose own is 1/2 in weights */
}

/* A piece has few of the corners that it has room for: what is kept of it are these. */
typedef struct {
    sp_faces *faces;
    double *largest; /* [cells], share of the triangle that the piece takes whose corners are kept */
    size_t used, room;
    double triangle_area;
    bool failed;
} cell_measure;

static void keep_corners(cell_measure *measure, uint32_t cell, const sp_triangle_piece *piece)
{
    sp_faces *faces = measure->faces;
    if (measure->used + (size_t)piece->count > measure->room) {
        size_t room = 2 * measure->room + SP_PIECE_POINTS;
        void *more = realloc(faces->corners, room * sizeof *faces->corners);
        measure->failed = !more;
        if (!more)
            return;
        faces->corners = more;
        measure->room = room;
    }
    memcpy(faces->corners + measure->used, piece->at, (size_t)piece->count * sizeof *piece->at);
    faces->corner_start[cell] = measure->used;
    faces->corner_count[cell] = (uint8_t)piece->count;
    measure->used += (size_t)piece->count;
}

static void measure_cell(void *user, uint32_t cell, const sp_triangle_piece *part)
{
    cell_measure *measure = user;
    double share = area_of_piece(part);
    measure->faces->area[measure->faces->mesh->triangle_count + cell] += share * measure->triangle_area;
    if (share > measure->largest[cell] && !measure->failed) {
        measure->largest[cell] = share;
        keep_corners(measure, cell, part);
    }
}

static bool draw_cells(sp_faces *faces, sp_error *error)
{
    const sp_cuts *cuts = faces->cuts;
    cell_measure measure = {.faces = faces, .largest = calloc(cuts->cell_count + 1, sizeof *measure.largest)};
    measure.failed = !measure.largest;
    for (uint32_t t = 0; !measure.failed && t < faces->mesh->triangle_count; t++) {
        measure.triangle_area = sp_triangle_area(faces->mesh, t);
        const sp_triangle_piece whole = {.count = 3, .at = {{0, 0}, {1, 0}, {0, 1}}};
        if (cuts->root[t] == SP_NONE)
            faces->area[t] = measure.triangle_area;
        else
            sp_cuts_split(cuts, t, &whole, measure_cell, &measure);
    }
    free(measure.largest);
    return !measure.failed || sp_fail_memory(error);
}

uint32_t sp_face_triangle(const sp_faces *faces, uint32_t face)
{
    size_t triangles = faces->mesh->triangle_count;
    return face < triangles ? face : faces->cuts->cell_triangle[face - triangles];
}

uint32_t sp_face_at(const sp_faces *faces, uint32_t triangle, double u, double v, bool *near)
{
    *near = false;
    if (faces->cuts->root[triangle] == SP_NONE)
        return triangle;
    return (uint32_t)faces->mesh->triangle_count + sp_cuts_cell(faces->cuts, triangle, u, v, near);
}

/* The corners of a face; false where a cell has no area. */
static bool face_corners(const sp_faces *faces, uint32_t face, const double (**corners)[2], int *count)
{
    static const double whole[3][2] = {{0, 0}, {1, 0}, {0, 1}};
    size_t triangles = faces->mesh->triangle_count;
    *corners = whole;
    *count = 3;
    if (face >= triangles) {
        size_t cell = face - triangles;
        *corners = (const double(*)[2])(faces->corners + faces->corner_start[cell]);
        *count = faces->corner_count[cell];
    }
    return *count >= 3;
}

static double fan_area(const double (*corners)[2], int i)
{
    double ax = corners[i - 1][0] - corners[0][0], ay = corners[i - 1][1] - corners[0][1];
    double bx = corners[i][0] - corners[0][0], by = corners[i][1] - corners[0][1];
    return fabs(ax * by - ay * bx);
}

static void face_middle(const double (*corners)[2], int count, double middle[2])
{
    double sum = 0;
    middle[0] = middle[1] = 0;
    for (int i = 2; i < count; i++) {
        double part = fan_area(corners, i);
        sum += part;
        for (int k = 0; k < 2; k++)
            middle[k] += part / 3 * (corners[0][k] + corners[i - 1][k] + corners[i][k]);
    }
    for (int k = 0; k < 2; k++)
        middle[k] = sum > 0 ? middle[k] / sum : corners[0][k];
}

sp_vec3 sp_face_point(const sp_faces *faces, uint32_t face, double first, double second)
{
    const double(*corners)[2];
    int count;
    double middle[2], all = 0, at[2];
    face_corners(faces, face, &corners, &count);
    face_middle(corners, count, middle);
    for (int i = 2; i < count; i++)
        all += fan_area(corners, i);
    int chosen = 2;
    double rest = first * all;
    while (chosen < count - 1 && rest > fan_area(corners, chosen))
        rest -= fan_area(corners, chosen++);
    double part = fan_area(corners, chosen), root = sqrt(part > 0 ? fmin(1, rest / part) : 0);
    for (int k = 0; k < 2; k++) {
        at[k] =
            (1 - root) * corners[0][k] + root * ((1 - second) * corners[chosen - 1][k] + second * corners[chosen][k]);
        at[k] += OFF_EDGES * (middle[k] - at[k]);
    }
    return sp_triangle_point(faces->mesh, sp_face_triangle(faces, face), at[0], at[1]);
}

/* Whether triangle a stands for what lies on each other rather than b. */
static bool goes_before(const sp_shells *shells, uint32_t a, uint32_t b)
{
    bool solid_a = shells->closed[shells->of[a]], solid_b = shells->closed[shells->of[b]];
    return solid_a != solid_b ? solid_b : a < b;
}

typedef struct {
    sp_faces *faces;
    const sp_shells *shells;
    const sp_winding *solids;
    int base;
} face_judge;

static void judge(const face_judge *judge, uint32_t face)
{
    sp_faces *faces = judge->faces;
    const sp_mesh *mesh = faces->mesh;
    const double(*corners)[2];
    int count;
    uint8_t *state = &faces->state[2 * (size_t)face];
    uint32_t triangle = sp_face_triangle(faces, face), shell = judge->shells->of[triangle], first = triangle;
    state[0] = state[1] = SP_FACE_NONE;
    if ((face < mesh->triangle_count && faces->cuts->root[face] != SP_NONE) ||
        !face_corners(faces, face, &corners, &count))
        return;
    double middle[2], weights[2], at[2];
    face_middle(corners, count, middle);
    sp_vec3 point = sp_triangle_point(mesh, triangle, middle[0], middle[1]),
            normal = sp_triangle_normal(mesh, triangle);
    bool touches = false;
    for (uint32_t i = faces->cuts->cover_start[triangle]; i < faces->cuts->cover_start[triangle + 1]; i++) {
        uint32_t other = faces->cuts->covers[i];
        if (!sp_triangle_weights(mesh, other, point, &at[0], &at[1]))
            continue;
        touches = true;
        if (goes_before(judge->shells, other, first)) {
            first = other;
            memcpy(weights, at, sizeof at);
        }
    }
    if (first != triangle) {
        bool near, turned = sp_dot(sp_triangle_normal(mesh, first), normal) < 0;
        uint32_t stands = sp_face_at(faces, first, weights[0], weights[1], &near);
        for (uint32_t side = 0; side < 2; side++) {
            state[side] = SP_FACE_TOUCHING;
            faces->stands_for[2 * (size_t)face + side] = 2 * stands + (side ^ turned);
        }
        return;
    }
    for (int side = 0; side < 2; side++) {
        double way = side ? -BEYOND : BEYOND;
        sp_vec3 beyond = sp_along(point, way * faces->cuts->contact, normal);
        bool own = judge->shells->closed[shell] && (judge->shells->turn[shell] > 0) == (side == 1);
        bool material = judge->solids && sp_winding_at(judge->solids, beyond) + judge->base > 0;
        state[side] = !material ? SP_FACE_FREE : own ? SP_FACE_OWN : touches ? SP_FACE_TOUCHING : SP_FACE_INSIDE;
    }
}

bool sp_faces_create(sp_faces *faces, const sp_mesh *mesh, const sp_shells *shells, const sp_cuts *cuts,
                     const sp_winding *solids, int base, int threads, sp_error *error)
{
    size_t count = mesh->triangle_count + cuts->cell_count;
    *faces = (sp_faces){.mesh = mesh, .cuts = cuts, .count = count};
    if (count > SP_NONE / 2 - 1)
        return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0, "geometry: bodies cut each other into %zu pieces, too many",
                       count);
    faces->area = calloc(count + 1, sizeof *faces->area);
    faces->corner_start = calloc(cuts->cell_count + 1, sizeof *faces->corner_start);
    faces->corner_count = calloc(cuts->cell_count + 1, sizeof *faces->corner_count);
    faces->state = malloc(2 * count + 1);
    faces->stands_for = malloc((2 * count + 1) * sizeof *faces->stands_for);
    bool done = faces->area && faces->corner_start && faces->corner_count && faces->state && faces->stands_for;
    if (!done)
        sp_fail_memory(error);
    done = done && draw_cells(faces, error);
    face_judge all = {faces, shells, solids, base};
    if (done) {
        memset(faces->stands_for, 0xff, 2 * count * sizeof *faces->stands_for);
#pragma omp parallel for schedule(dynamic, 1024) num_threads(sp_thread_count(threads))
        for (size_t face = 0; face < count; face++)
            judge(&all, (uint32_t)face);
        return true;
    }
    sp_faces_destroy(faces);
    return false;
}

void sp_faces_destroy(sp_faces *faces)
{
    free(faces->area);
    free(faces->corner_start);
    free(faces->corner_count);
    free(faces->corners);
    free(faces->state);
    free(faces->stands_for);
    *faces = (sp_faces){0};
}
