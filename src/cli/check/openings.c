#include "openings.h"

/* A lid for an opening, in the coordinates of the scene's file. */
static sp_cap cap_of(const sp_evaluator *evaluator, const sp_opening *opening)
{
    return (sp_cap){.point = sp_setup_outside(sp_evaluator_setup(evaluator), opening->place),
                    .normal = opening->normal,
                    .radius = opening->radius};
}

bool cli_openings_print(const sp_evaluator *evaluator)
{
    size_t count;
    const sp_opening *openings = sp_evaluator_openings(evaluator, &count);
    if (count)
        printf("\n%-36s %8s %15s  %s\n", "opening at m", "width m", "share of sight", "a cap for it, in `caps:`");
    for (size_t i = 0; i < count; i++) {
        sp_cap cap = cap_of(evaluator, &openings[i]);
        sp_vec3 p = cap.point, n = cap.normal;
        printf("[%10.4f, %10.4f, %10.4f] %8.3g %15.2g  ", p.x, p.y, p.z, openings[i].width, openings[i].share);
        if (openings[i].radius > 0)
            printf("{point: [%.5g m, %.5g m, %.5g m], normal: [%.3f, %.3f, %.3f], radius: %.3g m}\n", p.x, p.y, p.z,
                   n.x, n.y, n.z, cap.radius);
        else
            printf("none found\n");
    }
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
