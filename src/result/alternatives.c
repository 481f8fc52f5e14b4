/* Which proposal speaks of a design, and which of several is proposed. */
#include <sprayplan/result.h>

#include <stdio.h>

#define ROUND_OFF 1e-9 /* as a fraction: coverages that differ by less are equal */

size_t sp_result_proposed(const sp_result *result)
{
    for (size_t i = 0; result->proposal && i < result->design_count; ++i)
        if (result->designs[i].coverage == result->proposal->coverage)
            return i;
    return SP_UNKNOWN;
}

const sp_proposal *sp_result_proposal(const sp_result *result, size_t index)
{
    const sp_design *design = &result->designs[index];
    size_t proposed = sp_result_proposed(result);
    if (design->alternative || proposed == SP_UNKNOWN)
        return design->alternative;
    return design->evaluator == result->designs[proposed].evaluator ? result->proposal : NULL;
}

bool sp_result_has_alternatives(const sp_result *result)
{
    for (size_t i = 0; i < result->design_count; ++i)
        if (result->designs[i].alternative)
            return true;
    return false;
}

bool sp_result_is_costly(const sp_result *result)
{
    bool any = result->proposal && result->proposal->costly;
    for (size_t i = 0; i < result->design_count; ++i)
        any |= result->designs[i].alternative && result->designs[i].alternative->costly;
    return any;
}

/* Whether no other alternative covers more. */
static bool covers_most(const sp_result *result)
{
    for (size_t i = 0; i < result->design_count; ++i)
        if (result->designs[i].alternative &&
            result->designs[i].coverage->fraction > result->proposal->coverage->fraction + ROUND_OFF)
            return false;
    return true;
}

/* Whether the search of some alternative ended before its time, so that it might have been the best. */
static bool is_cut_short(const sp_result *result)
{
    bool any = false;
    for (size_t i = 0; i < result->design_count; ++i)
        any |= result->designs[i].alternative && result->designs[i].alternative->interrupted;
    return any;
}

void sp_result_choice(const sp_result *result, char text[SP_CHOICE_TEXT])
{
    static const char *const best[] = {[SP_OBJECTIVE_AREA_PER_WATER] = "cleans most area per water",
                                       [SP_OBJECTIVE_MIN_WATER] = "needs least water",
                                       [SP_OBJECTIVE_MAX_COVERAGE] = "covers most"};
    static const char *const cheapest[] = {[SP_OBJECTIVE_AREA_PER_WATER] = "cleans most area for its price",
                                           [SP_OBJECTIVE_MIN_WATER] = "has the least price",
                                           [SP_OBJECTIVE_MAX_COVERAGE] = "covers most"};
    const sp_proposal *proposal = result->proposal;
    text[0] = 0;
    if (!proposal || !sp_result_has_alternatives(result))
        return;
    const char *late = is_cut_short(result) ? ", of what the time allowed to find" : "";
    double asked = 100 * proposal->asked_area / proposal->coverage->area;
    if (proposal->coverage->covered_area >= proposal->asked_area)
        snprintf(text, SP_CHOICE_TEXT, "of those that cover the %.4g %% asked for, it %s%s", asked,
                 (sp_result_is_costly(result) ? cheapest : best)[proposal->objective], late);
    else if (covers_most(result))
        snprintf(text, SP_CHOICE_TEXT, "none covers the %.4g %% asked for, and of all it covers most%s", asked, late);
    else
        snprintf(text, SP_CHOICE_TEXT,
                 "none covers the %.4g %% asked for; it %s within %.1g points of the most covered%s", asked,
                 sp_result_is_costly(result) ? "has the least price" : "needs least water", 100 * SP_COVERAGE_TOLD,
                 late);
}
