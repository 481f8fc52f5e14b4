/* A line against a triangle, watertight: Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection", JCGT 2013, in double
 * precision. Triangles that share an edge decide it by the same operations, so that nothing slips between them. */
#ifndef TRACE_LINE_H
#define TRACE_LINE_H

#include <sprayplan/trace.h>

#include <stdint.h>

/* What depends on the line alone: the axis it follows most, and the shear that lays it along z. */
typedef struct {
    int kx, ky, kz;
    double sx, sy, sz;
} line_shear;

static inline line_shear line_prepare(const double velocity[3])
{
    int kz = 0;
    for (int axis = 1; axis < 3; axis++)
        if (fabs(velocity[axis]) > fabs(velocity[kz]))
            kz = axis;
    int kx = (kz + 1) % 3, ky = (kz + 2) % 3;
    return (line_shear){kx, ky, kz, velocity[kx] / velocity[kz], velocity[ky] / velocity[kz], 1 / velocity[kz]};
}

static inline bool line_triangle(const line_shear *line, const double origin[3], const double corners[3][3], double *t,
                                 double *u, double *v)
{
    double x[3], y[3], z[3];
    for (int i = 0; i < 3; i++) {
        z[i] = corners[i][line->kz] - origin[line->kz];
        x[i] = corners[i][line->kx] - origin[line->kx] - line->sx * z[i];
        y[i] = corners[i][line->ky] - origin[line->ky] - line->sy * z[i];
    }
    double a = x[2] * y[1] - y[2] * x[1];
    double b = x[0] * y[2] - y[0] * x[2];
    double c = x[1] * y[0] - y[1] * x[0];
    if ((a < 0 || b < 0 || c < 0) && (a > 0 || b > 0 || c > 0))
        return false;
    double sum = a + b + c;
    if (sum == 0)
        return false;
    *t = line->sz * ((a * z[0] + b * z[1] + c * z[2]) / sum);
    *u = b / sum;
    *v = c / sum;
    return true;
}

#endif
