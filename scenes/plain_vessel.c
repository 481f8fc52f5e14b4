/* Writes a plain vessel without anything in it: 1.2 m wide, 1.46 m between the tangent lines, Klöpper heads (DIN 28011)
 * and an outlet of 100 mm, as one sheet whose front is inside. Millimetres, z up, bottom tangent line at z = 0. The
 * second argument makes every facet so many times as short and as narrow. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define PI 3.14159265358979323846

/* How many facets there are around it, and up its parts. */
typedef struct {
    int segments, dome, head, rows, rings;
} facets;

static const double RADIUS = 600, CROWN = 1200, KNUCKLE_RADIUS = 120, HEIGHT = 1460, OUTLET = 50;

static facets cut(int fine)
{
    facets f = {.segments = 96 * fine, .dome = 16 * fine, .head = 28 * fine, .rows = 36 * fine};
    f.rings = 2 * f.head + f.rows;
    return f;
}

/* Point `i` of f->head on a head's meridian, from a circle of radius `start` around its apex down to the tangent line:
 * the radius there, and how far it stands off the tangent line. */
static void head_point(const facets *f, double start, int i, double *r, double *off)
{
    double joint = asin((RADIUS - KNUCKLE_RADIUS) / (CROWN - KNUCKLE_RADIUS));
    if (i <= f->dome) {
        double first = asin(start / CROWN), angle = first + (joint - first) * i / f->dome;
        *r = CROWN * sin(angle);
        *off = CROWN * cos(angle) - (CROWN - KNUCKLE_RADIUS) * cos(joint);
        return;
    }
    double angle = joint + (PI / 2 - joint) * (i - f->dome) / (f->head - f->dome);
    *r = RADIUS - KNUCKLE_RADIUS + KNUCKLE_RADIUS * sin(angle);
    *off = KNUCKLE_RADIUS * cos(angle);
}

/* Ring `i` of f->rings, from the outlet up; the last one is the apex. */
static void ring_point(const facets *f, int i, double *r, double *z)
{
    double off;
    if (i <= f->head) {
        head_point(f, OUTLET, i, r, &off);
        *z = -off;
    } else if (i <= f->head + f->rows) {
        *r = RADIUS;
        *z = HEIGHT * (i - f->head) / f->rows;
    } else {
        head_point(f, 0, f->rings - i, r, &off);
        *z = HEIGHT + off;
    }
}

static void print_strip(const facets *f, FILE *file, int ring)
{
    int around = f->segments;
    for (int k = 0; k < around; k++) {
        int a = ring * around + k + 1, b = ring * around + (k + 1) % around + 1;
        if (ring + 1 < f->rings)
            fprintf(file, "f %d %d %d %d\n", a, a + around, b + around, b);
        else
            fprintf(file, "f %d %d %d\n", a, f->rings * around + 1, b);
    }
}

static void print_vessel(const facets *f, FILE *file)
{
    for (int i = 0; i <= f->rings; i++) {
        double r, z;
        ring_point(f, i, &r, &z);
        for (int k = 0; k < (i < f->rings ? f->segments : 1); k++)
            fprintf(file, "v %.7g %.7g %.7g\n", r * cos(2 * PI * k / f->segments), r * sin(2 * PI * k / f->segments),
                    z);
    }
    for (int i = 0; i < f->rings; i++) {
        if (i == 0)
            fprintf(file, "g bottom_head\n");
        else if (i == f->head)
            fprintf(file, "g shell\n");
        else if (i == f->head + f->rows)
            fprintf(file, "g top_head\n");
        print_strip(f, file, i);
    }
}

int main(int count, char **arguments)
{
    int fine = count > 2 ? atoi(arguments[2]) : 1;
    if (count < 2 || count > 3 || fine < 1 || fine > 100) {
        fprintf(stderr, "usage: plain_vessel OUT.obj [FINENESS]\n");
        return 2;
    }
    FILE *file = fopen(arguments[1], "w");
    if (!file) {
        perror(arguments[1]);
        return 1;
    }
    const facets f = cut(fine);
    print_vessel(&f, file);
    int bad = ferror(file);
    if (fclose(file) || bad) {
        perror(arguments[1]);
        return 1;
    }
    return 0;
}
