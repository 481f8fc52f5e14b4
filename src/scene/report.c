/* report: what pictures and model show, and how. */
#include "scene/state.h"

/* Two colours need something to be parted at. */
static bool is_asked(const sp_scene *scene, sp_quantity quantity)
{
    const sp_criterion *criterion = &scene->setup.criterion;
    switch (quantity) {
    case SP_QUANTITY_FLUX:
        return criterion->flux > 0 || scene->dose > 0;
    case SP_QUANTITY_SPEED:
    case SP_QUANTITY_SPEED_MAX:
        return criterion->impact_speed > 0;
    case SP_QUANTITY_INCIDENCE:
    case SP_QUANTITY_INCIDENCE_MIN:
        return criterion->incidence < M_PI / 2;
    default:
        return quantity == SP_QUANTITY_COVERED;
    }
}

bool sp_scene_read_report(sp_scene *scene, const sp_reader *reader)
{
    static const sp_key keys[] = {
        {"quantity", false}, {"scale", false}, {"colours", false}, {"wireframe", false}, {NULL, false}};
    static const char *const quantities[] = {"flux",          "speed",  "speed_max",  "incidence",
                                             "incidence_min", "impact", "impact_max", "jets",
                                             "covered",       "charts", NULL};
    static const char *const scales[] = {"auto", "linear", "log", "stepped", NULL};
    static const char *const maps[] = {"viridis", "cividis", NULL};
    const sp_yaml *node = sp_yaml_get(scene->tree, "report");
    sp_picture_style *style = &scene->style;
    int quantity = 0, scale = 0, colours = 0;
    if (!node)
        return true;
    if (!sp_read_keys(reader, node, "report", "what a report shows", keys) ||
        !sp_read_choice(reader, node, "quantity", quantities, &quantity) ||
        !sp_read_choice(reader, node, "scale", scales, &scale) ||
        !sp_read_choice(reader, node, "colours", maps, &colours) ||
        !sp_read_flag(reader, node, "wireframe", &style->wireframe))
        return false;
    style->quantity = (sp_quantity)quantity;
    style->shades = (sp_shades)scale;
    style->colours = (sp_colours)colours;
    return style->shades != SP_SHADES_STEPPED || is_asked(scene, style->quantity) ||
           sp_read_fail(reader, sp_yaml_get(node, "scale"), "scale",
                        "auto, linear or log, as the criterion asks nothing of %s", quantities[quantity]);
}
