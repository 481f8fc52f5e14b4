#include "spray/wet/stretches.h"

#include <stdlib.h>
#include <string.h>

#define DIRECTIONS 8 /* of lines that are tried, each along one of the stretches */

sp_cut sp_cut_through(const sp_mesh *mesh, uint32_t triangle, sp_vec3 p, sp_vec3 q)
{
    const uint32_t *corner = mesh->triangles[triangle];
    sp_vec3 a = mesh->vertices[corner[0]];
    sp_vec3 across = sp_unit(sp_cross(sp_triangle_normal(mesh, triangle), sp_sub(q, p)));
    return (sp_cut){.a = sp_dot(across, sp_sub(mesh->vertices[corner[1]], a)),
                    .b = sp_dot(across, sp_sub(mesh->vertices[corner[2]], a)),
                    .c = sp_dot(across, sp_sub(a, p))};
}

static sp_vec3 point_at(const sp_mesh *mesh, uint32_t triangle, const double at[2])
{
    return sp_triangle_point(mesh, triangle, at[0], at[1]);
}

double sp_stretch_length(const sp_mesh *mesh, uint32_t triangle, const sp_stretch *part)
{
    return sp_distance(point_at(mesh, triangle, part->from), point_at(mesh, triangle, part->to));
}

bool sp_stretch_clip(sp_stretch *part, const sp_cut *line, int way, double contact)
{
    double from = way * sp_cut_distance(line, part->from), to = way * sp_cut_distance(line, part->to);
    if (!(fmax(from, to) > contact))
        return false;
    if (fmin(from, to) >= 0)
        return true;
    double share = from / (from - to), at[2];
    for (int i = 0; i < 2; i++)
        at[i] = part->from[i] + share * (part->to[i] - part->from[i]);
    memcpy(from < to ? part->from : part->to, at, sizeof at);
    return true;
}

static int by_value(const void *left, const void *right)
{
    double p = *(const double *)left, q = *(const double *)right;
    return (p > q) - (p < q);
}

/* Moves a line to the middle one of the stretches' middles. */
static void move_to_middle(sp_cut *line, const sp_stretch *parts, size_t count, double *places)
{
    for (size_t i = 0; i < count; i++)
        places[i] =
            0.5 * (line->a * (parts[i].from[0] + parts[i].to[0]) + line->b * (parts[i].from[1] + parts[i].to[1]));
    qsort(places, count, sizeof *places, by_value);
    line->c = -places[count / 2];
}

static size_t fuller_side(const sp_cut *line, const sp_stretch *parts, size_t count, double contact)
{
    size_t sides[2] = {0, 0};
    for (size_t i = 0; i < count; i++)
        for (int side = 0; side < 2; side++) {
            sp_stretch part = parts[i];
            sides[side] += sp_stretch_clip(&part, line, side ? 1 : -1, contact);
        }
    return sides[0] > sides[1] ? sides[0] : sides[1];
}

size_t sp_stretches_halve(const sp_mesh *mesh, uint32_t triangle, const sp_stretch *parts, size_t count, double contact,
                          double *places, sp_cut *line)
{
    size_t least = SIZE_MAX;
    for (size_t i = 0; i < DIRECTIONS; i++) {
        const sp_stretch *along = &parts[i * count / DIRECTIONS];
        sp_cut tried =
            sp_cut_through(mesh, triangle, point_at(mesh, triangle, along->from), point_at(mesh, triangle, along->to));
        move_to_middle(&tried, parts, count, places);
        size_t fuller = fuller_side(&tried, parts, count, contact);
        if (fuller < least) {
            least = fuller;
            *line = tried;
        }
    }
    return least;
}
