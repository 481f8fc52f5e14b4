/* What deposits.exr and texels.vtp hold of a patch, under the same names and in SI units. */
#ifndef REPORT_CHANNELS_H
#define REPORT_CHANNELS_H

#include <sprayplan/result.h>

#define SP_CHANNELS 12
#define SP_CHANNEL_CHART (SP_CHANNELS - 1)
extern const char *const sp_channel_names[SP_CHANNELS];

double sp_channel_of(const sp_design *design, uint32_t patch, int channel);

#endif
