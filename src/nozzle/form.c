/* All forms of patterns. */
#include "form.h"

const sp_form *const sp_forms[] = {
    [SP_PATTERN_FULL_CONE] = &sp_full_cone,  [SP_PATTERN_HOLLOW_CONE] = &sp_hollow_cone,
    [SP_PATTERN_FLAT_FAN] = &sp_flat_fan,    [SP_PATTERN_SOLID_STREAM] = &sp_solid_stream,
    [SP_PATTERN_CLUSTER] = &sp_cluster_body, [SP_PATTERN_ROTATING] = &sp_rotating,
    [SP_PATTERN_MEASURED] = &sp_measured,
};
const size_t sp_form_count = sizeof sp_forms / sizeof *sp_forms;
