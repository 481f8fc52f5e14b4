/* What reasons are called. */
#include <sprayplan/result.h>

static const struct {
    const char *key, *text;
} names[SP_REASONS] = {
    [SP_REASON_NO_LINE] = {"no_line_of_reach", "no line of reach"},
    [SP_REASON_REFLECTION] = {"reflection_only", "by reflection only"},
    [SP_REASON_SLOW] = {"too_slow", "too slow"},
    [SP_REASON_SLANTED] = {"too_slanted", "too slanted"},
    [SP_REASON_FLUX] = {"too_little_flux", "too far for the flux"},
};

const char *sp_reason_key(sp_reason reason)
{
    return names[reason].key;
}

const char *sp_reason_text(sp_reason reason)
{
    return names[reason].text;
}
