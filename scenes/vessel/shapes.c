#include "shapes.h"

sp_vec3 circle_corner(const circle *circle, int corner, double z)
{
    double angle = 2 * M_PI * (corner % circle->segments) / circle->segments;
    return sp_v(circle->x + circle->r * cos(angle), circle->y + circle->r * sin(angle), z);
}

static void turn_strip(model *model, const circle *from, double from_z, const circle *to, double to_z)
{
    for (int i = 0; i < from->segments; ++i) {
        sp_vec3 corners[4] = {circle_corner(from, i, from_z), circle_corner(from, i + 1, from_z),
                              circle_corner(to, i + 1, to_z), circle_corner(to, i, to_z)};
        model_face(model, corners, 4);
    }
}

void turn(model *model, double x, double y, int segments, const double (*profile)[2], int count, double step)
{
    for (int i = 0; i + 1 < count; ++i) {
        const double *a = profile[i], *b = profile[i + 1];
        int pieces = (int)ceil(hypot(b[0] - a[0], b[1] - a[1]) / step - 1e-9);
        for (int j = 0; j < pieces; ++j) {
            double s = (double)j / pieces, t = (double)(j + 1) / pieces;
            circle from = {x, y, a[0] + s * (b[0] - a[0]), segments}, to = {x, y, a[0] + t * (b[0] - a[0]), segments};
            turn_strip(model, &from, a[1] + s * (b[1] - a[1]), &to, a[1] + t * (b[1] - a[1]));
        }
    }
}

void pipe_to_head(model *model, const head *head, const circle *circle, double z, bool inward)
{
    enum { ROWS = 3 };
    for (int i = 0; i < circle->segments; ++i) {
        sp_vec3 a = circle_corner(circle, i, 0), b = circle_corner(circle, i + 1, 0);
        double a_z = head_z(head, hypot(a.x, a.y)), b_z = head_z(head, hypot(b.x, b.y));
        for (int row = 0; row < ROWS; ++row) {
            double s = (double)row / ROWS, t = (double)(row + 1) / ROWS;
            sp_vec3 corners[4] = {sp_v(a.x, a.y, a_z + s * (z - a_z)), sp_v(b.x, b.y, b_z + s * (z - b_z)),
                                  sp_v(b.x, b.y, b_z + t * (z - b_z)), sp_v(a.x, a.y, a_z + t * (z - a_z))};
            sp_vec3 turned[4] = {corners[3], corners[2], corners[1], corners[0]};
            model_face(model, (z > a_z) == inward ? turned : corners, 4);
        }
    }
}

static sp_vec3 plate_point(const plate *plate, const double outline[2], double side)
{
    sp_vec3 normal = sp_unit(sp_cross(plate->u, plate->v));
    sp_vec3 p = sp_along(sp_along(plate->origin, outline[0], plate->u), outline[1], plate->v);
    return sp_along(p, side * plate->thickness / 2, normal);
}

void cut_plate(model *model, const plate *plate, const double (*outline)[2], int count, const int (*quads)[4],
               int quad_count)
{
    for (int i = 0; i < quad_count; ++i) {
        sp_vec3 front[4], back[4];
        for (int j = 0; j < 4; ++j) {
            front[j] = plate_point(plate, outline[quads[i][j]], 1);
            back[3 - j] = plate_point(plate, outline[quads[i][j]], -1);
        }
        model_face(model, front, 4);
        model_face(model, back, 4);
    }
    for (int i = 0; i < count; ++i) {
        const double *a = outline[i], *b = outline[(i + 1) % count];
        sp_vec3 edge[4] = {plate_point(plate, a, -1), plate_point(plate, b, -1), plate_point(plate, b, 1),
                           plate_point(plate, a, 1)};
        model_face(model, edge, 4);
    }
}

void cut_rectangle(model *model, const plate *plate, double u0, double v0, double u1, double v1)
{
    const double outline[4][2] = {{u0, v0}, {u1, v0}, {u1, v1}, {u0, v1}};
    const int quads[1][4] = {{0, 1, 2, 3}};
    cut_plate(model, plate, outline, 4, quads, 1);
}

void sheet(model *model, sp_vec3 origin, sp_vec3 u, sp_vec3 v, int columns, int rows)
{
    for (int i = 0; i < columns; ++i)
        for (int j = 0; j < rows; ++j) {
            sp_vec3 a = sp_along(origin, (double)i / columns, u), b = sp_along(origin, (double)(i + 1) / columns, u);
            double s = (double)j / rows, t = (double)(j + 1) / rows;
            sp_vec3 corners[4] = {sp_along(a, s, v), sp_along(b, s, v), sp_along(b, t, v), sp_along(a, t, v)};
            model_face(model, corners, 4);
        }
}
