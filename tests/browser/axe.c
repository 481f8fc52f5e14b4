/* The report to who does not see it, or not well: axe-core (https://github.com/dequelabs/axe-core, MPL-2.0) finds no
 * serious fault in the page, as it opens and in use, wide and narrow, light and dark. It is no part of the project: the
 * test takes the axe.min.js that the environment's SPRAYPLAN_AXE names or, of `npm install --no-save axe-core`, the one
 * in the project, beside it or where npm keeps what is installed for all; without one it is skipped. */
#include "devtools.h"

static const char scene_yaml[] =
    "geometry:\n"
    "  - file: room.obj\n"
    "cavity: [0.5 m, 0.5 m, 0.5 m]\n"
    "criterion: {flux: 1 L/min/m2}\n"
    "catalogue: catalogue.yaml\n"
    "nozzles:\n"
    "  - {name: N1, type: cone, position: [0.5 m, 0.5 m, 0.9 m], axis: [0, 0, -1], pressure: 2 bar}\n"
    "simulate: {texel: 100 mm}\n"
    "place:\n"
    "  coverage: 75 %\n"
    "  max_nozzles: 3\n"
    "  pressure: 2 bar\n"
    "  types: [cone]\n"
    "  refine: none\n"
    "  mounts:\n"
    "    - port: {name: P1, position: [0.3 m, 0.3 m, 0.9 m], axis: [0, 0, -1], tilt: 30 deg}\n"
    "    - surface: {name: walls, geometry: 0, part: walls, spacing: 500 mm, standoff: 40 mm, tilt: 30 deg}\n"
    "  alternatives:\n"
    "    - {name: port alone, mounts: [P1]}\n"
    "    - {name: free choice}\n";

static char *axe; /* its text; NULL: none is here */

static char *read_whole(const char *path)
{
    FILE *file = fopen(path, "rb");
    if (!file)
        return NULL;
    assert_int_equal(fseek(file, 0, SEEK_END), 0);
    size_t size = (size_t)ftell(file);
    char *text = calloc(size + 1, 1);
    rewind(file);
    assert_int_equal(fread(text, 1, size, file), size);
    fclose(file);
    return text;
}

static void find_axe(void)
{
    static const char *const places[] = {
        SOURCE_DIR "/node_modules/axe-core/axe.min.js", SOURCE_DIR "/../node_modules/axe-core/axe.min.js",
        "/usr/local/lib/node_modules/axe-core/axe.min.js", "/usr/lib/node_modules/axe-core/axe.min.js"};
    const char *named = getenv("SPRAYPLAN_AXE");
    axe = named ? read_whole(named) : NULL;
    if (named && !axe)
        fprintf(stderr, "SPRAYPLAN_AXE: %s cannot be read\n", named);
    for (size_t i = 0; !named && !axe && i < sizeof places / sizeof *places; i++)
        axe = read_whole(places[i]);
}

static int find_and_place(void **state)
{
    find_axe();
    if (!axe || !has_browser())
        return open_workplace(state);
    if (place_once(state) != 0)
        return -1;
    write_file("choice.yaml", scene_yaml);
    outcome result = run_program("place choice.yaml -o choice --quiet");
    int status = result.status;
    forget(&result);
    return status == 0 ? 0 : -1;
}

static int forget_axe(void **state)
{
    free(axe);
    return close_workplace(state);
}

static void skip_without_axe(void)
{
    skip_without_browser();
    if (!axe) {
        print_message("axe-core is not here (SPRAYPLAN_AXE names its axe.min.js): the page is not asked\n");
        skip();
    }
}

static void show(devtools *page, int width, const char *scheme)
{
    json_decref(devtools_ask(
        page, "Emulation.setDeviceMetricsOverride",
        json_pack("{s:i, s:i, s:i, s:b}", "width", width, "height", 1000, "deviceScaleFactor", 1, "mobile", 0)));
    json_decref(
        devtools_ask(page, "Emulation.setEmulatedMedia",
                     json_pack("{s:[{s:s, s:s}]}", "features", "name", "prefers-color-scheme", "value", scheme)));
}

static void expect_no_fault(devtools *page, const char *when)
{
    json_t *told = devtools_evaluate(page, "asked.faults()"), *fault;
    bool serious = false;
    size_t i;
    json_array_foreach(json_object_get(told, "faults"), i, fault)
    {
        const char *impact = json_string_value(json_object_get(fault, "impact"));
        serious |= !impact || strcmp(impact, "serious") == 0 || strcmp(impact, "critical") == 0;
        print_message("%s: %s: %s: %s\n", when, impact ? impact : "", json_string_value(json_object_get(fault, "help")),
                      json_string_value(json_object_get(fault, "at")));
    }
    assert_true(json_integer_value(json_object_get(told, "checked")) > 20);
    json_decref(told);
    assert_false(serious);
}

static void expect_none_in_any_light(devtools *page, const char *state)
{
    static const int widths[] = {1280, 420};
    static const char *const schemes[] = {"light", "dark"};
    for (int w = 0; w < 2; w++)
        for (int k = 0; k < 2; k++) {
            char when[100];
            snprintf(when, sizeof when, "%s, %d px, %s", state, widths[w], schemes[k]);
            show(page, widths[w], schemes[k]);
            expect_no_fault(page, when);
        }
}

static void ask_about(const char *report)
{
    devtools page;
    write_page_with_reader(report, "", "axe.js");
    devtools_open(&page, "read.html");
    devtools_wait(&page, "asked");
    json_decref(devtools_evaluate(&page, "asked.ready()"));
    json_decref(devtools_evaluate(&page, axe));
    expect_none_in_any_light(&page, "as it opens");
    json_t *said = devtools_evaluate(&page, "asked.use()");
    assert_non_null(strstr(json_string_value(said), "region 1"));
    assert_non_null(strstr(json_string_value(said), " at "));
    json_decref(said);
    expect_none_in_any_light(&page, "in use");
    devtools_close(&page);
}

static void a_proposal(void **state)
{
    (void)state;
    skip_without_axe();
    ask_about("placed/report.html");
}

static void alternatives(void **state)
{
    (void)state;
    skip_without_axe();
    ask_about("choice/report.html");
}

/* A picture without a text and words too pale are found: axe is there, and asked. */
static void what_is_wrong_is_found(void **state)
{
    (void)state;
    skip_without_axe();
    devtools page;
    write_file("wrong.html", "<!doctype html><html lang=\"en\"><head><title>wrong</title></head><body><main><h1>A</h1>"
                             "<img src=\"data:,\"><p style=\"color:#ddd\">pale</p></main></body></html>");
    write_page_with_reader("wrong.html", "", "axe.js");
    devtools_open(&page, "read.html");
    devtools_wait(&page, "asked");
    json_decref(devtools_evaluate(&page, axe));
    json_t *told = devtools_evaluate(&page, "asked.faults()");
    assert_int_equal(json_array_size(json_object_get(told, "faults")), 2);
    json_decref(told);
    devtools_close(&page);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_proposal),
        cmocka_unit_test(alternatives),
        cmocka_unit_test(what_is_wrong_is_found),
    };
    return cmocka_run_group_tests(tests, find_and_place, forget_axe);
}
