/* The limits that layouts were looked for within, where they may be what keeps surface out of reach. */
#include <sprayplan/result.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#define ROUND_OFF 1e-9 /* of the water, by which a sum of flows may lie above what is allowed */
#define MORE 1e-3      /* of the water: less is left over where nozzles' flows do not add up to what is allowed */

bool sp_limits_allow(const sp_proposal *proposal, size_t nozzles, double flow)
{
    return (proposal->max_nozzles == 0 || nozzles <= proposal->max_nozzles) &&
           flow <= proposal->max_water * (1 + ROUND_OFF);
}

bool sp_exceeds_limits(const sp_proposal *proposal)
{
    return !sp_limits_allow(proposal, proposal->layout->count, proposal->coverage->flow);
}

bool sp_allows_more_water(const sp_proposal *proposal)
{
    const sp_certificate *found = &proposal->certificate;
    return proposal->objective == SP_OBJECTIVE_MAX_COVERAGE && !found->every_layout &&
           found->area_bound < found->whole && sp_limits_allow(proposal, 0, proposal->coverage->flow * (1 + MORE));
}

void sp_limits_clause(const sp_proposal *proposal, char text[SP_LIMITS_TEXT])
{
    bool number = proposal->max_nozzles > 0, water = proposal->max_water > 0 && isfinite(proposal->max_water);
    text[0] = '\0';
    if (number)
        snprintf(text, SP_LIMITS_TEXT, "%zu nozzle%s (max_nozzles)", proposal->max_nozzles,
                 proposal->max_nozzles == 1 ? "" : "s");
    size_t used = strlen(text);
    if (water)
        snprintf(text + used, SP_LIMITS_TEXT - used, "%s%.4g L/min (max_water)", number ? " and " : "",
                 6e4 * proposal->max_water);
}
