/* Whether what walls throw back is in the layouts' figures. */
#include <sprayplan/result.h>

bool sp_result_counts_thrown_back(const sp_result *result)
{
    size_t proposed = sp_result_proposed(result);
    const sp_evaluator *evaluator = proposed == SP_UNKNOWN ? NULL : result->designs[proposed].evaluator;
    return evaluator && sp_evaluator_fidelity(evaluator)->reflections > 0 &&
           sp_setup_throws_back(sp_evaluator_setup(evaluator));
}
