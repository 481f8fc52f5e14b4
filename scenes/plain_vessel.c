/* Writes a plain vessel without anything in it: 1.2 m wide, 1.46 m between the tangent lines, Klöpper heads (DIN 28011)
 * and an outlet of 100 mm, as one sheet whose front is inside. Millimetres, z up, bottom tangent line at z = 0. */
#include <math.h>
#include <stdio.h>

#define PI 3.14159265358979323846

enum { SEGMENTS = 96, DOME = 16, KNUCKLE = 12, ROWS = 36, HEAD = DOME + KNUCKLE, RINGS = 2 * HEAD + ROWS };

static const double RADIUS = 600, CROWN = 1200, KNUCKLE_RADIUS = 120, HEIGHT = 1460, OUTLET = 50;

/* Point `i` of HEAD on a head's meridian, from a circle of radius `start` around its apex down to the tangent line: the
 * radius there, and how far it stands off the tangent line. */
static void head_point(double start, int i, double *r, double *off)
{
    double joint = asin((RADIUS - KNUCKLE_RADIUS) / (CROWN - KNUCKLE_RADIUS));
    if (i <= DOME) {
        double first = asin(start / CROWN), angle = first + (joint - first) * i / DOME;
        *r = CROWN * sin(angle);
        *off = CROWN * cos(angle) - (CROWN - KNUCKLE_RADIUS) * cos(joint);
        return;
    }
    double angle = joint + (PI / 2 - joint) * (i - DOME) / KNUCKLE;
    *r = RADIUS - KNUCKLE_RADIUS + KNUCKLE_RADIUS * sin(angle);
    *off = KNUCKLE_RADIUS * cos(angle);
}

/* Ring `i` of RINGS, from the outlet up; the last one is the apex. */
static void ring_point(int i, double *r, double *z)
{
    double off;
    if (i <= HEAD) {
        head_point(OUTLET, i, r, &off);
        *z = -off;
    } else if (i <= HEAD + ROWS) {
        *r = RADIUS;
        *z = HEIGHT * (i - HEAD) / ROWS;
    } else {
        head_point(0, RINGS - i, r, &off);
        *z = HEIGHT + off;
    }
}

static void print_strip(FILE *file, int ring)
{
    for (int k = 0; k < SEGMENTS; k++) {
        int a = ring * SEGMENTS + k + 1, b = ring * SEGMENTS + (k + 1) % SEGMENTS + 1;
        if (ring + 1 < RINGS)
            fprintf(file, "f %d %d %d %d\n", a, a + SEGMENTS, b + SEGMENTS, b);
        else
            fprintf(file, "f %d %d %d\n", a, RINGS * SEGMENTS + 1, b);
    }
}

static void print_vessel(FILE *file)
{
    for (int i = 0; i <= RINGS; i++) {
        double r, z;
        ring_point(i, &r, &z);
        for (int k = 0; k < (i < RINGS ? SEGMENTS : 1); k++)
            fprintf(file, "v %.7g %.7g %.7g\n", r * cos(2 * PI * k / SEGMENTS), r * sin(2 * PI * k / SEGMENTS), z);
    }
    for (int i = 0; i < RINGS; i++) {
        if (i == 0)
            fprintf(file, "g bottom_head\n");
        else if (i == HEAD)
            fprintf(file, "g shell\n");
        else if (i == HEAD + ROWS)
            fprintf(file, "g top_head\n");
        print_strip(file, i);
    }
}

int main(int count, char **arguments)
{
    if (count != 2) {
        fprintf(stderr, "usage: plain_vessel OUT.obj\n");
        return 2;
    }
    FILE *file = fopen(arguments[1], "w");
    if (!file) {
        perror(arguments[1]);
        return 1;
    }
    print_vessel(file);
    int bad = ferror(file);
    if (fclose(file) || bad) {
        perror(arguments[1]);
        return 1;
    }
    return 0;
}
