/* sprayplan bench: its rows and keys, and that everything that traces finds the same. Nothing here looks at a time. */
#include "results.h"

#include <sprayplan/sprayplan.h>

#ifdef SPRAYPLAN_SANITIZE
#define RAYS 200
#else
#define RAYS 1000
#endif
#define TEXT_OF(x) #x
#define TEXT(x) TEXT_OF(x)

static const char *const own[] = {"bvh", "sah", "naive", "none"};
static const char *const embree[] = {"embree-fast", "embree-robust"};
enum { OWN = sizeof own / sizeof *own };

static bool has_module(void)
{
    return access(BINARY_DIR "/sprayplan-embree.so", R_OK) == 0;
}

static void run_generator(const char *line)
{
    char command[2048];
    snprintf(command, sizeof command, "cd '%s' && '%s/scenes/'%s", workplace, BINARY_DIR, line);
    assert_int_equal(system(command), 0);
}

static int open_with_cube(void **state)
{
    if (open_workplace(state))
        return -1;
    run_generator("cube_mesh cube.obj");
    return 0;
}

static const char *text_of(const json_t *object, const char *key)
{
    const char *text = json_string_value(json_object_get(object, key));
    assert_non_null(text);
    return text;
}

static bool is_own(const json_t *row)
{
    for (int i = 0; i < OWN; i++)
        if (!strcmp(text_of(row, "accelerator"), own[i]))
            return true;
    return false;
}

/* Row for row of the trace, what of it names one kind of work. */
typedef struct {
    const char *mode, *trajectory, *query;
    bool sorted;
} work;

static bool is_of(const json_t *row, const work *work)
{
    return !strcmp(text_of(row, "mode"), work->mode) && !strcmp(text_of(row, "trajectory"), work->trajectory) &&
           !strcmp(text_of(row, "query"), work->query) && json_is_true(json_object_get(row, "sorted")) == work->sorted;
}

static const json_t *find_row(const json_t *rows, const work *work, const char *accelerator, const char *variant,
                              int threads)
{
    size_t i;
    const json_t *row;
    json_array_foreach(rows, i, row) if (is_of(row, work) && !strcmp(text_of(row, "accelerator"), accelerator) &&
                                         !strcmp(text_of(row, "variant"), variant) &&
                                         number(row, "threads") == threads) return row;
    return NULL;
}

static void expect_work(const json_t *rows, const work *work)
{
    double hits = -1;
    for (int i = 0; i < OWN; i++)
        for (int wave = 0; wave < 2; wave++) {
            const json_t *row = find_row(rows, work, own[i], wave ? "wave" : "single", 1);
            assert_non_null(row);
            assert_true(number(row, "rays") == RAYS);
            assert_true(number(row, "mrays_per_second") > 0);
            assert_true(number(row, "wrong_share") == 0);
            assert_true(number(row, "missed_share") == 0);
            if (hits < 0)
                hits = number(row, "hits");
            assert_true(number(row, "hits") == hits);
        }
    if (!strcmp(work->mode, "cone")) /* from inside a closed cube nothing escapes */
        assert_true(hits == RAYS);
    if (!strcmp(work->mode, "grid"))
        assert_true(hits > 0 && hits < RAYS);
    if (!strcmp(work->mode, "surface") && !strcmp(work->trajectory, "line")) /* nothing stands within a convex body */
        assert_true(hits == 0);
}

/* Single precision may take the neighbour at an edge, and chords are not the parabola. */
static void expect_embree_lines(const json_t *rows, const work *work)
{
    static const char *const variants[] = {"single", "packet16", "stream", "stream16"};
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 4; k++) {
            const json_t *row = find_row(rows, work, embree[i], variants[k], 1);
            assert_non_null(row);
            assert_true(number(row, "rays") == RAYS);
            assert_true(number(row, "wrong_share") + number(row, "missed_share") <= 0.01);
        }
    assert_non_null(find_row(rows, work, "embree-fast", "packet16", 2));
}

static void expect_embree_chords(const json_t *rows, const work *work)
{
    static const char *const ways[] = {"single", "packet16"};
    static const int counts[] = {8, 16, 32, 64};
    for (int k = 0; k < 2; k++) {
        double errors[4];
        for (int i = 0; i < 4; i++) {
            char variant[32];
            snprintf(variant, sizeof variant, "chords-%d-%s", counts[i], ways[k]);
            const json_t *row = find_row(rows, work, "embree-fast", variant, 1);
            assert_non_null(row);
            errors[i] = number(row, "wrong_share") + number(row, "missed_share");
        }
        assert_true(errors[3] <= errors[0]);
        assert_true(errors[3] <= 0.02);
    }
}

static void every_mode_is_measured_and_all_agree(void **state)
{
    (void)state;
    static const char *const modes[] = {"cone", "grid", "incoherent", "surface"};
    static const char *const trajectories[] = {"line", "parabola"}, *const queries[] = {"nearest", "occluded"};
    json_t *object = expect_json("bench cube.obj --rays " TEXT(RAYS) " --threads 2 --json", 0);
    const json_t *rows = json_object_get(object, "trace");
    size_t expected = 0;
    assert_true(json_is_array(rows));
    for (int m = 0; m < 4; m++)
        for (int t = 0; t < 2; t++)
            for (int q = m == 3; q < 2; q++)
                for (int sorted = 0; sorted < (m == 2 ? 1 : 2); sorted++) {
                    work work = {modes[m], trajectories[t], queries[q], sorted};
                    expect_work(rows, &work);
                    expected += 2 * OWN;
                    if (has_module() && t == 0)
                        expect_embree_lines(rows, &work);
                    else if (has_module() && (q == 0 || m == 3))
                        expect_embree_chords(rows, &work);
                }
    size_t i, found = 0;
    const json_t *row;
    json_array_foreach(rows, i, row) found += is_own(row) && number(row, "threads") == 1;
    assert_int_equal(found, expected);
    json_decref(object);
}

static void builds_and_the_rest_are_there(void **state)
{
    (void)state;
    json_t *object = expect_json("bench cube.obj --rays 64 --mode cone --trajectory line --threads 1 --json", 0);
    assert_string_equal(text_of(object, "mesh"), "cube.obj");
    assert_true(number(object, "triangles") == 1200);
    const json_t *row, *builds = json_object_get(object, "build"), *rows = json_object_get(object, "trace"),
                       *load = json_object_get(object, "load");
    assert_true(number(load, "seconds") > 0);
    assert_true(number(load, "bytes") == 602 * 24 + 1200 * 36);
    assert_true(number(load, "peak_bytes") >= number(load, "bytes"));
    size_t i, named = 0;
    json_array_foreach(builds, i, row)
    {
        assert_true(number(row, "bytes") > 1200);
        assert_true(number(row, "seconds") > 0);
        assert_true(number(row, "threads") == 1);
        named += is_own(row);
    }
    assert_int_equal(named, OWN);
    assert_int_equal(json_array_size(builds), has_module() ? OWN + 2 : OWN);
    json_array_foreach(rows, i, row)
    {
        assert_string_equal(text_of(row, "mode"), "cone");
        assert_string_equal(text_of(row, "trajectory"), "line");
    }
    assert_true(json_array_size(rows) > 0);
    json_decref(object);
}

/* What depends on the machine's haste. */
static void drop_measured(json_t *atlas)
{
    json_object_del(atlas, "seconds");
    json_object_del(atlas, "stages");
    json_object_del(atlas, "peak_bytes");
}

static void the_atlas_is_the_one_that_atlas_prints(void **state)
{
    (void)state;
    json_t *object = expect_json("bench cube.obj --rays 64 --mode cone --trajectory line --json", 0);
    json_t *alone = expect_json("atlas cube.obj --json", 0), *atlas = json_object_get(object, "atlas");
    assert_true(number(atlas, "seconds") > 0);
    assert_true(json_is_array(json_object_get(atlas, "stages")));
    drop_measured(alone);
    drop_measured(atlas);
    const char *key;
    json_t *value;
    assert_int_equal(json_object_size(alone), json_object_size(atlas));
    json_object_foreach(alone, key, value)
    {
        const json_t *other = json_object_get(atlas, key);
        assert_non_null(other);
        if (json_is_number(value)) /* bench prints fewer digits */
            assert_true(fabs(json_number_value(value) - json_number_value(other)) <=
                        1e-5 * fabs(json_number_value(value)));
        else
            assert_true(json_equal(value, other));
    }
    json_decref(alone);
    json_decref(object);
}

static void the_work_of_the_study_is_done(void **state)
{
    (void)state;
    static const char *const tables[] = {"table_4_3", "table_4_4"};
    json_t *object = expect_json("bench cube.obj --rays 64 --mode cone --trajectory line --json", 0);
    const json_t *study = json_object_get(object, "study"), *row;
    size_t i;
    for (int t = 0; t < 2; t++) {
        const json_t *rows = json_object_get(study, tables[t]);
        assert_int_equal(json_array_size(rows), OWN);
        json_array_foreach(rows, i, row)
        {
            assert_true(number(row, "rays") == 1000);
            assert_true(number(row, "hits") == 1000);
            assert_true(number(row, "seconds") > 0);
        }
    }
    assert_int_equal(json_array_size(json_object_get(study, "table_4_2")), OWN - 1);
    assert_true(number(json_object_get(study, "table_4_5"), "seconds") > 0);
    assert_true(number(json_object_get(json_object_get(study, "table_4_5"), "seconds_2008"), "horse") == 193);
    json_decref(object);
}

/* The program alone, as it is installed. */
static void embree_is_left_out_where_its_module_is_not(void **state)
{
    (void)state;
    char line[2048];
    snprintf(line, sizeof line,
             "cd '%s' && cp '%s/sprayplan' alone && ./alone bench cube.obj --rays 64 --mode cone "
             "--trajectory line >.out 2>.err",
             workplace, BINARY_DIR);
    assert_int_equal(system(line), 0);
    char *out = read_file(".out", NULL), *err = read_file(".err", NULL);
    assert_null(strstr(out, "embree"));
    assert_non_null(strstr(out, "sah"));
    assert_non_null(strstr(err, "Embree is left out"));
    free(out);
    free(err);
}

static void expect_closed(const char *name, size_t triangles, double area, double slack)
{
    char path[1024];
    sp_error error = {0};
    sp_mesh_diagnosis diagnosis;
    snprintf(path, sizeof path, "%s/%s", workplace, name);
    sp_mesh *mesh = sp_mesh_load(path, 1, &error);
    assert_non_null(mesh);
    assert_true(mesh->triangle_count >= triangles && mesh->triangle_count <= triangles + 1);
    assert_true(sp_mesh_diagnose(mesh, &diagnosis, &error));
    assert_int_equal(diagnosis.shells, 1);
    assert_int_equal(diagnosis.closed_shells, 1);
    assert_true(fabs(diagnosis.area - area) <= slack);
    sp_mesh_destroy(mesh);
}

static void generated_meshes_are_closed(void **state)
{
    (void)state;
    expect_closed("cube.obj", 1200, 6, 1e-12);
    run_generator("refine_mesh cube.obj 5000 fine.obj");
    run_generator("refine_mesh cube.obj 5000 again.obj");
    run_generator("refine_mesh cube.obj 5000 fine.stl");
    expect_closed("fine.obj", 5000, 6, 0.3);
    expect_closed("fine.stl", 5000, 6, 0.3);
    size_t size, again;
    char *one = read_file("fine.obj", &size), *two = read_file("again.obj", &again);
    assert_int_equal(size, again);
    assert_memory_equal(one, two, size);
    free(one);
    free(two);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_mode_is_measured_and_all_agree),       cmocka_unit_test(builds_and_the_rest_are_there),
        cmocka_unit_test(the_atlas_is_the_one_that_atlas_prints),     cmocka_unit_test(the_work_of_the_study_is_done),
        cmocka_unit_test(embree_is_left_out_where_its_module_is_not), cmocka_unit_test(generated_meshes_are_closed),
    };
    return cmocka_run_group_tests(tests, open_with_cube, close_workplace);
}
