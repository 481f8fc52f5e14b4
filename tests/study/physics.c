/* Studies of scenes with film, with drag and with goods that move: what is run and what it is compared with. */
#include "../optimizer/small_room.h"

#include <sprayplan/points.h>
#include <sprayplan/study.h>

/* A room through which a crate is carried, a cone above it, on few texels. */
typedef struct {
    room room;
    sp_nozzle_type type;
    sp_nozzle nozzle;
    sp_layout layout;
} scene;

static void open_scene(scene *s, bool moves)
{
    room_builder b = {0};
    room_box(&b, sp_v(-1, -0.7, 0), sp_v(1, 0.7, 1.2), "walls", "lid");
    room_box(&b, sp_v(-0.2, -0.2, 0.1), sp_v(0.2, 0.2, 0.35), "crate", "crate top");
    *s = (scene){.type = room_cone("cone", 70 * DEGREE, 12)};
    s->type.drop = 4e-4;
    s->nozzle = (sp_nozzle){.name = "N",
                            .type = &s->type,
                            .position = {0.1, 0.05, 1},
                            .axis = moves ? sp_v(0.3, 0.1, -1) : sp_v(0.2, 1, 0.3),
                            .pressure = PRESSURE};
    s->layout = (sp_layout){1, &s->nozzle};
    s->room.setup = sp_setup_default();
    s->room.setup.cavity = SP_CAVITY_POINT;
    s->room.setup.cavity_point = sp_v(0.5, 0.5, 0.6);
    s->room.setup.criterion.flux = 2 * LITRES_PER_MINUTE;
    s->room.setup.run.threads = 1;
    s->room.moves[2] = s->room.moves[3] = moves;
    if (moves)
        s->room.setup.sweep = (sp_sweep){.from = {-0.6, 0, 0}, .to = {0.6, 0, 0}, .speed = 0.1};
    room_open(&s->room, &b, 0.2);
    s->room.setup.fidelity.method = SP_METHOD_INVERSE;
    s->room.setup.fidelity.accuracy = 0.1;
    s->room.setup.fidelity.texel = 0.16;
}

static sp_study *study(const scene *s)
{
    sp_error error = {0};
    sp_study_options options = {.run = {.threads = 1}};
    sp_study *made = sp_study_create(&s->room.setup, &s->layout, NULL, &options, &error);
    assert_string_equal(error.message, "");
    assert_non_null(made);
    return made;
}

/* The trajectories of the runs, the scene's own last, and errors that a texel of 160 mm may make. */
static void assert_runs(const sp_study *found, const sp_trajectory *trajectories, size_t count)
{
    assert_int_equal(found->run_count, count);
    for (size_t i = 0; i < count; i++) {
        const sp_study_run *run = &found->runs[i];
        assert_int_equal(run->fidelity.trajectory, trajectories[i]);
        assert_int_equal(run->chosen, i + 1 == count);
        assert_true(run->coverage > 0.02 && run->misjudged < 0.08 && fabs(run->error) < 0.03);
        assert_float_equal(run->error, run->coverage - found->reference_coverage, 0.02);
    }
}

static void assert_told(const sp_study *found, const char *words)
{
    sp_error error = {0};
    char *texts[] = {sp_study_text(found, &error), sp_study_json(found, "room", &error),
                     sp_study_html(found, "room", &error)};
    for (size_t i = 0; i < 3; i++) {
        assert_non_null(texts[i]);
        if (!strstr(texts[i], words))
            fail_msg("text %zu does not say: %s", i, words);
        free(texts[i]);
    }
}

static void film_is_compared_with_finer_film(void **state)
{
    (void)state;
    scene s;
    open_scene(&s, false);
    s.room.setup.criterion.film = LITRES_PER_MINUTE;
    s.room.setup.fidelity.trajectory = SP_TRAJECTORY_PARABOLA;
    sp_study *found = study(&s);
    assert_runs(found, (sp_trajectory[]){SP_TRAJECTORY_PARABOLA, SP_TRAJECTORY_PARABOLA}, 2);
    assert_float_equal(found->reference_film_cell, 0.08, 1e-12);
    assert_told(found, "Film is routed from the first impacts");
    sp_study_destroy(found);
    room_close(&s.room);
}

static void drag_stands_beside_lines_and_parabolas(void **state)
{
    (void)state;
    scene s;
    open_scene(&s, false);
    s.room.setup.fidelity.trajectory = SP_TRAJECTORY_DRAG;
    sp_study *found = study(&s);
    assert_runs(found,
                (sp_trajectory[]){SP_TRAJECTORY_LINE, SP_TRAJECTORY_PARABOLA, SP_TRAJECTORY_DRAG, SP_TRAJECTORY_DRAG},
                4);
    assert_int_equal(found->reference.trajectory, SP_TRAJECTORY_DRAG);
    assert_true(found->runs[2].misjudged < found->runs[0].misjudged);
    assert_true(found->reference_film_cell == 0);
    assert_told(found, "Lines and parabolas leave out the drag");
    assert_told(found, "Film on walls is left out");
    sp_study_destroy(found);
    room_close(&s.room);
}

static void goods_are_compared_by_their_dose(void **state)
{
    (void)state;
    scene s;
    open_scene(&s, true);
    s.room.setup.fidelity.trajectory = SP_TRAJECTORY_LINE;
    sp_study *found = study(&s);
    assert_runs(found, (sp_trajectory[]){SP_TRAJECTORY_LINE, SP_TRAJECTORY_LINE}, 2);
    assert_true(found->passing);
    assert_told(found, "Goods are looked at in positions");
    sp_study_destroy(found);
    room_close(&s.room);
}

/* Points of a scene that film rinses: what is measured of a coverage takes it in, and falls with the texel. */
static void film_has_a_measured_error(void **state)
{
    (void)state;
    double misjudged[2];
    for (int k = 0; k < 2; k++) {
        scene s;
        open_scene(&s, false);
        s.room.setup.criterion.film = LITRES_PER_MINUTE;
        s.room.setup.fidelity.texel = k ? 0.05 : 0.2;
        sp_error error = {0};
        sp_evaluator *evaluator = sp_evaluator_create(&s.room.setup, &error);
        sp_coverage *coverage = sp_evaluate(evaluator, &s.layout, &error);
        assert_non_null(coverage);
        sp_measured_error measured;
        assert_true(sp_measure_error(evaluator, &s.layout, coverage, SP_TRAJECTORY_AUTO, 1, &measured, &error));
        assert_true(measured.known && coverage->film.area > 0.05 * coverage->area);
        misjudged[k] = measured.misjudged;
        sp_coverage_destroy(coverage);
        sp_evaluator_destroy(evaluator);
        room_close(&s.room);
    }
    print_message("misjudged: %.4f, on texels a quarter as long %.4f\n", misjudged[0], misjudged[1]);
    assert_true(misjudged[1] > 0 && misjudged[1] < 0.5 * misjudged[0]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(film_is_compared_with_finer_film),
        cmocka_unit_test(drag_stands_beside_lines_and_parabolas),
        cmocka_unit_test(goods_are_compared_by_their_dose),
        cmocka_unit_test(film_has_a_measured_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
