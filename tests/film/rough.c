/* Film on walls whose corners are moved by an eighth of an edge, so that facets lean by 7° against the wall that they
 * make, and some by 20°: it runs as on the smooth wall. */
#include "rooms.h"

#define EDGE 0.02    /* m */
#define ROUGH 0.125  /* of an edge, at most, along each axis */
#define CROWN 1.2    /* m, of a Klöpper head (DIN 28011) */
#define KNUCKLE 0.12 /* m */
#define RADIUS 0.6   /* m */

/* The shortest edge at each corner, m. */
static double *shortest_edges(const sp_mesh *mesh)
{
    double *shortest = malloc(mesh->vertex_count * sizeof *shortest);
    assert_non_null(shortest);
    for (size_t i = 0; i < mesh->vertex_count; i++)
        shortest[i] = INFINITY;
    for (size_t h = 0; h < 3 * mesh->triangle_count; h++) {
        uint32_t a = mesh->triangles[h / 3][h % 3], b = mesh->triangles[h / 3][(h + 1) % 3];
        double length = sp_distance(mesh->vertices[a], mesh->vertices[b]);
        shortest[a] = fmin(shortest[a], length);
        shortest[b] = fmin(shortest[b], length);
    }
    return shortest;
}

/* Moves every corner along each axis by up to that share of its shortest edge. */
static sp_mesh *roughen(sp_mesh *smooth, double share)
{
    shape s = shape_create();
    shape_part(&s, "rough");
    uint64_t state = 15;
    double *by = shortest_edges(smooth), off[3];
    sp_vec3 *corner = malloc(smooth->vertex_count * sizeof *corner);
    assert_non_null(corner);
    for (size_t i = 0; i < smooth->vertex_count; i++) {
        for (int k = 0; k < 3; k++) {
            state = state * 6364136223846793005u + 1442695040888963407u;
            off[k] = share * by[i] * ((double)(state >> 11) * 0x1p-52 - 1);
        }
        corner[i] = sp_add(smooth->vertices[i], sp_v(off[0], off[1], off[2]));
    }
    for (size_t t = 0; t < smooth->triangle_count; t++) {
        const uint32_t *of = smooth->triangles[t];
        shape_triangle(&s, corner[of[0]], corner[of[1]], corner[of[2]]);
    }
    free(by);
    free(corner);
    sp_mesh_destroy(smooth);
    return shape_mesh(&s);
}

/* A Klöpper head on a shell of 0.4 m without a floor, its front inside; the tangent line is at z = 0. */
static sp_mesh *dome(void)
{
    double profile[96][2], joint = asin((RADIUS - KNUCKLE) / (CROWN - KNUCKLE));
    int count = 0, crown = (int)(CROWN * joint / EDGE), knuckle = (int)(KNUCKLE * (M_PI / 2 - joint) / EDGE);
    for (int i = 20; i > 0; i--, count++) {
        profile[count][0] = RADIUS;
        profile[count][1] = -EDGE * i;
    }
    for (int i = knuckle; i > 0; i--, count++) {
        double a = joint + (M_PI / 2 - joint) * i / knuckle;
        profile[count][0] = RADIUS - KNUCKLE + KNUCKLE * sin(a);
        profile[count][1] = KNUCKLE * cos(a);
    }
    for (int i = crown; i >= 0; i--, count++) {
        profile[count][0] = CROWN * sin(joint * i / crown);
        profile[count][1] = CROWN * cos(joint * i / crown) - (CROWN - KNUCKLE) * cos(joint);
    }
    shape s = shape_create();
    shape_part(&s, "dome");
    shape_turned(&s, (const double(*)[2])profile, count, (int)(2 * M_PI * RADIUS / EDGE));
    return shape_mesh(&s);
}

/* Liquid on a ring of the head where it slopes by 12.5 to 16° comes down the shell. */
static void head_wets_its_shell(void **state)
{
    (void)state;
    double high = CROWN * cos(0.218), low = CROWN * cos(0.279), joint = asin((RADIUS - KNUCKLE) / (CROWN - KNUCKLE));
    double held = 2 * M_PI * CROWN * (high - low), off = (CROWN - KNUCKLE) * cos(joint);
    for (int rough = 0; rough < 2; rough++) {
        walls w;
        walls_open(&w, roughen(dome(), rough ? ROUGH : 0), SP_CAVITY_POINT, sp_v(0, 0, -0.1), 0.02);
        walls_rain(&w, (region){{-1, -1, low - off}, {1, 1, high - off}, {0, 0, 0}}, LAID);
        assert_ends(&w, 1, 0, 0, 1e-12);
        double expected = LAID * held / (2 * M_PI * RADIUS), area = 0, wet = 0, least = INFINITY, most = 0;
        region shell = {{-1, -1, -0.35}, {1, 1, -0.05}, {0, 0, 0}};
        for (size_t i = 0; i < w.cells->count; i++)
            if (region_holds(&shell, &w, i)) {
                area += w.cells->area[i];
                wet += w.per_width[i] > 0.4 * expected ? w.cells->area[i] : 0;
                least = fmin(least, w.per_width[i] / expected);
                most = fmax(most, w.per_width[i] / expected);
            }
        assert_near("on the shell", mean_film(&w, shell), expected, 0.03);
        if (!(rough ? wet > 0.99 * area : least > 0.9 && most < 1.25))
            fail_msg("from %g to %g of what is expected, %g above .4", least, most, wet / area);
        walls_close(&w);
    }
}

/* A rough ceiling holds its film where its mean slope says so, and then all runs down to its lower edge. */
static void ceilings_hold_by_their_mean_slope(void **state)
{
    (void)state;
    for (int steep = 0; steep < 2; steep++) {
        double lean = steep ? 0.26 : 0.087; /* 15°, 5° */
        shape s = shape_create();
        shape_part(&s, "ceiling");
        shape_sheet(&s, sp_v(0, 0, 0), sp_v(0, 1, 0), sp_v(cos(lean), 0, sin(lean)), 50);
        walls w;
        walls_open(&w, roughen(shape_mesh(&s), ROUGH), SP_CAVITY_OUTSIDE, sp_v(0, 0, 0), 0.03);
        walls_rain(&w, (region){{-1, -1, 0.5 * sin(lean)}, {2, 2, 1}, sp_v(sin(lean), 0, -cos(lean))}, LAID);
        assert_ends(&w, 1, 0, 0, 1e-12);
        double lower = mean_film(&w, (region){{0.1, 0.1, -1}, {0.3, 0.9, 1}, sp_v(sin(lean), 0, -cos(lean))});
        if (steep)
            assert_near("near the lower edge", lower, w.all, 0.03); /* it is 1 m wide */
        else
            assert_true(lower < 1e-3 * w.all);
        walls_close(&w);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(head_wets_its_shell),
        cmocka_unit_test(ceilings_hold_by_their_mean_slope),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
