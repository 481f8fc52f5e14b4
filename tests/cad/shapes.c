/* STEP, IGES and BREP files of known area and volume. */
#include "files.h"

#include <pthread.h>
#include <sys/stat.h>

#include "mesh/cad/mend.h"
#include "mesh/cad/process.h"

/* Closed, and the volumes of triangles and of the body to these shares of `volume`. */
static void expect_body(const sp_mesh *mesh, const double *own, uint32_t part, double volume, double off, double exact)
{
    assert_true(fabs(own[part] / volume - 1) < off);
    assert_true(fabs(mesh->parts[part].volume / volume - 1) < exact);
}

/* Of the hemisphere about (2 m, 0, 0): middles of triangles and edges that lie off the sphere by no more than that. */
static void expect_within_chord(const sp_mesh *mesh, uint32_t part, double chord)
{
    static const double at[4][2] = {{1.0 / 3, 1.0 / 3}, {0.5, 0}, {0, 0.5}, {0.5, 0.5}};
    size_t seen = 0;
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        if (mesh->part[t] != part || sp_triangle_point(mesh, t, 1.0 / 3, 1.0 / 3).z > -1e-6) /* its lid */
            continue;
        seen++;
        for (int k = 0; k < 4; k++)
            assert_true(0.5 - sp_distance(sp_triangle_point(mesh, t, at[k][0], at[k][1]), sp_v(2, 0, 0)) < chord);
    }
    assert_true(seen > 1000);
}

static void expect_round(const char *path, double unit, const char *const names[2])
{
    sp_cad_options options = sp_cad_options_default();
    sp_cad_account account;
    double own[2];
    options.chord = 0.5e-3;
    sp_mesh *mesh = load_cad(path, unit, &options, &account);
    assert_int_equal(mesh->part_count, 2);
    assert_true(sp_mesh_volumes(mesh, own, NULL));
    assert_true(account.faults == 0 && account.chord == options.chord && account.angle == options.angle);
    uint32_t cylinder = 0; /* IGES keeps no order */
    if (fabs(own[0] - M_PI / 4) > 0.1)
        cylinder = 1;
    assert_string_equal(mesh->parts[0].name, names[0]);
    assert_string_equal(mesh->parts[1].name, names[1]);
    expect_within_chord(mesh, 1 - cylinder, options.chord);
    assert_true(fabs(part_area(mesh, cylinder) / (M_PI + M_PI / 2) - 1) < 5e-4);
    assert_true(fabs(part_area(mesh, 1 - cylinder) / (M_PI * 0.75) - 1) < 5e-4);
    expect_body(mesh, own, cylinder, M_PI / 4, 1e-3, 1e-9);
    expect_body(mesh, own, 1 - cylinder, M_PI / 12, 1e-3, 1e-6);
    sp_mesh_destroy(mesh);
}

static void areas_and_volumes_are_known(void **state)
{
    (void)state;
    static const char *const named[] = {"cylinder", "hemisphere"}, *const unnamed[] = {"body", "body#2"};
    need_cad();
    expect_round("round.step", 1, named);
    expect_round("round.igs", 1, unnamed);
    expect_round("round.brep", 1e-3, unnamed);
}

/* The default is a thousandth of the diagonal, or less where that is asked for; what was kept gives the same again. */
static void the_chord_follows_the_size(void **state)
{
    (void)state;
    need_cad();
    sp_cad_options options = sp_cad_options_default();
    sp_cad_account account, again;
    sp_vec3 low, high;
    sp_mesh *mesh = load_cad("round.step", 1, &options, &account);
    assert_true(fabs(account.chord / (1e-3 * sp_mesh_box(mesh, &low, &high)) - 1) < 0.05);
    options.chord = account.chord;
    sp_mesh *same = load_cad("round.step", 1, &options, &again);
    assert_int_equal(same->vertex_count, mesh->vertex_count);
    assert_memory_equal(same->vertices, mesh->vertices, mesh->vertex_count * sizeof *mesh->vertices);
    sp_mesh_destroy(same);
    sp_mesh_destroy(mesh);
    options.chord = 0;
    options.chord_most = 1e-3;
    mesh = load_cad("round.step", 1, &options, &again);
    assert_true(again.chord == options.chord_most && again.triangles > account.triangles);
    sp_mesh_destroy(mesh);
}

static void refuse(const char *path, double unit, sp_error_kind kind, const char *what)
{
    const sp_cad_options options = sp_cad_options_default();
    sp_error error = {0};
    assert_null(sp_cad_load(path, unit, &options, NULL, &error));
    if (error.kind != kind || !strstr(error.message, what) || strcmp(error.file, path) != 0)
        fail_msg("%s: %d, %s", error.file, error.kind, error.message);
}

static void put_file(const char *path, const char *text)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
}

static void what_is_none_is_refused(void **state)
{
    (void)state;
    refuse("no-such.step", 1, SP_ERROR_INPUT, "cannot be opened");
    refuse("mesh.obj", 1, SP_ERROR_INPUT, "file of unknown kind");
    refuse("some.step", 1e-3, SP_ERROR_ARGUMENT, "and 1 for a file that knows its own");
    refuse("some.brep", 0, SP_ERROR_ARGUMENT, "expected a positive one");
    need_cad();
    static const char *const paths[] = {"garbage.step", "garbage.iges", "garbage.brp"};
    for (int i = 0; i < 3; i++) {
        put_file(paths[i], i ? "no CAD file at all\n" : "");
        refuse(paths[i], 1, SP_ERROR_INPUT, "");
        assert_int_equal(remove(paths[i]), 0);
    }
    put_file("binary.brep", "\nOpen CASCADE Topology V4, (c) Open Cascade\n\x01\x02");
    refuse("binary.brep", 1, SP_ERROR_INPUT, "found a binary BREP file, expected one of text, or STEP");
    assert_int_equal(remove("binary.brep"), 0);
    assert_int_equal(mkdir("folder.step", 0755), 0);
    refuse("folder.step", 1, SP_ERROR_INPUT, "no regular file");
    assert_int_equal(rmdir("folder.step"), 0);
}

static bool stop(void *user, const char *stage, double done)
{
    double *last = user;
    assert_string_equal(stage, "geometry");
    assert_true(done >= *last);
    *last = done;
    return done < 0.2;
}

static void reading_can_be_cancelled(void **state)
{
    (void)state;
    need_cad();
    sp_cad_options options = sp_cad_options_default();
    double last = 0;
    sp_error error = {0};
    options.run = (sp_run){.progress = stop, .user = &last};
    assert_null(sp_cad_load("round.step", 1, &options, NULL, &error));
    assert_int_equal(error.kind, SP_ERROR_INTERRUPTED);
}

/* IGES knows faces only; the vessel's lid and its shell share the rim's edge. */
static void bodies_that_touch_are_told_apart(void **state)
{
    (void)state;
    need_cad();
    const double shell = M_PI * (0.505 * 0.505 - 0.25) + 2 * M_PI / 3 * (0.505 * 0.505 * 0.505 - 0.125),
                 foot = M_PI * 0.03 * 0.03 * 0.4, blade = 0.3 * 0.01 * 0.087;
    const double volumes[8] = {
        shell, M_PI * 0.505 * 0.505 * 0.005, M_PI * 0.02 * 0.02 * 0.9025, blade, blade, foot, foot, foot};
    const sp_cad_options options = sp_cad_options_default();
    sp_cad_account account;
    double own[8];
    make_cad("vessel", "touching.igs", "");
    sp_mesh *mesh = load_cad("touching.igs", 1, &options, &account);
    assert_int_equal(mesh->part_count, 8);
    assert_int_equal(account.sewn, 32);
    assert_true(sp_mesh_volumes(mesh, own, NULL));
    for (uint32_t i = 0; i < 8; i++)
        expect_body(mesh, own, i, volumes[i], 2e-2, 1e-6);
    sp_mesh_destroy(mesh);
    assert_int_equal(remove("touching.igs"), 0);
}

static void expect_limited(const char *chord, const char *bytes, const char *seconds, const char *what)
{
    char *const arguments[] = {(char *)BINARY_DIR "/libexec/sprayplan/sprayplan-cad",
                               (char *)"step",
                               (char *)"round.step",
                               (char *)"1e-3",
                               (char *)chord,
                               (char *)"0",
                               (char *)"0.1",
                               (char *)bytes,
                               (char *)seconds,
                               NULL};
    sp_soup soup = {0};
    sp_cad_stream stream = sp_cad_stream_open("round.step", &soup);
    sp_error error = {0};
    const sp_run run = {0};
    assert_false(sp_cad_process_run(arguments, 1000, &stream, &run, &error));
    if (error.kind != SP_ERROR_INPUT || strcmp(error.file, "round.step") != 0 || !strstr(error.message, what))
        fail_msg("%s: %d, %s", error.file, error.kind, error.message);
    sp_cad_stream_clear(&stream);
    sp_soup_clear(&soup);
}

/* Too little of either. */
static void memory_and_time_are_limited(void **state)
{
    (void)state;
    need_cad();
    expect_limited("1e-6", "1.3e8", "40", "a longer chord takes less");
    if (getenv("SPRAYPLAN_LONG"))
        expect_limited("1e-7", "1e11", "1", "more processor time");
}

static void *load_one(void *into)
{
    const sp_cad_options options = sp_cad_options_default();
    *(sp_mesh **)into = sp_cad_load("round.step", 1, &options, NULL, NULL);
    return NULL;
}

static void threads_load_at_once(void **state)
{
    (void)state;
    enum { THREADS = 3 };
    pthread_t threads[THREADS];
    sp_mesh *meshes[THREADS];
    need_cad();
    for (int i = 0; i < THREADS; i++)
        assert_int_equal(pthread_create(&threads[i], NULL, load_one, &meshes[i]), 0);
    for (int i = 0; i < THREADS; i++) {
        assert_int_equal(pthread_join(threads[i], NULL), 0);
        assert_non_null(meshes[i]);
        assert_int_equal(meshes[i]->vertex_count, meshes[0]->vertex_count);
        assert_memory_equal(meshes[i]->vertices, meshes[0]->vertices,
                            meshes[0]->vertex_count * sizeof *meshes[0]->vertices);
    }
    for (int i = 0; i < THREADS; i++)
        sp_mesh_destroy(meshes[i]);
}

/* A tetrahedron one of whose edges has been cut in three, with triangles without area in between, and a point twice. */
static void triangles_without_area_open_no_edge(void **state)
{
    (void)state;
    static const sp_vec3 points[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.25, 0, 0}, {0.75, 0, 0}, {0, 1, 0}};
    static const uint32_t triangles[][3] = {{0, 2, 1}, {0, 4, 3}, {4, 5, 3}, {5, 1, 3}, {0, 3, 2},
                                            {1, 2, 3}, {0, 1, 5}, {0, 5, 4}, {2, 6, 3}, {2, 2, 2}};
    sp_error error = {0};
    size_t mended = 0;
    double volume;
    sp_mesh_diagnosis diagnosis;
    sp_mesh *mesh = sp_mesh_create(points, 7, triangles, 10, NULL, NULL, 1, &error);
    assert_true(sp_mesh_volumes(mesh, &volume, &error));
    assert_true(volume == 0);
    mesh = sp_cad_mend(mesh, &mended, &error);
    assert_non_null(mesh);
    assert_true(sp_mesh_diagnose(mesh, &diagnosis, &error));
    assert_int_equal(diagnosis.open_edges.count, 0);
    assert_int_equal(diagnosis.closed_shells, 1);
    assert_int_equal(diagnosis.degenerate.count, 0);
    assert_int_equal(mended, 4);
    assert_int_equal(mesh->triangle_count, 8);
    assert_true(sp_mesh_volumes(mesh, &volume, &error));
    assert_true(fabs(volume - 1.0 / 6) < 1e-15);
    sp_mesh_destroy(mesh);
    assert_null(sp_cad_mend(NULL, &mended, &error));
}

static int make_files(void **state)
{
    (void)state;
    if (access(MAKE_CAD, X_OK) == 0) {
        make_cad("round", "round.step", "");
        make_cad("round", "round.igs", "");
        make_cad("round", "round.brep", "");
    }
    return 0;
}

static int remove_files(void **state)
{
    (void)state;
    remove("round.step");
    remove("round.igs");
    remove("round.brep");
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(areas_and_volumes_are_known),
        cmocka_unit_test(the_chord_follows_the_size),
        cmocka_unit_test(what_is_none_is_refused),
        cmocka_unit_test(reading_can_be_cancelled),
        cmocka_unit_test(bodies_that_touch_are_told_apart),
        cmocka_unit_test(memory_and_time_are_limited),
        cmocka_unit_test(threads_load_at_once),
        cmocka_unit_test(triangles_without_area_open_no_edge),
    };
    return cmocka_run_group_tests(tests, make_files, remove_files);
}
