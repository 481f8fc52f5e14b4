/* What does refinement add to the best that is found on the candidates? Plans a scene twice, once only as far as to
 * where refinement begins, and says for every amount of water on the front of the first how much of the attainable area
 * is covered by either, which share of what the candidates left dry refinement covers with no more water, and how much
 * less water it needs to cover as much. */
#include <sprayplan/sprayplan.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void fail(const sp_error *error)
{
    char text[1400];
    sp_error_text(error, text, sizeof text);
    fprintf(stderr, "refinement_gain: %s\n", text);
    exit(1);
}

static double seconds(const sp_proposal *proposal)
{
    double sum = 0;
    for (size_t i = 0; i < proposal->stage_count; i++)
        sum += proposal->stages[i].seconds;
    return sum;
}

/* The most that the front covers with no more water. */
static double area_at(const sp_proposal *proposal, double flow)
{
    double area = 0;
    for (size_t i = 0; i < proposal->front_count && proposal->front[i].flow <= flow * (1 + 1e-9); i++)
        area = proposal->front[i].area;
    return area;
}

/* The least water with which the front covers as much. */
static double flow_at(const sp_proposal *proposal, double area)
{
    for (size_t i = 0; i < proposal->front_count; i++)
        if (proposal->front[i].area >= area)
            return proposal->front[i].flow;
    return INFINITY;
}

static bool until_refinement(void *user, const char *stage, double done)
{
    (void)user;
    (void)done;
    return strcmp(stage, "refine") != 0;
}

int main(int argc, char **argv)
{
    if (argc != 2) {
        fprintf(stderr, "usage: refinement_gain SCENE\n");
        return 2;
    }
    sp_error error = {0};
    sp_scene *scene = sp_scene_load(argv[1], &error);
    sp_evaluator *evaluator = sp_evaluator_create(sp_scene_setup(scene), &error);
    sp_place_options options = sp_scene_place_options(scene), unrefined = options;
    unrefined.run.progress = until_refinement;
    sp_proposal *before = sp_place(evaluator, &unrefined, &error);
    sp_proposal *after = sp_place(evaluator, &options, &error);
    if (!before || !after)
        fail(&error);
    double attainable = after->attainable_area;
    printf("attainable %.3f m2; %.1f s until refinement, %.1f s in all\n\n", attainable, seconds(before),
           seconds(after));
    printf("| water, L/min | candidates, %% | refined, %% | of what was dry, %% | less water, %% "
           "|\n|---|---|---|---|---|\n");
    for (size_t i = 0; i < before->front_count; i++) {
        sp_front_point point = before->front[i];
        double area = area_at(after, point.flow);
        printf("| %.1f | %.2f | %.2f | %.1f | %.1f |\n", 6e4 * point.flow, 100 * point.area / attainable,
               100 * area / attainable, 100 * (area - point.area) / (attainable - point.area),
               100 * (1 - flow_at(after, point.area) / point.flow));
    }
    sp_proposal_destroy(before);
    sp_proposal_destroy(after);
    sp_evaluator_destroy(evaluator);
    sp_scene_destroy(scene);
    return 0;
}
