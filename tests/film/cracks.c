/* Cracks of the mesh, where triangles nearly meet and share no edge: film crosses them, and what is wider sheds it. */
#include "rooms.h"

#include "mesh/cracks.h"

/* How the lower edge of the upper half lies to the upper edge of the lower one, in parts of the step. */
static const sp_vec3 ways[] = {{0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}, {0.6, -0.5, 0.5}};
static const double steps[] = {0, 1e-8, 1e-6, 2e-5, 1e-4}; /* m; the wall is 1 m wide and high */

/* A wall in y = 0, its upper half moved, of upper × upper and lower × lower cells; its front is towards -y. */
static shape wall_in_halves(sp_vec3 moved, int upper, int lower)
{
    shape s = shape_create();
    shape_part(&s, "wall");
    shape_sheet(&s, sp_v(-0.5, 0, -0.5), X, sp_scale(Z, 0.5), lower);
    shape_sheet(&s, sp_add(sp_v(-0.5, 0, 0), moved), X, sp_scale(Z, 0.5), upper);
    return s;
}

/* Lays liquid on the wall's upper quarter on one side, and expects it, or none, on the lower half of that side alone.
 */
static void expect_below(shape *s, sp_vec3 side, double share, double within)
{
    walls w;
    walls_open(&w, shape_mesh(s), SP_CAVITY_OUTSIDE, sp_v(0, 0, 0), 0.05);
    region lower = {{-0.5, -0.01, -0.45}, {0.5, 0.01, -0.05}, side}, other = lower, upper = lower;
    other.normal = minus(side);
    upper.low.z = 0.25;
    upper.high.z = 0.6;
    walls_rain(&w, upper, LAID);
    assert_near("below", mean_film(&w, lower) / w.all, share, within);
    assert_true(mean_film(&w, other) == 0);
    assert_ends(&w, 1, 0, 0, 1e-12);
    walls_close(&w);
}

static void film_crosses_a_crack(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof steps / sizeof *steps; i++)
        for (size_t k = 0; k < sizeof ways / sizeof *ways; k++) {
            shape s = wall_in_halves(sp_scale(ways[k], steps[i]), 2, 2);
            expect_below(&s, k % 2 ? Y : minus(Y), 1, 0.02);
        }
}

/* One long edge faces several short ones, and where these end the others do not. */
static void film_crosses_junctions(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof steps / sizeof *steps; i++)
        for (int upper = 1; upper < 6; upper += 2) {
            shape s = wall_in_halves(sp_scale(ways[i % 4], steps[i]), upper, 6 - upper);
            expect_below(&s, minus(Y), 1, 0.02);
        }
}

/* Every triangle for itself, its corners moved by up to so much along each axis. */
static void film_crosses_loose_triangles(void **state)
{
    (void)state;
    for (size_t i = 1; i < 4; i++) {
        shape s = wall_in_halves(sp_v(0, 0, 0), 4, 4);
        uint64_t seed = 3;
        for (size_t k = 0; k < s.point_count; k++)
            for (int axis = 0; axis < 3; axis++) {
                double by = steps[i] * (2 * random_share(&seed) - 1);
                s.points[k] = sp_along(s.points[k], by, axis == 0 ? X : axis == 1 ? Y : Z);
            }
        /* charts that lie askew spread it to the wall's sides */
        expect_below(&s, minus(Y), 1, 0.05);
    }
}

static void film_leaves_at_a_slit(void **state)
{
    (void)state;
    const double slits[] = {0.005, 0.02};
    for (int i = 0; i < 2; i++) {
        shape s = wall_in_halves(sp_scale(Z, slits[i]), 2, 3);
        expect_below(&s, minus(Y), 0, 0);
    }
}

/* Two walls so near each other that their lower edges lie no farther apart than a crack is wide: film drips off them.
 */
static void rims_of_parallel_walls_stay_rims(void **state)
{
    (void)state;
    shape s = shape_create();
    shape_part(&s, "walls");
    shape_sheet(&s, sp_v(-0.5, 0, -0.5), X, Z, 2);
    shape_sheet(&s, sp_v(-0.5, 1e-4, -0.5), X, Z, 3);
    walls w;
    walls_open(&w, shape_mesh(&s), SP_CAVITY_OUTSIDE, sp_v(0, 0, 0), 0.05);
    region front = {{-0.5, -1e-5, -0.5}, {0.5, 1e-5, 0.5}, minus(Y)}, back = {{-0.5, 5e-5, -0.5}, {0.5, 2e-4, 0.5}, Y};
    walls_rain(&w, front, LAID);
    assert_true(wet_share(&w, back) == 0);
    assert_ends(&w, 1, 0, 0, 1e-12);
    walls_close(&w);
}

/* How much of its open edges a mesh has at cracks, m on either side. */
static double cracked_length(shape *s, double width)
{
    sp_mesh *mesh = shape_mesh(s);
    sp_half_edges edges = {0};
    sp_cracks cracks;
    sp_error error = {0};
    assert_true(sp_half_edges_create(mesh, &edges, &error) && sp_cracks_find(mesh, &edges, width, &cracks, &error));
    double length = 0, end = 0;
    for (size_t i = 0; i < 2 * cracks.count; i++) {
        const sp_crack_side *side = &cracks.sides[i];
        bool another = i && cracks.sides[i - 1].half_edge == side->half_edge;
        assert_true(side->from < side->to && side->from >= (another ? end : 0) && side->to <= 1);
        end = side->to;
        length += (side->to - side->from) * sp_distance(mesh->vertices[sp_half_edge_from(mesh, side->half_edge)],
                                                        mesh->vertices[sp_half_edge_to(mesh, side->half_edge)]);
    }
    sp_cracks_free(&cracks);
    sp_half_edges_destroy(&edges);
    sp_mesh_destroy(mesh);
    return length;
}

/* Edges have a crack once, no matter how many others lie near: three sheets that nearly meet, two of them as one. */
static void edges_have_one_crack(void **state)
{
    (void)state;
    for (int sheets = 2; sheets < 5; sheets++) {
        shape s = wall_in_halves(sp_v(0, 1e-5, 0), 3, 4);
        for (int i = 2; i < sheets; i++)
            shape_sheet(&s, sp_v(-0.5, 0, 2e-5 * i), X, i == 2 ? Y : minus(Y), 2);
        assert_near("at cracks", cracked_length(&s, 1e-4), sheets == 4 ? 4 : 2, 1e-3);
    }
}

/* A pointed leaf of sheet, and a slit that runs out within a sheet: only the second's tip is a crack. */
static void tips(void **state)
{
    (void)state;
    shape leaf = shape_create(), slit = shape_create();
    shape_part(&leaf, "leaf");
    shape_triangle(&leaf, sp_v(0, 0, 0), sp_v(1, 0, -0.05), sp_v(1, 0, 0));
    shape_triangle(&leaf, sp_v(0, 0, 0), sp_v(1, 0, 0), sp_v(1, 0, 0.05));
    assert_true(cracked_length(&leaf, 1e-4) == 0);
    shape_part(&slit, "slit");
    shape_triangle(&slit, sp_v(0, 0, 0), sp_v(1, 0, 0.05), sp_v(0, 0, 1));
    shape_triangle(&slit, sp_v(0, 0, 0), sp_v(0, 0, -1), sp_v(1, 0, -0.05));
    assert_near("at the tip", cracked_length(&slit, 1e-4), 2 * 1e-4 / sin(2 * atan(0.05)), 0.01);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(film_crosses_a_crack),
        cmocka_unit_test(film_crosses_junctions),
        cmocka_unit_test(film_crosses_loose_triangles),
        cmocka_unit_test(film_leaves_at_a_slit),
        cmocka_unit_test(rims_of_parallel_walls_stay_rims),
        cmocka_unit_test(edges_have_one_crack),
        cmocka_unit_test(tips),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
