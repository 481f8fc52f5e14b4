/* Packing by pixels: everything on a page, nothing on or beside anything else, little wasted. */
#include "shapes.h"

#include "atlas/packing/nest.h"

/* A square whose upper right corner is missing, but for a border below and to the left. */
static sp_shape corner(uint32_t side, uint32_t border)
{
    sp_shape shape = {.width = side, .height = side, .run_count = side, .runs = malloc(side * sizeof *shape.runs)};
    for (uint32_t y = 0; y < side; y++) {
        shape.runs[y] = (sp_shape_run){y, 0, y < border ? side : border};
        shape.area += shape.runs[y].length;
    }
    return shape;
}

static sp_shape square(uint32_t side)
{
    return corner(side, side);
}

static void forget(sp_shape *shapes, size_t count)
{
    for (size_t i = 0; i < count; i++)
        free(shapes[i].runs);
}

/* Paints every shape where it was put and looks for others in it and around it. Returns the share of the pages taken.
 */
static double packed(const sp_shape *shapes, size_t count, uint32_t limit, uint32_t *edge, size_t *pages)
{
    sp_spot *spots = malloc((count + 1) * sizeof *spots);
    sp_error error = {0};
    assert_true(sp_nest(shapes, count, limit, spots, edge, pages, &error));
    assert_true(*edge <= limit);
    size_t side = *edge + 2u, taken = 0; /* with a border, to look around */
    uint32_t *paint = calloc(side * side * *pages, sizeof *paint);
    for (size_t i = 0; i < count; i++) {
        sp_shape turned = shapes[i], next;
        for (int t = 0; t < spots[i].turns; t++, turned = next) {
            assert_true(sp_shape_turn(&turned, &next));
            if (t)
                free(turned.runs);
        }
        assert_true(spots[i].page < *pages && spots[i].x + turned.width <= *edge &&
                    spots[i].y + turned.height <= *edge);
        uint32_t *page = paint + spots[i].page * side * side;
        for (uint32_t r = 0; r < turned.run_count; r++)
            for (uint32_t k = 0; k < turned.runs[r].length; k++, taken++) {
                size_t x = 1 + spots[i].x + turned.runs[r].x + k, y = 1 + spots[i].y + turned.runs[r].y;
                for (size_t j = 0; j < 9; j++) {
                    uint32_t there = page[(y - 1 + j / 3) * side + x - 1 + j % 3];
                    assert_true(there == 0 || there == i + 1);
                }
                page[y * side + x] = (uint32_t)i + 1;
            }
        if (spots[i].turns)
            free(turned.runs);
    }
    free(paint);
    free(spots);
    return (double)taken / ((double)*edge * *edge * (double)*pages);
}

static void squares_lie_in_rows(void **state)
{
    (void)state;
    sp_shape shapes[16];
    uint32_t edge;
    size_t pages;
    for (size_t i = 0; i < 16; i++)
        shapes[i] = square(30);
    packed(shapes, 16, 4096, &edge, &pages);
    assert_int_equal(pages, 1);
    assert_int_equal(edge, 4 * 30 + 3);
    packed(shapes, 16, 61, &edge, &pages); /* four on a page */
    assert_int_equal(pages, 4);
    forget(shapes, 16);
}

/* Corners that only fill a page when they reach into each other: by their boxes they would take 2.3 times as much. */
static void corners_reach_into_each_other(void **state)
{
    (void)state;
    enum { COUNT = 60 };
    sp_shape shapes[COUNT];
    uint32_t edge;
    size_t pages;
    for (size_t i = 0; i < COUNT; i++)
        shapes[i] = corner(80, 20);
    assert_true(packed(shapes, COUNT, 4096, &edge, &pages) > 0.6);
    assert_int_equal(pages, 1);
    forget(shapes, COUNT);
}

static void bumpy_strips_keep_apart(void **state)
{
    (void)state;
    enum { COUNT = 120 };
    sp_shape shapes[COUNT];
    uint64_t seed = 5;
    for (size_t i = 0; i < COUNT; i++) {
        uint32_t height = 1 + (uint32_t)(100 * random_number(&seed)), at = 0;
        shapes[i] = (sp_shape){.height = height, .runs = malloc(height * sizeof *shapes[i].runs)};
        for (uint32_t y = 0; y < height; y++) {
            uint32_t length = 40 + (uint32_t)(10 * random_number(&seed));
            at += (uint32_t)(2 * random_number(&seed));
            shapes[i].runs[shapes[i].run_count++] = (sp_shape_run){y, at, length};
            shapes[i].width = at + length > shapes[i].width ? at + length : shapes[i].width;
            shapes[i].area += length;
        }
    }
    for (uint32_t limit = 200; limit < 1000; limit += 300) {
        uint32_t edge;
        size_t pages;
        double share = packed(shapes, COUNT, limit, &edge, &pages);
        assert_true(limit < 700 || (pages == 1 && share > 0.6));
    }
    forget(shapes, COUNT);
}

static void thousands_of_pieces(void **state)
{
    (void)state;
    enum { COUNT = 3000 };
    sp_shape *shapes = malloc(COUNT * sizeof *shapes);
    uint64_t seed = 3;
    uint32_t edge;
    size_t pages;
    for (size_t i = 0; i < COUNT; i++)
        shapes[i] = corner(3 + (uint32_t)(20 * random_number(&seed)), 2);
    for (size_t i = 0; i < COUNT; i += 2) {
        free(shapes[i].runs);
        shapes[i] = square(2 + (uint32_t)(20 * random_number(&seed)));
    }
    assert_true(packed(shapes, COUNT, 4096, &edge, &pages) > 0.5);
    assert_int_equal(pages, 1);
    forget(shapes, COUNT);
    free(shapes);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(squares_lie_in_rows),
        cmocka_unit_test(corners_reach_into_each_other),
        cmocka_unit_test(bumpy_strips_keep_apart),
        cmocka_unit_test(thousands_of_pieces),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
