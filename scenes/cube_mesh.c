/* Writes a cube of 1,200 triangles, 1 m long, each side 10 × 10 squares: the cube of the 2008 study's measurements. */
#include <stdio.h>

enum { CELLS = 10 };

/* Side `side` of the cube: its axis and whether it is the far one; corner (i, j) of its squares. */
static void print_vertex(FILE *file, int side, int i, int j)
{
    double p[3];
    p[side / 2] = side % 2;
    p[(side / 2 + 1) % 3] = (double)i / CELLS;
    p[(side / 2 + 2) % 3] = (double)j / CELLS;
    fprintf(file, "v %.17g %.17g %.17g\n", p[0], p[1], p[2]);
}

static void print_square(FILE *file, int side, int i, int j)
{
    int a = side * (CELLS + 1) * (CELLS + 1) + i * (CELLS + 1) + j + 1, b = a + CELLS + 1;
    if (side % 2)
        fprintf(file, "f %d %d %d\nf %d %d %d\n", a, b, b + 1, a, b + 1, a + 1);
    else
        fprintf(file, "f %d %d %d\nf %d %d %d\n", a, b + 1, b, a, a + 1, b + 1);
}

int main(int count, char **arguments)
{
    if (count != 2) {
        fprintf(stderr, "usage: cube_mesh OUT.obj\n");
        return 2;
    }
    FILE *file = fopen(arguments[1], "w");
    if (!file) {
        perror(arguments[1]);
        return 1;
    }
    for (int side = 0; side < 6; side++)
        for (int i = 0; i <= CELLS; i++)
            for (int j = 0; j <= CELLS; j++)
                print_vertex(file, side, i, j);
    for (int side = 0; side < 6; side++)
        for (int i = 0; i < CELLS; i++)
            for (int j = 0; j < CELLS; j++)
                print_square(file, side, i, j);
    int bad = ferror(file);
    if (fclose(file) || bad) {
        perror(arguments[1]);
        return 1;
    }
    return 0;
}
