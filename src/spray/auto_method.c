/* Method and reflections that the setup leaves to auto, whatever the layout. */
#include "auto_settings.h"

#define REFLECTIONS 3

static bool resolve_method(const sp_setup *setup, sp_fidelity *fidelity, sp_error *error)
{
    bool reflects = fidelity->reflections != 0 && sp_setup_throws_back(setup);
    if (fidelity->method == SP_METHOD_INVERSE && fidelity->reflections > 0)
        return sp_fail(
            error, SP_ERROR_INPUT, NULL, 0, 0,
            "reflections: %d found with evaluator inverse, which knows primary impact only; expected 0 or auto, "
            "or evaluator forward",
            fidelity->reflections);
    if (fidelity->method == SP_METHOD_INVERSE && fidelity->splat == SP_SPLAT_LINEAR)
        return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                       "splat: linear found with evaluator inverse, which has no jets to share; expected nearest, or "
                       "evaluator forward");
    if (fidelity->method == SP_METHOD_AUTO)
        fidelity->method = reflects || fidelity->splat == SP_SPLAT_LINEAR ? SP_METHOD_FORWARD : SP_METHOD_INVERSE;
    if (fidelity->method == SP_METHOD_INVERSE)
        fidelity->reflections = 0;
    else if (fidelity->reflections < 0)
        fidelity->reflections = reflects ? REFLECTIONS : 0;
    return true;
}

bool sp_auto_method(const sp_setup *setup, sp_fidelity *fidelity, sp_error *error)
{
    *fidelity = setup->fidelity;
    if (fidelity->trajectory == SP_TRAJECTORY_AUTO)
        fidelity->trajectory = SP_TRAJECTORY_PARABOLA;
    return resolve_method(setup, fidelity, error);
}
