/* A fitter with ruler and protractor: from the text of nozzles.csv alone, by arithmetic of his own, every nozzle comes
 * to stand and point where the layout has it, to a millimetre and a tenth of a degree. */
#include "../scene/scratch.h"

#include <sprayplan/result.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

enum { FIELDS = 40, WELDS = 12, NOZZLES = 4 + WELDS };

/* The datum as the test has it, not as it was read. */
typedef struct {
    const char *yaml;
    double origin[3], x[3], y[3], up[3];
    bool round;
} datum;

static const datum datums[] = {
    {"", {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, true},
    {"datum: {name: centre of the lid, origin: [0, 0, 1780 mm], axis: [0, 0, -2], zero: [0, 1, 3]}\n",
     {0, 0, 1.78},
     {0, 1, 0},
     {1, 0, 0},
     {0, 0, -1},
     true},
    {"datum: {name: flange F1, origin: [0.2, -10 cm, 1.5], axis: [0, 3, 4], zero: [2, 0, 0]}\n",
     {0.2, -0.1, 1.5},
     {1, 0, 0},
     {0, 0.8, -0.6},
     {0, 0.6, 0.8},
     false},
};

static char *file_text(const char *path)
{
    FILE *file = fopen(path, "rb");
    char *text = calloc(1, 100000);
    if (!file || !text || !fread(text, 1, 99999, file))
        abort();
    fclose(file);
    return text;
}

static sp_scene *open_vessel(const datum *d)
{
    char *text = file_text(SOURCE_DIR "/scenes/vessel.yaml");
    char *start = strstr(text, "\ndatum:");
    if (start)
        memmove(start + 1, strchr(start + 1, '\n') + 1, strlen(strchr(start + 1, '\n') + 1) + 1);
    strcat(text, d->yaml);
    scratch_write("vessel.yaml", text);
    free(text);
    text = file_text(SOURCE_DIR "/scenes/catalogue.yaml");
    scratch_write("catalogue.yaml", text);
    free(text);
    sp_error error = {0};
    sp_scene *scene = sp_scene_load("vessel.yaml", &error);
    if (!scene)
        fail_msg("%s", error.message);
    return scene;
}

/* Axes of every kind: along the lance, straight down and up, hardly off these, level, any. */
static sp_vec3 axis_of(size_t i)
{
    double t = (double)i;
    switch (i % 6) {
    case 0:
        return sp_v(0, 0, -1);
    case 1:
        return sp_unit(sp_v(1e-4, -3e-4, -1));
    case 2:
        return sp_unit(sp_v(3e-3, 1e-3, 1));
    case 3:
        return sp_unit(sp_v(cos(t), sin(t), 0));
    default:
        return sp_unit(sp_v(sin(3 * t), cos(5 * t), sin(7 * t)));
    }
}

/* Lances in the four ports, and welds all round the shell, of cones and fans. */
static sp_layout *layout_of(const sp_scene *scene)
{
    const sp_place_options place = sp_scene_place_options(scene);
    sp_layout *layout = sp_layout_create(NULL, NOZZLES, NULL);
    for (size_t i = 0; i < NOZZLES; i++) {
        sp_nozzle *nozzle = &layout->nozzles[i];
        double t = (double)i, around = 2 * M_PI * t / WELDS + 0.1;
        sp_vec3 port = place.mounts[i % 4].position, down = place.mounts[i % 4].axis;
        snprintf(nozzle->name, SP_NAME, "N%zu", i);
        for (size_t k = 0; k < place.type_count; k++)
            if (strcmp(place.types[k]->name, i % 3 ? "flat-fan-60-10" : "full-cone-90-12") == 0)
                nozzle->type = place.types[k];
        nozzle->position = i < 4 ? sp_along(port, 0.05 + 0.1234567 * t, down)
                                 : sp_v(0.56 * cos(around), 0.56 * sin(around), 0.1234567 * (t - 3) - 0.05);
        nozzle->axis = axis_of(i);
        nozzle->roll = 0.7 * t;
        nozzle->pressure = i % 2 ? 2e5 : 3e5;
    }
    return layout;
}

/* Fields of a row by their columns' names. */
typedef struct {
    char head[2000], line[2000];
    const char *names[FIELDS], *fields[FIELDS];
    size_t count;
} row;

static size_t split(char *text, const char **fields)
{
    size_t count = 0;
    for (char *at = text; at && count < FIELDS; count++) {
        fields[count] = at;
        at = strchr(at, ',');
        if (at)
            *at++ = 0;
    }
    return count;
}

static void read_row(const char *csv, size_t index, row *r)
{
    const char *line = csv;
    for (size_t i = 0; i <= index; i++)
        line = strchr(line, '\n') + 1;
    snprintf(r->head, sizeof r->head, "%.*s", (int)strcspn(csv, "\n"), csv);
    snprintf(r->line, sizeof r->line, "%.*s", (int)strcspn(line, "\n"), line);
    r->count = split(r->head, r->names);
    assert_int_equal(split(r->line, r->fields), r->count);
}

static const char *text_in(const row *r, const char *name)
{
    for (size_t i = 0; i < r->count; i++)
        if (strcmp(r->names[i], name) == 0)
            return r->fields[i];
    fail_msg("no column %s", name);
    return NULL;
}

static double number_in(const row *r, const char *name)
{
    char *end;
    const char *text = text_in(r, name);
    double value = strtod(text, &end);
    if (end == text || *end)
        fail_msg("%s: '%s'", name, text);
    return value;
}

static double degrees_in(const row *r, const char *name)
{
    return number_in(r, name) * M_PI / 180;
}

/* a along x, b along y, c along the datum's axis. */
static sp_vec3 along(const datum *d, double a, double b, double c)
{
    return sp_v(a * d->x[0] + b * d->y[0] + c * d->up[0], a * d->x[1] + b * d->y[1] + c * d->up[1],
                a * d->x[2] + b * d->y[2] + c * d->up[2]);
}

/* Drawn by height, radius and azimuth, and by x, y and height. */
static void check_place(const datum *d, const row *r, const char *what, sp_vec3 expected)
{
    char name[5][40];
    static const char *const parts[] = {"x_mm", "y_mm", "height_mm", "radius_mm", "azimuth_deg"};
    for (int i = 0; i < 5; i++)
        snprintf(name[i], sizeof name[i], "%s_%s", what, parts[i]);
    double height = 1e-3 * number_in(r, name[2]), radius = 1e-3 * number_in(r, name[3]);
    double azimuth = degrees_in(r, name[4]);
    sp_vec3 origin = {d->origin[0], d->origin[1], d->origin[2]};
    sp_vec3 round = sp_add(origin, along(d, radius * cos(azimuth), radius * sin(azimuth), height));
    sp_vec3 square = sp_add(origin, along(d, 1e-3 * number_in(r, name[0]), 1e-3 * number_in(r, name[1]), height));
    if (sp_distance(round, expected) > 1e-3 || sp_distance(square, expected) > 1e-3)
        fail_msg("%s: %s off by %g and %g mm", text_in(r, "name"), what, 1e3 * sp_distance(round, expected),
                 1e3 * sp_distance(square, expected));
}

static double between(sp_vec3 a, sp_vec3 b)
{
    return atan2(sp_length(sp_cross(a, b)), sp_dot(a, b)) * 180 / M_PI;
}

/* The axis by tilt and azimuth; then a fan's width, turned about it from the level line a quarter turn on. */
static void check_axis(const datum *d, const row *r, const sp_nozzle *nozzle, sp_vec3 up)
{
    double tilt = degrees_in(r, "tilt_deg"), towards = degrees_in(r, "towards_deg");
    sp_vec3 axis = along(d, sin(tilt) * cos(towards), sin(tilt) * sin(towards), -cos(tilt));
    if (between(axis, nozzle->axis) > 0.1)
        fail_msg("%s: axis off by %g deg", nozzle->name, between(axis, nozzle->axis));
    if (nozzle->type->pattern != SP_PATTERN_FLAT_FAN) {
        assert_string_equal(text_in(r, "turn_deg"), "");
        return;
    }
    double turn = degrees_in(r, "turn_deg");
    sp_vec3 level = along(d, -sin(towards), cos(towards), 0), further = sp_cross(axis, level);
    sp_vec3 wide = sp_add(sp_scale(level, cos(turn)), sp_scale(further, sin(turn)));
    double off = between(wide, sp_nozzle_frame(nozzle->axis, nozzle->roll, up).x);
    if (fmin(off, 180 - off) > 0.15)
        fail_msg("%s: turn off by %g deg", nozzle->name, off);
}

static void check_fitting(const datum *d, const row *r, const sp_nozzle *nozzle, const sp_mount *port, size_t i)
{
    if (i < 4) {
        assert_string_equal(text_in(r, "mounting"), "port");
        assert_string_equal(text_in(r, "fitting"), port->name);
        assert_string_equal(text_in(r, "standoff_mm"), "");
        check_place(d, r, "fitting", port->position);
        assert_true(fabs(1e-3 * number_in(r, "depth_mm") - sp_distance(port->position, nozzle->position)) <= 5.01e-4);
        return;
    }
    /* the shell has a radius of 600 mm, and 96 flat sides that come as near as 599.7 mm */
    assert_string_equal(text_in(r, "mounting"), "weld");
    assert_string_equal(text_in(r, "fitting"), "shell");
    assert_string_equal(text_in(r, "depth_mm"), "");
    assert_true(fabs(number_in(r, "standoff_mm") - 39.85) < 0.7);
    double out = hypot(nozzle->position.x, nozzle->position.y);
    sp_vec3 wall = {nozzle->position.x * 0.59985 / out, nozzle->position.y * 0.59985 / out, nozzle->position.z};
    double height = 1e-3 * number_in(r, "fitting_height_mm");
    sp_vec3 drawn = sp_add(sp_v(d->origin[0], d->origin[1], d->origin[2]),
                           along(d, 1e-3 * number_in(r, "fitting_x_mm"), 1e-3 * number_in(r, "fitting_y_mm"), height));
    assert_true(sp_distance(wall, drawn) < 3e-3); /* square to a side, not to the axis */
    check_place(d, r, "fitting", drawn);
}

static void rebuilt_from_the_text(void **state)
{
    (void)state;
    for (size_t k = 0; k < sizeof datums / sizeof *datums; k++) {
        const datum *d = &datums[k];
        sp_error error = {0};
        sp_scene *scene = open_vessel(d);
        const sp_setup *setup = sp_scene_setup(scene);
        const sp_place_options place = sp_scene_place_options(scene);
        sp_layout *layout = layout_of(scene);
        sp_fitting_sheet *sheet = sp_fitting_sheet_create(layout, setup, place.mounts, place.mount_count, &error);
        char *csv = sp_nozzles_csv(sheet, &error);
        assert_non_null(csv);
        assert_int_equal(sheet->round, d->round);
        for (size_t i = 0; i < NOZZLES; i++) {
            row r;
            const sp_nozzle *nozzle = &layout->nozzles[i];
            read_row(csv, i, &r);
            check_place(d, &r, "tip", nozzle->position);
            check_axis(d, &r, nozzle, setup->up);
            check_fitting(d, &r, nozzle, &place.mounts[i % 4], i);
            assert_string_equal(text_in(&r, "circuit"), i % 2 ? "1" : "2");
        }
        free(csv);
        sp_fitting_sheet_destroy(sheet);
        sp_layout_destroy(layout);
        sp_scene_destroy(scene);
    }
}

/* Flows of a circuit add up, and circuits come by pressure. */
static void circuits(void **state)
{
    (void)state;
    sp_error error = {0};
    sp_scene *scene = open_vessel(&datums[0]);
    sp_layout *layout = layout_of(scene);
    layout->nozzles[2].pressure = 1e5;
    sp_fitting_sheet *sheet = sp_fitting_sheet_create(layout, sp_scene_setup(scene), NULL, 0, &error);
    double sums[3] = {0}, pressures[] = {1e5, 2e5, 3e5};
    size_t counts[3] = {0};
    for (size_t i = 0; i < NOZZLES; i++) {
        size_t k = i == 2 ? 0 : i % 2 ? 1 : 2;
        const sp_nozzle_type *type = layout->nozzles[i].type;
        sums[k] += type->flow * pow(pressures[k] / 2e5, type->exponent);
        counts[k]++;
        assert_int_equal(sheet->rows[i].circuit, k);
        assert_null(sheet->rows[i].mount);
    }
    assert_int_equal(sheet->circuit_count, 3);
    for (size_t k = 0; k < 3; k++) {
        assert_true(sheet->circuits[k].pressure == pressures[k] && sheet->circuits[k].nozzles == counts[k]);
        assert_true(fabs(sheet->circuits[k].flow - sums[k]) < 1e-12);
    }
    sp_fitting_sheet_destroy(sheet);
    sp_layout_destroy(layout);
    sp_scene_destroy(scene);
}

static int make_vessel(void **state)
{
    return scratch_make(state) || system("'" BINARY_DIR "/scenes/vessel' vessel.obj > vessel.log");
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(rebuilt_from_the_text), cmocka_unit_test(circuits)};
    return cmocka_run_group_tests(tests, make_vessel, scratch_remove);
}
