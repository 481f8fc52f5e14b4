/* Whether the scene's own nozzles are better than what is proposed. The search cannot rule that out: it looks at other
 * poses, and by the inverse evaluation. */
#include <sprayplan/result.h>

#include <stdio.h>
#include <string.h>

#define ROUND_OFF 1e-9 /* as a share: figures that differ by less are equal */

static bool is_more(double a, double b)
{
    return a > b * (1 + ROUND_OFF);
}

/* What makes them better, by the order of sp_place_is_beaten. */
static const char *merit(const sp_proposal *proposal, const sp_coverage *own, double outlay)
{
    const sp_coverage *found = proposal->coverage;
    bool more = is_more(own->fraction, found->fraction), less = is_more(proposal->outlay, outlay);
    if (own->covered_area < proposal->asked_area)
        return more ? "cover more" : "cover as much with less";
    if (found->covered_area < proposal->asked_area)
        return "cover what was asked for, which it does not";
    if (proposal->objective == SP_OBJECTIVE_AREA_PER_WATER)
        return proposal->costly ? "clean more area for their price" : "clean more area per water";
    if (less && (proposal->objective == SP_OBJECTIVE_MIN_WATER || !more))
        return proposal->costly ? "cover what was asked for at a lower price"
                                : "cover what was asked for with less water";
    return "cover more";
}

void sp_result_own_better(const sp_result *result, const sp_figures *figures, char text[SP_OWN_TEXT])
{
    const sp_proposal *proposal = result->proposal;
    text[0] = 0;
    for (size_t i = 0; proposal && i < result->design_count; i++) {
        const sp_design *own = &result->designs[i];
        double outlay = proposal->costly ? sp_figures_price(&figures[i]) : figures[i].flow;
        if (!strcmp(own->name, "manual") && sp_result_proposal(result, i) == proposal &&
            sp_limits_allow(proposal, figures[i].nozzle_count, figures[i].flow) &&
            sp_place_is_beaten(proposal, own->coverage, outlay))
            snprintf(text, SP_OWN_TEXT,
                     "By the objective the scene's own nozzles are better than the proposal: they %s.",
                     merit(proposal, own->coverage, outlay));
    }
}
