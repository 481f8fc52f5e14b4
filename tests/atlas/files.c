/* Real meshes, dirty ones among them, and the OBJ that comes out. */
#include "shapes.h"

#include <stdio.h>

static sp_mesh *load(const char *name)
{
    char path[1024];
    snprintf(path, sizeof path, DATA_DIR "/%s", name);
    FILE *file = fopen(path, "r");
    if (!file) {
        print_message("skipped: %s is not there\n", path);
        skip();
    }
    fclose(file);
    sp_error error = {0};
    sp_mesh *mesh = sp_mesh_load(path, 1, &error);
    if (!mesh)
        fail_msg("%s", error.message);
    return mesh;
}

static void expect_good(const char *name, size_t most_charts)
{
    sp_mesh *mesh = load(name);
    sp_atlas *atlas = atlas_of(mesh, sqrt(sp_mesh_area(mesh) / 50000), 0);
    sp_atlas_figures figures = figures_of(atlas, mesh);
    assert_int_equal(figures.triangles, mesh->triangle_count);
    assert_true(figures.charts <= most_charts);
    assert_int_equal(figures.shared_texels, 0);
    assert_int_equal(figures.overlaps, 0);
    assert_true(figures.area_error <= 1e-12 && figures.strain95 <= 0.05);
    assert_true(figures.utilisation > 0.05 && figures.utilisation <= 1);
    for (uint32_t t = 0; t < mesh->triangle_count; t += 7) {
        uint32_t texel = sp_atlas_texel(atlas, t, 1. / 3, 1. / 3);
        assert_int_equal(sp_atlas_place(atlas, texel).chart, atlas->chart[t]);
    }
    sp_atlas_destroy(atlas);
    sp_mesh_destroy(mesh);
}

static void beetle(void **state)
{
    (void)state;
    expect_good("beetle.obj", 250);
}

static void tank(void **state)
{
    (void)state;
    expect_good("mixing_tank/tank.obj", 30);
}

static void stirrer(void **state)
{
    (void)state;
    expect_good("mixing_tank/stirrer.obj", 100);
}

/* A box of two named parts with a degenerate triangle, on several pages. */
static sp_mesh *parted_box(void)
{
    sp_vec3 vertices[8];
    for (int i = 0; i < 8; i++)
        vertices[i] = sp_v(i & 1 ? 1 / 3. : 0, i & 2 ? 0.7 : 0, i & 4 ? 0.1 : 0);
    const uint32_t triangles[13][3] = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 1}, {0, 1, 5}, {0, 5, 4},
                                       {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    const uint32_t part[13] = {0, 0, 1, 1, 1, 0, 0, 0, 0, 1, 1, 1, 1};
    const char *const names[] = {"shell", "lid"};
    sp_error error = {0};
    sp_mesh *mesh = sp_mesh_create(vertices, 8, triangles, 13, part, names, 2, &error);
    if (!mesh)
        fail_msg("%s", error.message);
    return mesh;
}

typedef struct {
    double v[8][3], vt[64][2];
    size_t v_count, vt_count, f_count;
    unsigned v_index[13][3], vt_index[13][3], page[13];
    char group[13][16];
} parsed;

static void parse(char *text, parsed *p)
{
    char group[16] = "";
    unsigned page = 99;
    memset(p, 0, sizeof *p);
    for (char *line = strtok(text, "\n"); line; line = strtok(NULL, "\n")) {
        if (strncmp(line, "v ", 2) == 0) {
            double *v = p->v[p->v_count++];
            assert_int_equal(sscanf(line, "v %lf %lf %lf", &v[0], &v[1], &v[2]), 3);
        } else if (strncmp(line, "vt ", 3) == 0) {
            double *vt = p->vt[p->vt_count++];
            assert_int_equal(sscanf(line, "vt %lf %lf", &vt[0], &vt[1]), 2);
        } else if (line[0] == 'f') {
            unsigned *v = p->v_index[p->f_count], *vt = p->vt_index[p->f_count];
            assert_int_equal(sscanf(line, "f %u/%u %u/%u %u/%u", &v[0], &vt[0], &v[1], &vt[1], &v[2], &vt[2]), 6);
            strcpy(p->group[p->f_count], group);
            p->page[p->f_count++] = page;
        } else if (line[0] == 'g') {
            assert_int_equal(sscanf(line, "g %15s", group), 1);
        } else if (line[0] != '#') {
            assert_int_equal(sscanf(line, "usemtl page_%u", &page), 1);
        }
    }
}

static void obj_reads_back(void **state)
{
    (void)state;
    sp_mesh *mesh = parted_box();
    sp_atlas *atlas = atlas_of(mesh, 0.02, 36);
    assert_true(atlas->page_count > 1);
    char *text = sp_atlas_obj(atlas, mesh, NULL);
    assert_non_null(text);
    static parsed p;
    parse(text, &p);
    free(text);
    assert_int_equal(p.v_count, 8);
    assert_int_equal(p.f_count, 13);
    size_t laid = 0;
    for (size_t f = 0; f < 13; f++) {
        assert_string_equal(p.group[f], mesh->parts[mesh->source_part[f]].name);
        for (int i = 0; i < 3; i++) {
            sp_vec3 vertex = mesh->vertices[mesh->source_triangles[f][i]];
            const double *v = p.v[p.v_index[f][i] - 1];
            assert_true(v[0] == vertex.x && v[1] == vertex.y && v[2] == vertex.z);
            assert_true(p.vt_index[f][i] >= 1 && p.vt_index[f][i] <= p.vt_count);
        }
        if (f == 4) /* the degenerate one */
            continue;
        assert_int_equal(p.page[f], atlas->chart_page[atlas->chart[laid]]);
        for (int i = 0; i < 3; i++)
            for (int k = 0; k < 2; k++)
                assert_true(p.vt[p.vt_index[f][i] - 1][k] == atlas->uv[laid][i][k] / atlas->page_edge);
        laid++;
    }
    sp_atlas_destroy(atlas);
    sp_mesh_destroy(mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(beetle), cmocka_unit_test(tank), cmocka_unit_test(stirrer),
                                       cmocka_unit_test(obj_reads_back)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
