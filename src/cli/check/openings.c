#include "openings.h"

#include "lengths.h"

#include <stdio.h>

#define STEP 1e-3     /* of an opening's width: what matters of it */
#define CAP_STEP 1e-4 /* of a cap's radius: less than what it lies off its opening */

/* A lid for an opening, in the coordinates of the scene's file. */
static sp_cap cap_of(const sp_evaluator *evaluator, const sp_opening *opening)
{
    return (sp_cap){.point = sp_setup_outside(sp_evaluator_setup(evaluator), opening->place),
                    .normal = opening->normal,
                    .radius = opening->radius};
}

static void print_cap(sp_cap cap)
{
    double step = CAP_STEP * cap.radius;
    char point[CLI_POINT], normal[CLI_POINT], radius[CLI_LENGTH];
    cli_point_text(cap.point, step, " m", point);
    cli_point_text(cap.normal, CAP_STEP, "", normal);
    cli_length_text(cap.radius, step, radius);
    printf("{point: [%s], normal: [%s], radius: %s m}\n", point, normal, radius);
}

bool cli_openings_print(const sp_evaluator *evaluator)
{
    size_t count, more = sp_evaluator_more_openings(evaluator);
    const sp_opening *openings = sp_evaluator_openings(evaluator, &count);
    if (count)
        printf("\n%-36s %8s %15s  %s\n", "opening at m", "width m", "share of sight", "a cap for it, in `caps:`");
    for (size_t i = 0; i < count; i++) {
        sp_cap cap = cap_of(evaluator, &openings[i]);
        char place[CLI_POINT], bracketed[CLI_POINT + 2], width[CLI_LENGTH];
        cli_point_text(cap.point, STEP * openings[i].width, "", place);
        snprintf(bracketed, sizeof bracketed, "[%s]", place);
        cli_length_text(openings[i].width, STEP * openings[i].width, width);
        printf("%-36s %8s %15.2g  ", bracketed, width, openings[i].share);
        if (openings[i].radius > 0)
            print_cap(cap);
        else
            printf("none found\n");
    }
    if (more)
        printf("and at least %zu more, which less is seen through\n", more);
    return count > 0;
}

static json_t *cap_json(const sp_evaluator *evaluator, const sp_opening *opening)
{
    sp_cap cap = cap_of(evaluator, opening);
    if (!(opening->radius > 0))
        return json_null();
    return json_pack("{s:[fff], s:[fff], s:f}", "point_m", cap.point.x, cap.point.y, cap.point.z, "normal",
                     cap.normal.x, cap.normal.y, cap.normal.z, "radius_m", cap.radius);
}

json_t *cli_openings_json(const sp_evaluator *evaluator)
{
    size_t count;
    const sp_opening *openings = sp_evaluator_openings(evaluator, &count);
    json_t *list = json_array();
    for (size_t i = 0; i < count; i++) {
        sp_vec3 p = sp_setup_outside(sp_evaluator_setup(evaluator), openings[i].place);
        json_array_append_new(list, json_pack("{s:[fff], s:f, s:f, s:o}", "place_m", p.x, p.y, p.z, "width_m",
                                              openings[i].width, "share", openings[i].share, "cap",
                                              cap_json(evaluator, &openings[i])));
    }
    return list;
}
