/* Whatever is to be read and is not there is named by the error, for a program of any kind. */
#include <sprayplan/sprayplan.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#define MISSING "nowhere/to-be-found"

static const char *at;

static void *scene(sp_error *error)
{
    return sp_scene_load(at, error);
}

static void *mesh(sp_error *error)
{
    return sp_mesh_load(at, 1, error);
}

static void *figures(sp_error *error)
{
    size_t count;
    return sp_figures_read(at, &count, error);
}

static void *digest(sp_error *error)
{
    char text[SP_SHA256];
    return sp_file_sha256(at, text, error) ? (void *)at : NULL;
}

static void *image(sp_error *error)
{
    static const char *const names[] = {"liquid", "speed"};
    return sp_image_read(at, 1, 1, names, error).values;
}

static void each_names_it(void **state)
{
    (void)state;
    static const struct {
        const char *path;
        void *(*read)(sp_error *error);
    } cases[] = {
        {MISSING ".yaml", scene}, {MISSING ".obj", mesh},  {MISSING ".stl", mesh},
        {MISSING ".ply", mesh},   {MISSING ".step", mesh}, {MISSING ".json", figures},
        {MISSING ".obj", digest}, {MISSING ".png", image}, {MISSING ".tif", image},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        sp_error error = {0};
        char text[1400];
        at = cases[i].path;
        assert_null(cases[i].read(&error));
        if (error.kind == SP_ERROR_UNSUPPORTED) /* built without CAD files */
            continue;
        assert_string_equal(error.file, at);
        sp_error_text(&error, text, sizeof text);
        assert_ptr_equal(strstr(text, at), text);
        assert_non_null(strstr(text, "No such file or directory"));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_names_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
