/* Each reader of files, with each of its allocations failing in turn: it says so and leaves nothing, or reads the same.
 */
#include <sprayplan/atlas.h>
#include <sprayplan/result.h>
#include <sprayplan/scene.h>

#include "../cli/faults/each.h"
#include "mesh/cad/stream.h"
#include "mesh_files.h"

#ifdef SPRAYPLAN_SANITIZE
#define SANITIZED true
#else
#define SANITIZED false
#endif

/* A file of this process's own. */
static void write_own(const char *name, const char *extension, const char *text, char path[128])
{
    snprintf(path, 128, "%s-test-%ld%s", name, (long)getpid(), extension);
    FILE *file = fopen(path, "wb");
    assert_true(file && fputs(text, file) >= 0 && fclose(file) == 0);
}

static bool read_mesh(const char *extension, const void *bytes, size_t size, uint64_t *digest, sp_error *error)
{
    sp_mesh *mesh = read_bytes(extension, bytes, size, error);
    if (!mesh)
        return false;
    *digest = hash(*digest, mesh->vertices, mesh->vertex_count * sizeof *mesh->vertices);
    *digest = hash(*digest, mesh->triangles, mesh->triangle_count * sizeof *mesh->triangles);
    for (size_t i = 0; i < mesh->part_count; i++)
        *digest = hash(*digest, mesh->parts[i].name, strlen(mesh->parts[i].name) + 1);
    sp_mesh_destroy(mesh);
    return true;
}

static const char obj[] =
    "mtllib none.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\ng floor\n"
    "f 1 2 3 4\ng ceiling\nf 5 8 7 6\ng walls\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf -5 -1 -4 -8\n";

static bool read_obj(uint64_t *digest, sp_error *error)
{
    return read_mesh(".obj", obj, sizeof obj - 1, digest, error);
}

static bool read_stl_text(uint64_t *digest, sp_error *error)
{
    static const char text[] = "solid lid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
                               "endloop\nendfacet\nendsolid lid\nsolid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 2\n"
                               "vertex 1 0 2\nvertex 0 1 2\nendloop\nendfacet\nendsolid\n";
    return read_mesh(".stl", text, sizeof text - 1, digest, error);
}

static bool read_stl_binary(uint64_t *digest, sp_error *error)
{
    enum { TRIANGLES = 300 };
    unsigned char bytes[84 + 50 * TRIANGLES] = {0};
    const uint32_t count = TRIANGLES;
    memcpy(bytes + 80, &count, sizeof count);
    for (int i = 0; i < TRIANGLES; i++) {
        const float corners[9] = {(float)i, 0, 0, (float)i + 1, 0, 0, (float)i, 1, 0};
        memcpy(bytes + 84 + 50 * i + 12, corners, sizeof corners);
    }
    return read_mesh(".stl", bytes, sizeof bytes, digest, error);
}

static bool read_ply(uint64_t *digest, sp_error *error)
{
    static const char text[] = "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n"
                               "property float z\nelement face 3\nproperty list uchar int vertex_indices\nend_header\n"
                               "0 0 0\n1 0 0\n1 1 0\n0 1 0\n.9 .1 0\n4 0 1 2 3\n3 0 2 1\n4 1 4 2 0\n";
    return read_mesh(".ply", text, sizeof text - 1, digest, error);
}

/* What sp_atlas_obj wrote of the room, read as an atlas. */
static char *unfolded;

static bool unfold(sp_error *error)
{
    sp_mesh *mesh = read_text(".obj", obj, error);
    sp_charts *charts = mesh ? sp_charts_create(mesh, 100, error) : NULL;
    const sp_atlas_options options = {.texel = 0.1, .page_edge = 64};
    sp_atlas *atlas = charts ? sp_atlas_create(mesh, charts, &options, error) : NULL;
    unfolded = atlas ? sp_atlas_obj(atlas, mesh, error) : NULL;
    sp_atlas_destroy(atlas);
    sp_charts_destroy(charts);
    sp_mesh_destroy(mesh);
    return unfolded != NULL;
}

static bool read_atlas(uint64_t *digest, sp_error *error)
{
    char path[128];
    write_own("atlas", ".obj", unfolded, path);
    sp_mesh *mesh = sp_mesh_load(path, 1, error);
    sp_atlas *atlas = mesh ? sp_atlas_reuse(mesh, path, 0, error) : NULL;
    char *text = atlas ? sp_atlas_obj(atlas, mesh, error) : NULL;
    if (text)
        *digest = hash(*digest, text, strlen(text));
    free(text);
    sp_atlas_destroy(atlas);
    sp_mesh_destroy(mesh);
    assert_int_equal(remove(path), 0);
    return text != NULL;
}

static bool write_atlas(uint64_t *digest, sp_error *error)
{
    char *before = unfolded;
    bool good = unfold(error);
    if (good)
        *digest = hash(*digest, unfolded, strlen(unfolded));
    free(unfolded);
    unfolded = before;
    return good;
}

static bool read_scene_at(const char *path, uint64_t *digest, sp_error *error)
{
    static const char *const overrides[] = {"simulate.texel=20 mm", "place.max_nozzles=7"};
    sp_scene *scene = sp_scene_load_with(path, overrides, 2, NULL, error);
    const sp_fidelity fidelity = {
        .texel = 0.02, .jets = 100, .accuracy = 0.01, .trajectory = SP_TRAJECTORY_LINE, .method = SP_METHOD_INVERSE};
    char *text = scene ? sp_scene_text(scene, sp_scene_layout(scene), &fidelity, "not/there", error) : NULL;
    if (text)
        *digest = hash(*digest, text, strlen(text));
    for (size_t i = 0; text && i < sp_scene_file_count(scene); i++) {
        char *file = sp_scene_file_path(scene, i, error);
        if (!file) {
            free(text);
            text = NULL;
        }
        free(file);
    }
    free(text);
    sp_scene_destroy(scene);
    return text != NULL;
}

static bool read_scene(uint64_t *digest, sp_error *error)
{
    return read_scene_at(SOURCE_DIR "/scenes/tunnel_washer.yaml", digest, error);
}

/* Its catalogue has an image. */
static bool read_image(uint64_t *digest, sp_error *error)
{
    static const char scene[] = "geometry:\n  - {file: " SOURCE_DIR "/scenes/tunnel_crate.obj, unit: mm}\n"
                                "cavity: outside\ncatalogue: " SOURCE_DIR "/scenes/measured.yaml\nnozzles:\n"
                                "  - {name: N, type: full-cone-90-24-measured, position: [0, 0, 2], axis: [0, 0, -1], "
                                "pressure: 2 bar}\n";
    char path[128];
    write_own("scene", ".yaml", scene, path);
    bool good = read_scene_at(path, digest, error);
    assert_int_equal(remove(path), 0);
    return good;
}

/* Two bodies of one name, as sprayplan-cad sends them, in pieces. */
static size_t put_record(unsigned char *to, uint32_t kind, const void *bytes, size_t size)
{
    sp_cad_record record = {kind, (uint32_t)size};
    memcpy(to, &record, sizeof record);
    memcpy(to + sizeof record, bytes, size);
    return sizeof record + size;
}

static size_t put_body(unsigned char *to)
{
    static const double corners[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    static const uint32_t face[3] = {0, 1, 2};
    unsigned char part[sizeof(double) + 11] = {0};
    memcpy(part + sizeof(double), "vessel\0lid", 11);
    size_t size = put_record(to, SP_CAD_PART, part, sizeof part);
    size += put_record(to + size, SP_CAD_VERTICES, corners, sizeof corners);
    return size + put_record(to + size, SP_CAD_TRIANGLES, face, sizeof face);
}

static bool read_pipe(uint64_t *digest, sp_error *error)
{
    unsigned char bytes[1024];
    const uint32_t format = SP_CAD_FORMAT;
    const sp_cad_fineness fineness = {.chord = 1e-3, .angle = 0.1, .sewing = 1e-5, .sewn = 4};
    const sp_cad_totals totals = {2, 6, 2};
    size_t size = put_record(bytes, SP_CAD_GREETING, &format, sizeof format);
    size += put_record(bytes + size, SP_CAD_FINENESS, &fineness, sizeof fineness);
    size += put_body(bytes + size);
    size += put_body(bytes + size);
    size += put_record(bytes + size, SP_CAD_END, &totals, sizeof totals);
    sp_soup soup = {0};
    sp_cad_stream stream = sp_cad_stream_open("some.step", &soup);
    bool good = true;
    for (size_t at = 0; good && at < size; at += 16)
        good = sp_cad_stream_take(&stream, bytes + at, size - at < 16 ? size - at : 16, error);
    for (size_t i = 0; good && i < soup.part_count; i++)
        *digest = hash(*digest, soup.part_names[i], strlen(soup.part_names[i]) + 1);
    if (good)
        *digest = hash(*digest, soup.vertices, soup.vertex_count * sizeof *soup.vertices);
    sp_cad_stream_clear(&stream);
    sp_soup_clear(&soup);
    return good;
}

static const char result_json[] =
    "{\"sprayplan\": \"0.1.0\", \"layouts\": [{\"name\": \"manual\", \"water_l_min\": 60, \"covered_area_m2\": 4, "
    "\"coverage\": 0.8, \"nozzles\": []}, {\"name\": \"b\", \"water_l_min\": 30, \"coverage\": 0.9, "
    "\"covered_area_m2\": "
    "4.5, \"shadows\": [{\"area_m2\": 0.5, \"centroid_m\": [1, 2, 3], \"part\": \"lid\"}, {}], \"nozzles\": "
    "[{\"name\": "
    "\"N1\", \"type\": \"t\", \"order_code\": \"c\", \"url\": \"http://u\", \"position_m\": [0, 0, 1.5], \"axis\": [0, "
    "0, "
    "-1], \"roll_rad\": 0, \"pressure_pa\": 200000, \"flow_l_min\": 30}]}]}";

static bool read_result(uint64_t *digest, sp_error *error)
{
    char path[128];
    write_own("result", ".json", result_json, path);
    size_t count = 0;
    sp_figures *figures = sp_figures_read(path, &count, error);
    assert_int_equal(remove(path), 0);
    for (size_t i = 0; figures && i < count; i++) {
        *digest = hash(*digest, figures[i].name, strlen(figures[i].name) + 1);
        *digest = hash(*digest, &figures[i].coverage, sizeof figures[i].coverage);
    }
    sp_figures_destroy(figures, count);
    return figures != NULL;
}

static void each_reader(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        attempt *read;
        long step[2]; /* where each takes long; under the sanitizers */
    } readers[] = {
        {"OBJ", read_obj, {1, 1}},
        {"STL, text", read_stl_text, {1, 1}},
        {"STL, binary", read_stl_binary, {1, 1}},
        {"PLY", read_ply, {1, 1}},
        {"result.json", read_result, {1, 1}},
        {"pipe of sprayplan-cad", read_pipe, {1, 1}},
        {"atlas made", write_atlas, {1, 5}},
        {"atlas OBJ", read_atlas, {1, 1}},
        {"scene, catalogue", read_scene, {8, 60}},
        {"image", read_image, {1, 20}},
    };
    sp_error error = {0};
    bool every = getenv("SPRAYPLAN_LONG");
    assert_true(unfold(&error));
    for (size_t i = 0; i < sizeof readers / sizeof *readers; i++)
        print_message("%s: %ld allocations\n", readers[i].name,
                      fail_each(readers[i].name, readers[i].read, every ? 1 : readers[i].step[SANITIZED]));
    free(unfolded);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(each_reader)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
