/* result.json: keys in the order of their table (keys), what was not computed absent. */
#include "json_put.h"
#include "growing_text.h"

#include <sprayplan/sprayplan.h>

#include <stdlib.h>

static bool put_stages(json_t *stages, const sp_stage *list, size_t count)
{
    for (size_t i = 0; i < count; ++i)
        if (json_array_append_new(stages, json_pack("{s:s, s:f, s:f}", "name", list[i].name, "seconds", list[i].seconds,
                                                    "processor_seconds", list[i].processor_seconds)) != 0)
            return false;
    return true;
}

static bool put_inputs(json_t *root, const sp_result *result)
{
    if (result->input_count == 0)
        return true;
    json_t *inputs = json_array();
    bool done = true;
    for (size_t i = 0; done && i < result->input_count; ++i) {
        json_t *input = json_object();
        char *path = sp_text_utf8(result->inputs[i].path);
        done = path && sp_put_text(input, "file", path) && sp_put_text(input, "sha256", result->inputs[i].sha256);
        free(path);
        done = json_array_append_new(inputs, input) == 0 && done;
    }
    return sp_put(root, "inputs", inputs) && done;
}

/* Of a proposal, a result or both; nothing where all was carried out. */
static bool put_cut_short(json_t *object, const sp_proposal *proposal, const sp_result *result)
{
    json_t *cut = json_array();
    bool done = true;
    for (size_t i = 0; done && proposal && i < proposal->cut_count; ++i)
        done = json_array_append_new(cut, json_string(proposal->cut[i])) == 0;
    for (size_t i = 0; done && result && i < result->left_out_count; ++i)
        done = json_array_append_new(cut, json_string(result->left_out[i])) == 0;
    if (done && json_array_size(cut) > 0)
        return sp_put(object, "cut_short", cut);
    json_decref(cut);
    return done;
}

/* Which alternative is proposed, and the same of each. */
static bool put_alternatives(json_t *root, const sp_result *result, const sp_figures *figures)
{
    char why[SP_CHOICE_TEXT];
    json_t *alternatives = json_array();
    sp_result_choice(result, why);
    bool done = sp_put_text(root, "proposed", figures[sp_result_proposed(result)].name) &&
                sp_put_text(root, "proposed_for", why);
    for (size_t i = 0; done && i < result->design_count; ++i) {
        const sp_proposal *alternative = result->designs[i].alternative;
        if (!alternative)
            continue;
        json_t *entry = json_object(), *stages = json_array();
        done = sp_put_text(entry, "name", figures[i].name) &&
               sp_put_proposal(entry, alternative, figures[i].clean_area, true) &&
               put_stages(stages, alternative->stages, alternative->stage_count) &&
               put_cut_short(entry, alternative, NULL);
        done = sp_put(entry, "stages", stages) && done;
        done = json_array_append_new(alternatives, entry) == 0 && done;
    }
    return sp_put(root, "alternatives", alternatives) && done;
}

static sp_layout_own differences(const sp_figures *figures, size_t count)
{
    sp_layout_own own = {.criterion = !sp_figures_share_criterion(figures, count)};
    for (size_t i = 1; i < count; ++i) {
        own.surface = own.surface || !sp_same_surface(&figures[0], &figures[i]);
        own.geometry = own.geometry || !sp_same_geometry(&figures[0], &figures[i]);
        own.fidelity = own.fidelity || !sp_same_fidelity(&figures[0], &figures[i]);
    }
    return own;
}

/* What all layouts have in common: where their geometries differ in what is attainable alone, the rest of them. */
static bool put_common(json_t *root, const sp_result *result, const sp_figures *figures, sp_layout_own own)
{
    if (result->design_count == 0)
        return true;
    const sp_evaluator *evaluator = result->designs[0].evaluator;
    sp_figures common = figures[0];
    if (own.geometry)
        common.attainable_area = NAN;
    return (own.surface || sp_put_geometry(root, &common, evaluator)) &&
           (own.criterion || sp_put_criterion(root, figures)) &&
           (own.fidelity || sp_put_fidelity(root, figures, result->design_count, evaluator));
}

static bool fill(json_t *root, const sp_result *result, const sp_figures *figures)
{
    sp_layout_own own = differences(figures, result->design_count);
    char *scene = sp_text_utf8(result->scene);
    bool done = scene && sp_put_text(root, "sprayplan", SP_VERSION) && sp_put_text(root, "command", result->command) &&
                sp_put_text(root, "scene", scene) && put_inputs(root, result) && put_common(root, result, figures, own);
    free(scene);
    json_t *layouts = json_array(), *stages = json_array();
    for (size_t i = 0; done && i < result->design_count; ++i)
        done = sp_put_layout(layouts, &figures[i], result->designs[i].evaluator, own);
    done = sp_put(root, "layouts", layouts) && done;
    bool alternatives = sp_result_has_alternatives(result);
    if (result->proposal)
        done = done &&
               sp_put_proposal(root, result->proposal, figures[sp_result_proposed(result)].clean_area, alternatives);
    done = done && (!alternatives || put_alternatives(root, result, figures));
    done = done && put_stages(stages, result->stages, result->stage_count) &&
           (!result->proposal || alternatives ||
            put_stages(stages, result->proposal->stages, result->proposal->stage_count));
    done = done && put_cut_short(root, alternatives ? NULL : result->proposal, result);
    return sp_put(root, "stages", stages) && done;
}

char *sp_result_json(const sp_result *result, sp_error *error)
{
    sp_figures *figures = sp_result_figures(result, error);
    if (!figures)
        return NULL;
    json_t *root = json_object();
    char *dump = fill(root, result, figures) ? json_dumps(root, JSON_INDENT(1) | JSON_REAL_PRECISION(17)) : NULL;
    json_decref(root);
    sp_figures_destroy(figures, result->design_count);
    sp_text text = {0};
    if (dump)
        sp_text_add(&text, "%s\n", dump);
    else
        text.failed = true;
    free(dump);
    return sp_text_finish(&text, error);
}
