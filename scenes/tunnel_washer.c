/* Writes the parts of a tunnel washer for crates, in millimetres, z up, the belt running along x: `walls` (of the
 * tunnel, fronts inside, open at both ends, and the rails under the belt), `belt` (a stretch of rods that goes with a
 * crate) and `crate` (600 x 400 x 300, 12 thick, open at the top, with a rib along each side). */
#include <stdio.h>
#include <string.h>

typedef struct {
    double low[3], high[3];
} box;

enum { CORNERS = 8, RODS = 15 };

static const box tunnel = {{-800, -450, -350}, {800, 450, 750}};
static const box rails[] = {{{-800, -160, -60}, {800, -140, -20}}, {{-800, 140, -60}, {800, 160, -20}}};
static const double rod = 8, pitch = 60, rod_top = -4, belt_width = 500;
static const double length = 600, width = 400, height = 300, wall = 12, rib = 20, rib_at = 200;

/* Corner i has bit 0 along x, bit 1 along y, bit 2 along z; faces seen from outside. */
static const int faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};

static int print_corners(FILE *file, const box *b, int before)
{
    for (int i = 0; i < CORNERS; i++)
        fprintf(file, "v %g %g %g\n", i & 1 ? b->high[0] : b->low[0], i & 2 ? b->high[1] : b->low[1],
                i & 4 ? b->high[2] : b->low[2]);
    return before + CORNERS;
}

/* The faces first to end, of the box whose corners are the first after so many; from inside, turned over. */
static void print_faces(FILE *file, int before, int first, int end, int inside)
{
    for (int f = first; f < end; f++) {
        fprintf(file, "f");
        for (int k = 0; k < 4; k++)
            fprintf(file, " %d", before + 1 + faces[f][inside ? 3 - k : k]);
        fprintf(file, "\n");
    }
}

static int print_box(FILE *file, const box *b, int before)
{
    print_corners(file, b, before);
    print_faces(file, before, 0, 6, 0);
    return before + CORNERS;
}

static void print_tunnel(FILE *file)
{
    fprintf(file, "o walls\n");
    int before = print_corners(file, &tunnel, 0);
    print_faces(file, 0, 2, 6, 1);
    fprintf(file, "o rails\n");
    for (int i = 0; i < 2; i++)
        before = print_box(file, &rails[i], before);
}

static void print_belt(FILE *file)
{
    int before = 0;
    fprintf(file, "o rods\n");
    for (int i = 0; i < RODS; i++) {
        double x = (i - RODS / 2) * pitch;
        box b = {{x - rod / 2, -belt_width / 2, rod_top - rod}, {x + rod / 2, belt_width / 2, rod_top}};
        before = print_box(file, &b, before);
    }
}

static void print_crate(FILE *file)
{
    const box outer = {{-length / 2, -width / 2, 0}, {length / 2, width / 2, height}};
    const box inner = {{-length / 2 + wall, -width / 2 + wall, wall}, {length / 2 - wall, width / 2 - wall, height}};
    fprintf(file, "o outside\n");
    int before = print_corners(file, &outer, 0);
    print_faces(file, 0, 0, 5, 0);
    fprintf(file, "o inside\n");
    before = print_corners(file, &inner, before);
    print_faces(file, CORNERS, 0, 5, 1);
    fprintf(file, "o rim\n");
    static const int around[4] = {4, 5, 7, 6};
    for (int k = 0; k < 4; k++)
        fprintf(file, "f %d %d %d %d\n", around[k] + 1, around[(k + 1) % 4] + 1, around[(k + 1) % 4] + CORNERS + 1,
                around[k] + CORNERS + 1);
    fprintf(file, "o ribs\n");
    for (int side = -1; side <= 1; side += 2) {
        double near = side * width / 2, far = side * (width / 2 + rib);
        box b = {{-length / 2, near < far ? near : far, rib_at}, {length / 2, near < far ? far : near, rib_at + rib}};
        before = print_box(file, &b, before);
    }
}

int main(int count, char **arguments)
{
    static const char *const names[] = {"walls", "belt", "crate"};
    static void (*const print[])(FILE *) = {print_tunnel, print_belt, print_crate};
    for (int i = 0; count == 3 && i < 3; i++) {
        if (strcmp(arguments[1], names[i]) != 0)
            continue;
        FILE *file = fopen(arguments[2], "w");
        if (!file)
            break;
        print[i](file);
        return fclose(file) != 0;
    }
    fprintf(stderr, "usage: tunnel_washer walls|belt|crate FILE.obj\n");
    return 2;
}
