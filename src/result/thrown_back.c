/* Whether what walls throw back is in the layouts' figures. */
#include <sprayplan/result.h>

static bool throws_back(const sp_setup *setup)
{
    for (size_t i = 0; i < setup->mesh->part_count; i++)
        if (setup->surfaces[i].restitution > 0 && setup->surfaces[i].rebound > 0)
            return true;
    return false;
}

bool sp_result_counts_thrown_back(const sp_result *result)
{
    size_t proposed = sp_result_proposed(result);
    const sp_evaluator *evaluator = proposed == SP_UNKNOWN ? NULL : result->designs[proposed].evaluator;
    return evaluator && sp_evaluator_fidelity(evaluator)->reflections > 0 && throws_back(sp_evaluator_setup(evaluator));
}
