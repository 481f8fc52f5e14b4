#include "channels.h"

const char *const sp_channel_names[SP_CHANNELS] = {"flux",      "jets",          "speed",  "speed_max",
                                                   "incidence", "incidence_min", "impact", "impact_max",
                                                   "covered",   "area",          "film",   "chart"};

double sp_channel_of(const sp_design *design, uint32_t patch, int channel)
{
    const sp_deposits *deposits = &design->coverage->deposits;
    const sp_patches *patches = sp_evaluator_patches(design->evaluator);
    const double *const values[SP_CHANNEL_CHART] = {deposits->flux,      deposits->jets,       deposits->speed,
                                                    deposits->speed_max, deposits->incidence,  deposits->incidence_min,
                                                    deposits->impact,    deposits->impact_max, deposits->share,
                                                    patches->area,       deposits->film};
    if (channel == SP_CHANNEL_CHART)
        return sp_atlas_place(sp_evaluator_atlas(design->evaluator), patches->texel[patch]).chart;
    return values[channel][patch];
}
