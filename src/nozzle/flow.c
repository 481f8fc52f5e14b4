/* What leaves a nozzle: how much, how fast, how wide. A nozzle's own settings go before those of its type. */
#include <sprayplan/nozzle.h>

#include <assert.h>

static const double water_density = 1000; /* kg/m³; catalogues print the flow of water */

double sp_type_flow(const sp_nozzle_type *type, double rated_flow, double pressure, const sp_fluid *liquid)
{
    assert(pressure >= 0 && type->at > 0 && liquid->density > 0);
    return rated_flow * pow(pressure / type->at, type->exponent) * sqrt(water_density / liquid->density);
}

double sp_nozzle_flow(const sp_nozzle *nozzle, const sp_fluid *liquid)
{
    if (nozzle->flow > 0)
        return nozzle->flow;
    return sp_type_flow(nozzle->type, nozzle->type->flow, nozzle->pressure, liquid);
}

double sp_nozzle_speed(const sp_nozzle *nozzle, const sp_fluid *liquid)
{
    if (nozzle->speed > 0)
        return nozzle->speed;
    return nozzle->type->cv * sqrt(2 * nozzle->pressure / liquid->density);
}
