/* Film on one triangle, on slivers, along the edges of valleys and ridges, and on plates as thin as paper and far
 * thinner. What arrives ends somewhere and no flow is below 0, as walls_rain asserts. */
#include "rooms.h"

/* A triangle leaning by `tilt` from the level, turned in its plane, and cut into cells or smaller than one. Within one
 * cell all runs over what of its outline lies across the flow, on a level top over all of it. */
static void check_triangle(double size, double tilt, double turn, double texel)
{
    shape s = shape_create();
    shape_part(&s, "triangle");
    sp_vec3 corner[3];
    double low = INFINITY, high = -INFINITY, around = 0;
    for (int i = 0; i < 3; i++) {
        double angle = turn + (const double[]){0, 2, 4.5}[i], x = size * cos(angle), y = size * sin(angle);
        corner[i] = sp_v(x, y * cos(tilt), y * sin(tilt));
        low = fmin(low, x);
        high = fmax(high, x);
    }
    for (int i = 0; i < 3; i++)
        around += sp_length(sp_sub(corner[(i + 1) % 3], corner[i]));
    shape_triangle(&s, corner[0], corner[1], corner[2]);
    walls w;
    walls_open(&w, shape_mesh(&s), SP_CAVITY_OUTSIDE, sp_v(0, 0, 0), texel * size);
    for (int side = -1; side <= 1; side += 2) {
        sp_vec3 normal = sp_scale(sp_v(0, -sin(tilt), cos(tilt)), side);
        walls_rain(&w, (region){{-9e9, -9e9, -9e9}, {9e9, 9e9, 9e9}, normal}, LAID);
        assert_ends(&w, 1, 0, 0, 1e-12);
        double across = tilt == 0 && side > 0 ? around : high - low;
        for (size_t i = 0; w.cells->count == 2 && i < 2; i++)
            if (sp_dot(w.cells->normal[i], normal) > 0 && (tilt > 0 || side > 0)) /* beneath, a level one only drips */
                assert_near("on the triangle", w.per_width[i], w.all / across, 1e-6);
        assert_true(wet_share(&w, (region){{-9e9, -9e9, -9e9}, {9e9, 9e9, 9e9}, normal}) > 0.99);
    }
    walls_close(&w);
}

static void one_triangle(void **state)
{
    (void)state;
    const double sizes[] = {1e-6, 0.3, 1e5}, tilts[] = {0, 0.1, 1, M_PI / 2}, texels[] = {0.07, 0.4, 30};
    for (int k = 0; k < 3 * 4 * 3; k++)
        check_triangle(sizes[k % 3], tilts[k / 3 % 4], 0.7 * k, texels[k / 12]);
}

/* A wall of 1 × 1 m, cut at `count` places along both of its edges. */
static walls cut_wall(const double *at, int count, double lean)
{
    shape s = shape_create();
    shape_part(&s, "wall");
    for (int i = 0; i + 1 < count; i++)
        for (int k = 0; k + 1 < count; k++) {
            sp_vec3 p[4];
            for (int c = 0; c < 4; c++) {
                double u = at[i + (c == 1 || c == 2)], v = at[k + (c >= 2)];
                p[c] = sp_v(u, v * cos(lean), v * sin(lean));
            }
            shape_triangle(&s, p[0], p[1], p[2]);
            shape_triangle(&s, p[0], p[2], p[3]);
        }
    walls w;
    walls_open(&w, shape_mesh(&s), SP_CAVITY_OUTSIDE, sp_v(0, 0, 0), 0.05);
    double top = sin(lean);
    walls_rain(&w, (region){{-1, -1, 0.75 * top}, {2, 2, 2}, sp_v(0, -sin(lean), cos(lean))}, LAID);
    assert_ends(&w, 1, 0, 0, 1e-12);
    return w;
}

/* Needles up to 1 : 10⁸ across and along a wall leave its film as it is. */
static void slivers(void **state)
{
    (void)state;
    const double plain[] = {0, 1};
    const double cut[] = {0, 0.3, 0.3 + 1e-8, 0.3 + 2e-8, 0.3 + 1e-6, 0.71, 0.71 + 1e-5, 0.72, 1};
    for (int leans = 0; leans < 2; leans++) {
        double lean = leans ? 0.2 : M_PI / 2;
        walls whole = cut_wall(plain, 2, lean), needles = cut_wall(cut, 9, lean);
        for (int band = 0; band < 5; band++) {
            double high = 0.65 * sin(lean), step = high / 5;
            region r = {{0.05, -1, band * step}, {0.95, 2, (band + 1) * step}, sp_v(0, -sin(lean), cos(lean))};
            assert_near("with needles", mean_film(&needles, r), mean_film(&whole, r), 0.01);
        }
        walls_close(&whole);
        walls_close(&needles);
    }
}

/* Two plates that meet in an edge along x, which falls by 5 %; `steep` is by how much they fall away from it, or where
 * below 0 towards it. What one of them carries never comes to the other: of a ridge it runs off beyond, of a valley it
 * gathers in the edge. Plates that lie `apart` touch, and share no edge of the mesh. */
static void check_edge(double steep, double texel, bool apart)
{
    double wide = 0.5 / hypot(1, steep);
    shape s = shape_create();
    shape_part(&s, "plates");
    sp_vec3 along = sp_v(1, 0, -0.05);
    shape_sheet(&s, sp_v(0, 0, 0), sp_v(0, -wide, -steep * wide), along, 2);
    sp_vec3 over = sp_scale(along, apart ? -0.04 : 0);
    shape_sheet(&s, over, sp_sub(along, over), sp_v(0, wide, -steep * wide), 2);
    walls w;
    walls_open(&w, shape_mesh(&s), SP_CAVITY_OUTSIDE, sp_v(0, 0, 0), texel);
    sp_vec3 left = sp_unit(sp_v(0.05, -steep, 1)), right = sp_unit(sp_v(0.05, steep, 1));
    walls_rain(&w, (region){{0.1, -wide, -2}, {0.9, -0.2 * wide, 2}, left}, LAID);
    assert_ends(&w, 1, 0, 0, 1e-12);
    assert_true(wet_share(&w, (region){{0, 0.3 * wide, -2}, {1, wide, 2}, right}) == 0);
    double outer = mean_film(&w, (region){{0.5, -wide, -2}, {0.9, -0.7 * wide, 2}, left});
    double inner = mean_film(&w, (region){{0.5, -0.3 * wide, -2}, {0.9, 0.1 * wide, 2}, left});
    assert_true(steep > 0 ? outer > inner : inner > outer);
    walls_close(&w);
}

static void ridges_and_valleys(void **state)
{
    (void)state;
    const double steep[] = {0.3, 1, 30};
    for (int i = 0; i < 3; i++)
        for (int valley = 0; valley < 2; valley++)
            for (int coarse = 0; coarse < 2; coarse++)
                check_edge(valley ? -steep[i] : steep[i], coarse ? 0.08 : 0.03, false);
}

static void valleys_of_plates_that_touch(void **state)
{
    (void)state;
    const double steep[] = {0.3, 1, 30};
    for (int i = 0; i < 6; i++)
        check_edge(-steep[i / 2], i % 2 ? 0.08 : 0.03, true);
}

/* An upright plate: either side has its own film down to its lower edge, where it drips, however thin. */
static void thin_plates(void **state)
{
    (void)state;
    for (int i = 0; i < 3; i++) {
        double half = (const double[]){1e-2, 1e-4, 1e-5}[i];
        shape s = shape_create();
        shape_part(&s, "plate");
        shape_box(&s, sp_v(-0.5, -half, -0.5), sp_v(0.5, half, 0.5), false);
        walls w;
        walls_open(&w, shape_mesh(&s), SP_CAVITY_OUTSIDE, sp_v(0, 0, 0), 0.05);
        walls_rain(&w, (region){{-1, -1, 0}, {1, 1, 0.4}, minus(Y)}, LAID);
        region lower = {{-0.5, -1, -0.4}, {0.5, 1, -0.1}, minus(Y)};
        assert_near("in front", mean_film(&w, lower), w.all, 0.05);
        lower.normal = Y;
        assert_true(wet_share(&w, lower) == 0);
        assert_ends(&w, 1, 0, 0, 1e-12);
        walls_close(&w);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_triangle),       cmocka_unit_test(slivers),
        cmocka_unit_test(ridges_and_valleys), cmocka_unit_test(valleys_of_plates_that_touch),
        cmocka_unit_test(thin_plates),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
