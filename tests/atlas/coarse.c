/* What the charts of large meshes rest on: the mesh put in order, made coarse, and sheets carried back to it. */
#include "shapes.h"

#include "mesh/adjacent.h"
#include "atlas/charts/charts.h"
#include "atlas/charts/coarsen.h"
#include "atlas/charts/making.h"
#include "atlas/charts/prolong.h"
#include "atlas/charts/renumber.h"

#ifdef SPRAYPLAN_SANITIZE
enum { FINE = 40 };
#else
enum { FINE = 100 };
#endif

/* A drum, bent only at its rims, with a dent in its lid. */
static sp_vec3 on_drum(double s, double t, double size)
{
    double along = 3 * t;
    if (along <= 1)
        return on_circle(size * along, s, 0);
    if (along <= 2)
        return on_circle(size, s, size * (along - 1));
    double radius = along >= 3 ? 0 : 3 - along;
    sp_vec3 p = on_circle(size * radius, s, size);
    p.z -= size * 0.3 * exp(-8 * radius * radius);
    return p;
}

/* A saddle with bumps. */
static sp_vec3 on_bumps(double s, double t, double size)
{
    sp_vec3 p = on_saddle(s, t, size);
    p.z += 0.1 * size * sin(9 * s) * cos(7 * t);
    return p;
}

static sp_vec3 on_waves(double s, double t, double size)
{
    return sp_v(size * s, size * t, 0.1 * size * sin(7 * s) * cos(5 * t));
}

/* A surface whose every face is there twice, once each way round: at its corners two triangles are all there is. */
static sp_mesh *doubled(sp_mesh *mesh)
{
    size_t count = mesh->triangle_count;
    uint32_t(*triangles)[3] = malloc(2 * count * sizeof *triangles);
    for (size_t t = 0; t < count; t++) {
        const uint32_t *c = mesh->triangles[t];
        memcpy(triangles[2 * t], c, sizeof *triangles);
        memcpy(triangles[2 * t + 1], (uint32_t[]){c[0], c[2], c[1]}, sizeof *triangles);
    }
    sp_mesh *both = mesh_of(mesh->vertices, mesh->vertex_count, (const uint32_t(*)[3])triangles, 2 * count);
    assert_int_equal(both->triangle_count, 2 * count);
    free(triangles);
    sp_mesh_destroy(mesh);
    return both;
}

enum { SHAPES = 6 };

static sp_mesh *shape(int which)
{
    switch (which) {
    case 0:
        return net(FINE, FINE / 2, on_sphere, 1);
    case 1:
        return net(FINE, FINE / 3, on_strip, 1);
    case 2:
        return net(FINE, FINE / 3, on_two_tubes, 1);
    case 3:
        return net(FINE, 3 * (FINE / 4), on_drum, 1);
    case 4:
        return net(FINE / 2, FINE / 2, on_bumps, 1);
    case 5:
        return doubled(net(FINE / 2, FINE / 2, on_waves, 1));
    default:
        return NULL;
    }
}

static sp_half_edges edges_of(const sp_mesh *mesh)
{
    sp_half_edges edges = {0};
    assert_true(sp_adjacent_create(mesh, &edges, NULL));
    return edges;
}

static sp_sheets sheets_of(const sp_mesh *mesh, const uint32_t *twin)
{
    sp_sheets sheets;
    assert_true(sp_sheets_create(&sheets, mesh, twin, NULL));
    return sheets;
}

/* Every half-edge's twin runs the other way between the same vertices, and has it as its own twin. */
static void expect_twins(const sp_mesh *mesh, const uint32_t *twin)
{
    for (uint32_t h = 0; h < 3 * mesh->triangle_count; h++) {
        if (twin[h] == SP_NONE)
            continue;
        assert_true(twin[h] < 3 * mesh->triangle_count && twin[h] / 3 != h / 3);
        assert_int_equal(twin[twin[h]], h);
        assert_int_equal(sp_half_edge_from(mesh, twin[h]), sp_half_edge_to(mesh, h));
        assert_int_equal(sp_half_edge_to(mesh, twin[h]), sp_half_edge_from(mesh, h));
    }
}

static void renumbering_keeps_the_mesh(void **state)
{
    (void)state;
    for (int i = 0; i < SHAPES; i++) {
        sp_mesh *mesh = shape(i);
        sp_half_edges edges = edges_of(mesh);
        sp_renumbered r;
        assert_true(sp_renumber(mesh, edges.opposite, &r));
        assert_int_equal(r.mesh.triangle_count, mesh->triangle_count);
        uint8_t *seen = calloc(mesh->triangle_count, 1);
        uint32_t *number = malloc(mesh->triangle_count * sizeof *number), vertices = 0;
        for (size_t t = 0; t < mesh->triangle_count; t++) {
            assert_true(r.old[t] < mesh->triangle_count && !seen[r.old[t]]);
            seen[r.old[t]] = 1;
            number[r.old[t]] = (uint32_t)t;
        }
        for (size_t t = 0; t < mesh->triangle_count; t++)
            for (int k = 0; k < 3; k++) {
                uint32_t v = r.mesh.triangles[t][k], other = edges.opposite[3 * r.old[t] + (uint32_t)k];
                assert_true(v <= vertices && v < r.mesh.vertex_count);
                vertices += v == vertices;
                assert_memory_equal(&r.mesh.vertices[v], &mesh->vertices[mesh->triangles[r.old[t]][k]],
                                    sizeof(sp_vec3));
                assert_int_equal(r.twin[3 * t + (size_t)k],
                                 other == SP_NONE ? SP_NONE : 3 * number[other / 3] + other % 3);
            }
        assert_int_equal(vertices, r.mesh.vertex_count);
        expect_twins(&r.mesh, r.twin);
        free(seen);
        free(number);
        sp_renumbered_free(&r);
        sp_half_edges_destroy(&edges);
        sp_mesh_destroy(mesh);
    }
}

static uint32_t root_of(uint32_t *root, uint32_t i)
{
    while (root[i] != i)
        i = root[i] = root[root[i]];
    return i;
}

static void join(uint32_t *root, uint32_t a, uint32_t b)
{
    root[root_of(root, a)] = root_of(root, b);
}

/* How many parts the triangles with the same label make, joined along edges. */
static size_t count_parts(const sp_mesh *mesh, const uint32_t *twin, const uint32_t *label)
{
    size_t parts = 0;
    uint32_t *root = malloc(mesh->triangle_count * sizeof *root);
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        root[t] = t;
    for (uint32_t h = 0; h < 3 * mesh->triangle_count; h++)
        if (twin[h] != SP_NONE && (!label || label[h / 3] == label[twin[h] / 3]))
            join(root, h / 3, twin[h] / 3);
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        parts += root[t] == t;
    free(root);
    return parts;
}

/* How many parts the vertices with the same label make, joined along edges. */
static size_t count_vertex_parts(const sp_mesh *mesh, const uint32_t *label)
{
    size_t parts = 0;
    uint32_t *root = malloc(mesh->vertex_count * sizeof *root);
    for (uint32_t v = 0; v < mesh->vertex_count; v++)
        root[v] = v;
    for (size_t t = 0; t < mesh->triangle_count; t++)
        for (int k = 0; k < 3; k++) {
            uint32_t v = mesh->triangles[t][k], w = mesh->triangles[t][(k + 1) % 3];
            if (label[v] == label[w])
                join(root, v, w);
        }
    for (uint32_t v = 0; v < mesh->vertex_count; v++)
        parts += root[v] == v;
    free(root);
    return parts;
}

/* Vertices less edges plus triangles. */
static long euler(const sp_mesh *mesh, const uint32_t *twin)
{
    long edges = 0;
    for (uint32_t h = 0; h < 3 * mesh->triangle_count; h++)
        edges += twin[h] == SP_NONE || h < twin[h];
    return (long)mesh->vertex_count - edges + (long)mesh->triangle_count;
}

/* What coarsen.h says of the two meshes. */
static void expect_sound_coarse(const sp_sheets *fine, const sp_coarse *coarse)
{
    const sp_mesh *mesh = fine->mesh, *rough = &coarse->mesh;
    uint8_t *taken = calloc(rough->triangle_count, 1), *stands = calloc(rough->vertex_count, 1);
    expect_twins(rough, coarse->twin);
    for (size_t v = 0; v < mesh->vertex_count; v++) {
        uint32_t into = coarse->vertex[v];
        assert_true(into < rough->vertex_count);
        stands[into] |= memcmp(&mesh->vertices[v], &rough->vertices[into], sizeof(sp_vec3)) == 0;
    }
    for (size_t t = 0; t < mesh->triangle_count; t++) {
        uint32_t parent = coarse->parent[t];
        assert_true(parent < rough->triangle_count);
        taken[parent] = 1;
        for (int k = 0; k < 3; k++) {
            uint32_t of = coarse->vertex[mesh->triangles[t][k]];
            const uint32_t *c = rough->triangles[parent];
            assert_true(c[0] == of || c[1] == of || c[2] == of);
        }
    }
    for (size_t t = 0; t < rough->triangle_count; t++) {
        const uint32_t *c = rough->triangles[t];
        assert_true(taken[t] && c[0] != c[1] && c[1] != c[2] && c[2] != c[0]);
    }
    for (size_t v = 0; v < rough->vertex_count; v++)
        assert_true(stands[v]);
    assert_int_equal(count_parts(mesh, fine->twin, coarse->parent), rough->triangle_count);
    assert_int_equal(count_vertex_parts(mesh, coarse->vertex), rough->vertex_count);
    assert_int_equal(count_parts(rough, coarse->twin, NULL), count_parts(mesh, fine->twin, NULL));
    free(taken);
    free(stands);
}

/* Flat, open and pinched places have all that they had. */
static void expect_kept(const sp_sheets *fine, const sp_coarse *coarse)
{
    const sp_mesh *mesh = fine->mesh;
    uint32_t *holds = calloc(coarse->mesh.vertex_count, sizeof *holds);
    size_t open[2] = {0, 0};
    for (size_t v = 0; v < mesh->vertex_count; v++)
        holds[coarse->vertex[v]]++;
    for (size_t t = 0; t < mesh->triangle_count; t++)
        for (int k = 0; k < 3; k++)
            if (fine->bend[mesh->triangles[t][k]] == SP_BEND_EXACT)
                assert_int_equal(holds[coarse->vertex[mesh->triangles[t][k]]], 1);
    for (size_t h = 0; h < 3 * mesh->triangle_count; h++)
        open[0] += fine->twin[h] == SP_NONE;
    for (size_t h = 0; h < 3 * coarse->mesh.triangle_count; h++)
        open[1] += coarse->twin[h] == SP_NONE;
    assert_int_equal(open[0], open[1]);
    free(holds);
}

static void coarse_meshes_are_sound(void **state)
{
    (void)state;
    for (int i = 0; i < SHAPES; i++) {
        sp_mesh *mesh = shape(i);
        sp_half_edges edges = edges_of(mesh);
        sp_sheets fine = sheets_of(mesh, edges.opposite);
        size_t before = mesh->triangle_count;
        for (size_t target = mesh->triangle_count; target > 4; target /= 3) {
            sp_coarse coarse;
            assert_true(sp_coarsen(&fine, target, &coarse));
            expect_sound_coarse(&fine, &coarse);
            expect_kept(&fine, &coarse);
            assert_int_equal(euler(&coarse.mesh, coarse.twin), euler(mesh, edges.opposite));
            assert_true(coarse.mesh.triangle_count <= before);
            before = coarse.mesh.triangle_count;
            sp_coarse_free(&coarse);
        }
        print_message("shape %d: %zu triangles, %zu at the least\n", i, mesh->triangle_count, before);
        /* Most of the drum is flat, and at every vertex of the doubled sheet but its rim's it meets itself. */
        assert_true(before < mesh->triangle_count / 2 || i == 3 || i == 5);
        sp_sheets_destroy(&fine);
        sp_half_edges_destroy(&edges);
        sp_mesh_destroy(mesh);
    }
}

/* Euler's number of a sheet by its own vertices, and how many boundaries it has. */
static void form_of(const sp_sheets *sheets, uint32_t number, long form[2])
{
    const sp_sheet *sheet = &sheets->items[number];
    uint8_t *seen = calloc(3 * sheets->mesh->triangle_count, 1);
    long edges = 0, loops = 0;
    for (size_t i = 0; i < 3 * sheet->triangle_count; i++) {
        uint32_t h = 3 * sheet->triangle[i / 3] + (uint32_t)(i % 3), across = sp_across(sheets, h);
        edges += across == SP_NONE || h < across;
        if (across != SP_NONE || seen[h])
            continue;
        loops++;
        for (uint32_t at = h; !seen[at]; at = sp_boundary_next(sheets, at))
            seen[at] = 1;
    }
    form[0] = (long)sheet->vertex_count - edges + (long)sheet->triangle_count;
    form[1] = loops;
    free(seen);
}

static void expect_sound_sheets(const sp_sheets *sheets)
{
    size_t triangles = 0;
    for (uint32_t i = 0; i < sheets->count; i++) {
        const sp_sheet *sheet = &sheets->items[i];
        double area = 0;
        uint8_t *used = calloc(sheet->vertex_count, 1);
        triangles += sheet->triangle_count;
        for (uint32_t k = 0; k < sheet->triangle_count; k++) {
            uint32_t t = sheet->triangle[k];
            assert_true(sheets->owner[t] == i && sheets->local[t] == k);
            area += 0.5 * sheets->shape[t][0] * sheets->shape[t][2];
            for (int c = 0; c < 3; c++) {
                assert_true(sheet->corner[k][c] < sheet->vertex_count);
                used[sheet->corner[k][c]] = 1;
            }
        }
        for (size_t v = 0; v < sheet->vertex_count; v++)
            assert_true(used[v] && isfinite(sheet->at[v][0]) && isfinite(sheet->at[v][1]));
        assert_true(fabs(area - sheet->area) <= 1e-9 * area);
        free(used);
    }
    assert_int_equal(triangles, sheets->mesh->triangle_count); /* each knows its owner, so each is in one only */
}

/* Sheets that are carried over have the form that they had, and take in all of the fine mesh. */
static void refining_keeps_the_form(void **state)
{
    (void)state;
    for (int i = 0; i < SHAPES; i++) {
        sp_mesh *mesh = shape(i);
        sp_half_edges edges = edges_of(mesh);
        sp_sheets fine = sheets_of(mesh, edges.opposite);
        sp_coarse coarse;
        assert_true(sp_coarsen(&fine, mesh->triangle_count / 5, &coarse));
        sp_making rough = {.extent = INFINITY, .sheets = sheets_of(&coarse.mesh, coarse.twin)};
        assert_true(sp_make_all(&rough, NULL));
        assert_true(sp_prolong_sheets(&coarse, &rough.sheets, &fine));
        expect_sound_sheets(&fine);
        uint32_t at = 0;
        for (uint32_t s = 0; s < rough.sheets.count; s++) {
            if (rough.sheets.items[s].triangle_count == 0)
                continue;
            long expected[2], found[2];
            form_of(&rough.sheets, s, expected);
            form_of(&fine, at++, found);
            assert_int_equal(found[0], expected[0]);
            assert_int_equal(found[1], expected[1]);
        }
        assert_int_equal(at, fine.count);
        print_message("shape %d: %zu triangles by way of %zu in %zu sheets\n", i, mesh->triangle_count,
                      coarse.mesh.triangle_count, fine.count);
        sp_making_destroy(&rough);
        sp_coarse_free(&coarse);
        sp_sheets_destroy(&fine);
        sp_half_edges_destroy(&edges);
        sp_mesh_destroy(mesh);
    }
}

/* Some of the tank's sheets come to lie flat only slowly, if at all: whether they do must not hang on round-off. */
static void where_a_mesh_lies_does_not_matter(void **state)
{
    (void)state;
    const double angles[] = {0, 1.234, 0};
    const sp_vec3 moves[] = {{0, 0, 0}, {3, -5, 7}, {0.3, 0.7, -1.1}};
    sp_mesh *mesh = data_mesh("mixing_tank/tank.obj");
    sp_charts *charts[3] = {0};
    for (int i = 0; mesh && i < 3; i++) {
        sp_mesh *moved = posed(mesh, 1, angles[i], moves[i]);
        charts[i] = sp_charts_by_levels(moved, INFINITY, 30000, 16400, NULL);
        assert_non_null(charts[i]);
        assert_int_equal(charts[i]->chart_count, charts[0]->chart_count);
        assert_memory_equal(charts[i]->chart, charts[0]->chart, mesh->triangle_count * sizeof *charts[i]->chart);
        sp_mesh_destroy(moved);
    }
    for (int i = 0; i < 3; i++)
        sp_charts_destroy(charts[i]);
    sp_mesh_destroy(mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(renumbering_keeps_the_mesh),
        cmocka_unit_test(coarse_meshes_are_sound),
        cmocka_unit_test(refining_keeps_the_form),
        cmocka_unit_test(where_a_mesh_lies_does_not_matter),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
