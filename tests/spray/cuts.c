/* Triangles that very many others cross: the tree of their cuts stays low whatever the lines' order and places, and
 * every line parts cells. */
#include "nozzle/scramble.h"
#include "spray/wet/cuts.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#ifdef SPRAYPLAN_SANITIZE
enum { LINES = 1000 };
#else
enum { LINES = 4000 };
#endif
enum { PAGES = 200 }; /* more than are cut along one by one */
#define LOW 220       /* levels that no tree has; one line after the other, each of them has a thousand at least */

typedef struct {
    sp_vec3 (*points)[3];
    size_t count;
} triangles;

static void add(triangles *list, sp_vec3 a, sp_vec3 b, sp_vec3 c)
{
    const sp_vec3 triangle[3] = {a, b, c};
    memcpy(list->points[list->count++], triangle, sizeof triangle);
}

/* The one that is crossed, x and y from -1 on, comes first. */
static triangles big(void)
{
    triangles list = {.points = malloc((2 * LINES + 1) * sizeof *list.points)};
    assert_non_null(list.points);
    add(&list, sp_v(-1, -1, 0), sp_v(3, -1, 0), sp_v(-1, 3, 0));
    return list;
}

static unsigned order_of(size_t pair)
{
    return (unsigned)(sp_scramble(2 * pair * 0x9e3779b97f4a7c15u) >> 32);
}

static int by_order(const void *left, const void *right)
{
    unsigned p = order_of(*(const size_t *)left), q = order_of(*(const size_t *)right);
    return p < q ? -1 : p > q;
}

/* Where the i-th line has to stand so that lines come from one end to the other, as they are shuffled. */
static size_t *ranks(void)
{
    size_t *sorted = malloc(LINES * sizeof *sorted), *rank = malloc(LINES * sizeof *rank);
    assert_true(sorted && rank);
    for (size_t i = 0; i < LINES; i++)
        sorted[i] = i;
    qsort(sorted, LINES, sizeof *sorted, by_order);
    for (size_t i = 0; i < LINES; i++)
        rank[sorted[i]] = i;
    free(sorted);
    return rank;
}

static double along(size_t i, size_t count)
{
    return -0.8 + 0.8 * ((double)i + 0.5) / (double)count;
}

static triangles slices(void)
{
    triangles list = big();
    size_t *rank = ranks();
    for (size_t i = 0; i < LINES; i++) {
        double x = along(rank[i], LINES);
        add(&list, sp_v(x, -0.5, -0.1), sp_v(x, 0.5, -0.1), sp_v(x, 0, 0.3));
    }
    free(rank);
    return list;
}

static sp_vec3 around(double turns, double radius, double z)
{
    return sp_v(radius * cos(2 * M_PI * turns), radius * sin(2 * M_PI * turns), z);
}

static triangles prism(void)
{
    triangles list = big();
    for (size_t i = 0; i < LINES; i++) {
        double a = (double)i / LINES, b = (double)(i + 1) / LINES;
        add(&list, around(a, 0.6, -0.1), around(b, 0.6, -0.1), around(b, 0.6, 0.3));
        add(&list, around(a, 0.6, -0.1), around(b, 0.6, 0.3), around(a, 0.6, 0.3));
    }
    return list;
}

/* All lines through one point. */
static triangles star(void)
{
    triangles list = big();
    size_t *rank = ranks();
    for (size_t i = 0; i < LINES / 4; i++) {
        double turns = 0.5 * (double)rank[i] / LINES;
        add(&list, around(turns, 0.6, -0.1), around(turns + 0.5, 0.6, -0.1), sp_v(0, 0, 0.9));
    }
    free(rank);
    return list;
}

/* Pages that all hold one line, of the first that is crossed too. */
static triangles book(void)
{
    triangles list = big();
    for (size_t i = 0; i < PAGES; i++) {
        double turn = M_PI * ((double)i + 0.5) / PAGES;
        sp_vec3 out = sp_v(0.5 * cos(turn), 0, 0.5 * sin(turn));
        add(&list, sp_sub(sp_v(0.1, -0.6, 0), out), sp_sub(sp_v(0.1, 0.6, 0), out), sp_add(sp_v(0.1, 0, 0), out));
    }
    return list;
}

static int depth_below(const sp_cuts *cuts, uint32_t node)
{
    if (node & SP_CELL)
        return 0;
    int below = depth_below(cuts, cuts->cuts[node].child[0]), above = depth_below(cuts, cuts->cuts[node].child[1]);
    return 1 + (below > above ? below : above);
}

typedef struct {
    sp_mesh *mesh;
    sp_shells shells;
    sp_cuts cuts;
} cut_up;

static cut_up cut(triangles list)
{
    cut_up c = {0};
    sp_error error = {0};
    uint32_t(*corners)[3] = malloc(list.count * sizeof *corners);
    assert_non_null(corners);
    for (size_t i = 0; i < 3 * list.count; i++)
        corners[i / 3][i % 3] = (uint32_t)i;
    c.mesh = sp_mesh_create(list.points[0], 3 * list.count, (const uint32_t(*)[3])corners, list.count, NULL, NULL, 0,
                            &error);
    free(corners);
    free(list.points);
    assert_non_null(c.mesh);
    sp_setup setup = sp_setup_default();
    sp_vec3 low, high;
    setup.mesh = c.mesh;
    double diagonal = sp_mesh_box(c.mesh, &low, &high);
    assert_true(sp_shells_create(&c.shells, c.mesh, 1e-9 * diagonal, &error));
    assert_true(sp_cuts_create(&c.cuts, &setup, &c.shells, SP_CONTACT * diagonal, &error));
    return c;
}

static void destroy(cut_up *c)
{
    sp_cuts_destroy(&c->cuts);
    sp_shells_destroy(&c->shells);
    sp_mesh_destroy(c->mesh);
}

static uint32_t cell_at(const cut_up *c, double x, double y)
{
    bool near;
    return sp_cuts_cell(&c->cuts, 0, (x + 1) / 4, (y + 1) / 4, &near);
}

static void expect_low(const char *what, const cut_up *c)
{
    int depth = depth_below(&c->cuts, c->cuts.root[0]);
    print_message("%s: %d deep, %zu cells\n", what, depth, c->cuts.cell_count);
    assert_true(depth < LOW);
}

static void sum_area(void *user, uint32_t cell, const sp_triangle_piece *part)
{
    (void)cell;
    for (int i = 1; i + 1 < part->count; i++) {
        const double *a = part->at[0], *b = part->at[i], *c = part->at[i + 1];
        *(double *)user += 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
    }
}

static void expect_whole(const cut_up *c, uint32_t triangle)
{
    const sp_triangle_piece all = {.count = 3, .at = {{0, 0}, {1, 0}, {0, 1}}};
    double area = 0;
    sp_cuts_split(&c->cuts, triangle, &all, sum_area, &area);
    assert_float_equal(area, 0.5, 1e-9);
}

static void lines_in_a_chosen_order(void **state)
{
    (void)state;
    cut_up c = cut(slices());
    expect_low("slices", &c);
    expect_whole(&c, 0);
    for (size_t i = 0; i + 1 < LINES; i++) {
        double x = 0.5 * (along(i, LINES) + along(i + 1, LINES)), next = x + 0.8 / LINES;
        assert_true(cell_at(&c, x, 0.01) != cell_at(&c, next, 0.01));
    }
    destroy(&c);
}

static void a_convex_outline(void **state)
{
    (void)state;
    cut_up c = cut(prism());
    expect_low("prism", &c);
    expect_whole(&c, 0);
    for (size_t i = 0; i < LINES; i++) {
        sp_vec3 in = around((i + 0.4) / LINES, 0.599, 0), out = around((i + 0.4) / LINES, 0.601, 0);
        assert_true(cell_at(&c, in.x, in.y) != cell_at(&c, out.x, out.y));
    }
    destroy(&c);
}

static void lines_through_one_point(void **state)
{
    (void)state;
    cut_up c = cut(star());
    expect_low("star", &c);
    expect_whole(&c, 0);
    destroy(&c);
}

static void lines_upon_one_line(void **state)
{
    (void)state;
    cut_up c = cut(book());
    expect_low("book", &c);
    for (uint32_t triangle = 0; triangle <= PAGES; triangle++)
        expect_whole(&c, triangle);
    assert_true(cell_at(&c, 0.099, 0.01) != cell_at(&c, 0.101, 0.01));
    destroy(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_in_a_chosen_order),
        cmocka_unit_test(a_convex_outline),
        cmocka_unit_test(lines_through_one_point),
        cmocka_unit_test(lines_upon_one_line),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
