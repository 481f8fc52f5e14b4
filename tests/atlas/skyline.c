/* Packing: everything on a page, nothing on anything else, one texel between, few texels wasted. */
#include "shapes.h"

#include "atlas/packing/skyline.h"

/* Paints every rectangle with its number and looks for others in it and around it. */
static void expect_apart(const sp_rectangle *r, size_t count, uint32_t edge, size_t pages)
{
    uint32_t *paint = calloc((size_t)edge * edge * pages, sizeof *paint);
    for (uint32_t i = 0; i < count; i++) {
        assert_true(r[i].page < pages && r[i].x + r[i].width <= edge && r[i].y + r[i].height <= edge);
        uint32_t *page = paint + (size_t)r[i].page * edge * edge;
        uint32_t right = r[i].x + r[i].width + (r[i].x + r[i].width < edge);
        uint32_t top = r[i].y + r[i].height + (r[i].y + r[i].height < edge);
        for (uint32_t y = r[i].y - (r[i].y > 0); y < top; y++)
            for (uint32_t x = r[i].x - (r[i].x > 0); x < right; x++)
                assert_int_equal(page[(size_t)y * edge + x], 0);
        for (uint32_t y = r[i].y; y < r[i].y + r[i].height; y++)
            for (uint32_t x = r[i].x; x < r[i].x + r[i].width; x++)
                page[(size_t)y * edge + x] = i + 1;
    }
    free(paint);
}

static void random_rectangles_keep_apart(void **state)
{
    (void)state;
    enum { COUNT = 500 };
    static sp_rectangle r[COUNT];
    uint64_t seed = 7;
    for (uint32_t limit = 60; limit <= 2000; limit += 388) {
        double area = 0;
        for (int i = 0; i < COUNT; i++) {
            r[i] = (sp_rectangle){.width = 1 + (uint32_t)(60 * random_number(&seed)),
                                  .height = 1 + (uint32_t)(60 * random_number(&seed))};
            area += (r[i].width + 1.0) * (r[i].height + 1.0);
        }
        uint32_t edge;
        size_t pages;
        assert_true(sp_skyline(r, COUNT, limit, &edge, &pages, NULL));
        assert_true(edge <= limit && (edge % 64 == 0 || edge == limit));
        expect_apart(r, COUNT, edge, pages);
        if (limit > 1000)
            assert_true(pages == 1 && area > 0.7 * edge * edge);
    }
}

static void extremes(void **state)
{
    (void)state;
    uint32_t edge;
    size_t pages;
    assert_true(sp_skyline(NULL, 0, 4096, &edge, &pages, NULL));
    assert_int_equal(pages, 1);
    sp_rectangle whole[3] = {{.width = 100, .height = 100}, {.width = 100, .height = 100}, {.width = 1, .height = 1}};
    assert_true(sp_skyline(whole, 3, 100, &edge, &pages, NULL));
    assert_int_equal(edge, 100);
    assert_int_equal(pages, 3);
    expect_apart(whole, 3, edge, pages);
    sp_rectangle dots[2] = {{.width = 1, .height = 1}, {.width = 1, .height = 1}};
    assert_true(sp_skyline(dots, 2, 1, &edge, &pages, NULL));
    assert_int_equal(pages, 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(random_rectangles_keep_apart), cmocka_unit_test(extremes)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
