/* Writes a hall of 20 x 12 x 5 m, fronts inside, with twelve machines on its floor, as OBJ in metres, z up: for
 * measuring how placement grows with the size of the room. */
#include <stdio.h>

typedef struct {
    double low[3], high[3];
} box;

enum { CORNERS = 8, COLUMNS = 4, ROWS = 3 };

static const box hall = {{-10, -6, 0}, {10, 6, 5}};
static const double pitch_x = 4.6, pitch_y = 3.6, length = 2.4, width = 1.4, height = 1.6, hood = 0.5;

/* Corner i has bit 0 along x, bit 1 along y, bit 2 along z; faces seen from outside. */
static const int faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};

/* The faces first to end; from inside, turned over. */
static int print_box(FILE *file, const box *b, int before, int first, int end, int inside)
{
    for (int i = 0; i < CORNERS; i++)
        fprintf(file, "v %g %g %g\n", i & 1 ? b->high[0] : b->low[0], i & 2 ? b->high[1] : b->low[1],
                i & 4 ? b->high[2] : b->low[2]);
    for (int f = first; f < end; f++) {
        fprintf(file, "f");
        for (int k = 0; k < 4; k++)
            fprintf(file, " %d", before + 1 + faces[f][inside ? 3 - k : k]);
        fprintf(file, "\n");
    }
    return before + CORNERS;
}

/* A machine stands clear of the floor, and carries a hood that is half as wide. */
static int print_machine(FILE *file, double x, double y, int before)
{
    const box body = {{x - length / 2, y - width / 2, 0.3}, {x + length / 2, y + width / 2, height}};
    const box top = {{x - length / 4, y - width / 4, height + 0.3},
                     {x + length / 4, y + width / 4, height + 0.3 + hood}};
    before = print_box(file, &body, before, 0, 6, 0);
    return print_box(file, &top, before, 0, 6, 0);
}

int main(int count, char **arguments)
{
    FILE *file = count == 2 ? fopen(arguments[1], "w") : NULL;
    if (!file) {
        fprintf(stderr, "usage: hall FILE.obj\n");
        return 2;
    }
    fprintf(file, "o walls\n");
    int before = print_box(file, &hall, 0, 0, 6, 1);
    for (int i = 0; i < COLUMNS * ROWS; i++) {
        fprintf(file, "o machine_%d\n", i + 1);
        before = print_machine(file, (i % COLUMNS - (COLUMNS - 1) / 2.0) * pitch_x,
                               (i / COLUMNS - (ROWS - 1) / 2.0) * pitch_y, before);
    }
    return fclose(file) != 0;
}
