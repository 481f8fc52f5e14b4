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
    const sp_yaml *node = sp_yaml_get(scene->tree, "report");
    const sp_fields in = {reader, &sp_block_report, node};
    sp_picture_style *style = &scene->style;
    int quantity = 0, scale = 0, colours = 0;
    if (!node)
        return true;
    if (!sp_read_block(&in, "report") || !sp_read_choice(&in, "quantity", &quantity) ||
        !sp_read_choice(&in, "scale", &scale) || !sp_read_choice(&in, "colours", &colours) ||
        !sp_read_flag(&in, "wireframe", &style->wireframe))
        return false;
    style->quantity = (sp_quantity)quantity;
    style->shades = (sp_shades)scale;
    style->colours = (sp_colours)colours;
    return style->shades != SP_SHADES_STEPPED || is_asked(scene, style->quantity) ||
           sp_read_fail(reader, sp_yaml_get(node, "scale"), "scale",
                        "auto, linear or log, as the criterion asks nothing of %s",
                        sp_key_of(&sp_block_report, "quantity")->words[quantity]);
}
