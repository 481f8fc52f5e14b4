/* Whether what walls throw back is in the layouts' figures. */
#include <sprayplan/result.h>

bool sp_result_counts_thrown_back(const sp_result *result)
{
    size_t proposed = sp_result_proposed(result);
    return proposed != SP_UNKNOWN && sp_evaluator_counts_thrown_back(result->designs[proposed].evaluator);
}
