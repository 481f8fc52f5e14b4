/* Film that runs down the walls of a small room, and drops that air holds back in it. */
#include "results.h"

#include <math.h>

/* A closed room keeps all that runs down its walls; film covers more than impact alone, and is read back. */
static void film_runs_down_the_walls(void **state)
{
    (void)state;
    write_room_with("film.yaml", "flux: 1 L/min/m2", "flux: 20 L/min/m2, film: 2 L/min/m");
    write_room_with("impact.yaml", "flux: 1 L/min/m2", "flux: 20 L/min/m2");
    json_t *object = expect_json("simulate film.yaml --json", 0), *layout = layout_named(object, "manual");
    json_t *film = json_object_get(layout, "film"), *impact = expect_json("simulate impact.yaml --json", 0);
    double arriving = number(film, "arriving_l_min"), held = number(film, "held_l_min");
    assert_true(fabs(arriving - 12) < 0.02 * 12); /* as far as patches tell how much falls on them */
    assert_true(fabs(number(film, "left_l_min") + number(film, "astray_l_min") + held - arriving) < 1e-9);
    assert_true(held > 0.999 * arriving);
    assert_true(fabs(number(film, "per_girth_l_min_m") - arriving / 4) < 0.05 * arriving);
    double alone = number(film, "covered_area_m2"), covered = number(layout, "covered_area_m2");
    assert_true(alone > 0.1);
    assert_true(fabs(number(layout_named(impact, "manual"), "covered_area_m2") + alone - covered) < 1e-9);
    char *text = json_dumps(object, 0);
    write_file("film.json", text);
    free(text);
    json_t *read = expect_json("compare film.json impact.yaml --json", 0);
    json_t *again = json_object_get(json_array_get(json_object_get(read, "layouts"), 0), "film");
    assert_true(fabs(number(again, "covered_area_m2") - alone) < 1e-12);
    json_decref(object);
    json_decref(impact);
    json_decref(read);
}

/* What arrives is not what lands, and stands beside what becomes of it; and nothing lies at -0.000. */
static void what_arrives_is_reported(void **state)
{
    (void)state;
    write_room_with("sunk.yaml", "room.obj\ncavity: [0.5 m, 0.5 m, 0.5 m]\ncriterion: {flux: 1 L/min/m2}",
                    "room.obj\n    translate: [0 m, 0 m, -1e-6 m]\ncavity: [0.5 m, 0.5 m, 0.5 m]\ncriterion: {film: 2 "
                    "L/min/m}");
    json_t *object = expect_json("simulate sunk.yaml -o sunk --json " COARSE, 0);
    double arriving = number(json_object_get(layout_named(object, "manual"), "film"), "arriving_l_min");
    char row[512], cell[40];
    row_of("sunk", "<th scope=\"row\">Arrives on wet surface", row);
    snprintf(cell, sizeof cell, ">%.1f</td>", arriving);
    assert_non_null(strstr(row, cell));
    json_decref(object);
    char *page = read_file("sunk/report.html", NULL);
    assert_non_null(strstr(page, ", 0.000</th><td>1.0000</td><td>not at all</td>"));
    free(page);
    outcome run = run_program("simulate sunk.yaml " COARSE);
    assert_non_null(strstr(run.out, "alone m2    arrives L/min     drains L/min"));
    forget(&run);
}

static json_t *account_of(const json_t *result)
{
    return json_object_get(json_object_get(result, "geometry"), "account");
}

/* A lid that lies on the room and shares no edge with it: film crosses the crack, and that there is one is told. */
static void cracks_are_reported(void **state)
{
    (void)state;
    char text[1000];
    snprintf(text, sizeof text, "v 0 0 1.00001\nv 1 0 1.00001\nv 1 1 1.00001\nv 0 1 1.00001\n%s", room_obj);
    char *faces = strstr(text, "f 1 2 3 4\n");
    snprintf(faces, sizeof text - (size_t)(faces - text),
             "f 5 6 7 8\ng ceiling\nf 1 4 3 2\ng walls\nf 5 9 10 6\nf 6 10 11 7\nf 7 11 12 8\nf 8 12 9 5\n");
    write_file("lidded.obj", text);
    write_room_with("film.yaml", "flux: 1 L/min/m2", "flux: 20 L/min/m2, film: 2 L/min/m");
    write_room_with("impact.yaml", "room.obj", "lidded.obj");
    write_room_with("lidded.yaml", "room.obj\ncavity: [0.5 m, 0.5 m, 0.5 m]\ncriterion: {flux: 1 L/min/m2}",
                    "lidded.obj\ncavity: [0.5 m, 0.5 m, 0.5 m]\ncriterion: {flux: 20 L/min/m2, film: 2 L/min/m}");
    json_t *sound = expect_json("simulate film.yaml --json", 0),
           *cracked = expect_json("simulate lidded.yaml --json", 0);
    assert_true(number(account_of(cracked), "crack_corners") == 8);
    assert_true(json_array_size(json_object_get(account_of(cracked), "crack_m")) == 3);
    assert_null(json_object_get(account_of(sound), "crack_corners"));
    double wall = number(layout_named(sound, "manual"), "coverage");
    assert_true(fabs(number(layout_named(cracked, "manual"), "coverage") - wall) < 0.01);
    outcome run = run_program("simulate lidded.yaml");
    assert_non_null(strstr(run.out, "geometry: 8 corners on open edges lie within 0.17 mm of others"));
    forget(&run);
    run = run_program("simulate impact.yaml"); /* which asks for no film */
    assert_null(strstr(run.out, "corners"));
    forget(&run);
    json_decref(sound);
    json_decref(cracked);
}

static void refused(const char *arguments, const char *complaint)
{
    outcome result = run_program(arguments);
    assert_int_equal(result.status, 3);
    assert_non_null(strstr(result.err, complaint));
    forget(&result);
}

/* A proposal counts film as simulate does, with fewer nozzles or more coverage than without, and the same bytes for any
 * number of threads; its bound holds. */
static void film_is_placed_for(void **state)
{
    (void)state;
    write_room_with("film.yaml", "{flux: 1 L/min/m2}", "{flux: 20 L/min/m2, film: 3 L/min/m}");
    json_t *one = expect_json("place film.yaml " COARSE " -o proposed --json --threads 1", 4);
    json_t *three = expect_again(one, "place film.yaml " COARSE " --json --threads 3", 4);
    json_t *layout = layout_named(one, "proposed"), *certificate = json_object_get(one, "certificate");
    assert_true(number(json_object_get(layout, "film"), "covered_area_m2") > 0);
    assert_true(number(certificate, "coverage_bound_same_water") >= number(certificate, "coverage"));
    assert_true(json_equal(json_object_get(one, "layouts"), json_object_get(three, "layouts")));
    assert_true(json_equal(json_object_get(one, "front"), json_object_get(three, "front")));
    json_t *again = expect_json("simulate proposed/layout.yaml --json", 0);
    assert_true(number(layout_named(again, "manual"), "coverage") == number(layout, "coverage"));
    json_decref(one);
    json_decref(three);
    json_decref(again);
}

/* Where film cannot be counted, it is refused. */
static void film_is_refused_where_it_cannot_be_counted(void **state)
{
    (void)state;
    write_file("nowhere.yaml", "geometry:\n  - file: room.obj\ncriterion: {film: 2 L/min/m}\n");
    refused("check nowhere.yaml", "nowhere.yaml:3:19: film: found without a cavity");
    write_file("wrong.yaml", "geometry:\n  - file: room.obj\ncriterion: {film: 2 L/min}\n");
    refused("check wrong.yaml", "wrong.yaml:3:19: film: found '2 L/min', expected a flow per width");
}

/* What drops that air holds back do is simulated, compared and told, and written back. */
static void drag_is_simulated(void **state)
{
    (void)state;
    write_room_with("drag.yaml", "simulate: {texel: " ROOM_TEXEL, "simulate: {trajectory: drag, texel: 100 mm");
    json_t *drops = expect_json("simulate drag.yaml -o drops --json", 0);
    assert_string_equal(json_string_value(json_object_get(json_object_get(drops, "fidelity"), "trajectory")), "drag");
    json_t *again = expect_json("simulate drops/layout.yaml --json", 0);
    json_t *set = expect_json("simulate room.yaml " COARSE " --set simulate.trajectory=drag --json", 0);
    assert_true(json_equal(json_object_get(layout_named(drops, "manual"), "coverage"),
                           json_object_get(layout_named(again, "manual"), "coverage")));
    assert_true(json_equal(json_object_get(drops, "layouts"), json_object_get(set, "layouts")));
    json_decref(drops);
    json_decref(again);
    json_decref(set);
    json_decref(expect_json("compare drops/result.json drag.yaml room.yaml --json", 0));
    char *page = read_file("drops/report.html", NULL);
    assert_non_null(strstr(page, "far end of a bracket"));
    free(page);
}

/* Drops are placed, the same for any number of threads, and the proposal simulated is what was proposed. */
static void drag_is_placed(void **state)
{
    (void)state;
    write_room_with("mist.yaml", "simulate: {", "simulate: {trajectory: drag, accuracy: 5%, ");
    json_t *one = expect_json("place mist.yaml --set simulate.texel=160mm -o mist --threads 1 --json", 0);
    json_t *three = expect_again(one, "place mist.yaml --set simulate.texel=160mm --threads 3 --json", 0);
    json_t *again = expect_json("simulate mist/layout.yaml --json", 0);
    const char *same[] = {"layouts", "front", "certificate", "fidelity"};
    for (size_t i = 0; i < sizeof same / sizeof *same; i++)
        assert_true(json_equal(json_object_get(one, same[i]), json_object_get(three, same[i])));
    assert_string_equal(json_string_value(json_object_get(json_object_get(one, "fidelity"), "trajectory")), "drag");
    assert_true(json_equal(json_object_get(layout_named(one, "proposed"), "coverage"),
                           json_object_get(layout_named(again, "manual"), "coverage")));
    assert_true(number(json_object_get(one, "certificate"), "coverage_bound_same_water") >=
                number(layout_named(one, "proposed"), "coverage"));
    json_decref(one);
    json_decref(three);
    json_decref(again);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(film_runs_down_the_walls), cmocka_unit_test(cracks_are_reported),
        cmocka_unit_test(film_is_placed_for),       cmocka_unit_test(film_is_refused_where_it_cannot_be_counted),
        cmocka_unit_test(drag_is_simulated),        cmocka_unit_test(drag_is_placed),
        cmocka_unit_test(what_arrives_is_reported),
    };
    return cmocka_run_group_tests(tests, open_workplace, close_workplace);
}
