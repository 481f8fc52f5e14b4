/* What reasons and lacks are called, and which parts reasons concern. */
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

const char *sp_reason_text(const sp_figures *figures, sp_reason reason)
{
    if (reason == SP_REASON_FLUX && sp_figures_ask_no_amount(figures))
        return "beyond the limits";
    return names[reason].text;
}

static const struct {
    const char *key, *text;
} lacks[SP_LACKS] = {
    [SP_LACK_REACH] = {"no_nozzle_in_reach", "no nozzle in reach"},
    [SP_LACK_SPEED] = {"too_slow", "too slow"},
    [SP_LACK_ANGLE] = {"too_slanted", "too slanted"},
    [SP_LACK_FLUX] = {"too_little_flux", "too little"},
};

const char *sp_lack_key(sp_lack lack)
{
    return lacks[lack].key;
}

const char *sp_lack_text(sp_lack lack)
{
    return lacks[lack].text;
}

/* Whether the reason keeps something of part k out of reach, and less than of the part `last`. */
static bool comes_after(const sp_missing_figures *parts, sp_reason reason, size_t k, size_t last)
{
    double area = parts[k].areas[reason], before = last == SP_UNKNOWN ? INFINITY : parts[last].areas[reason];
    return area > 0 && (area < before || (area == before && k > last));
}

size_t sp_missing_next(const sp_figures *figures, sp_reason reason, size_t last)
{
    const sp_missing_figures *parts = figures->missing;
    size_t next = SP_UNKNOWN;
    for (size_t k = 0; k < figures->missing_count; k++)
        if (comes_after(parts, reason, k, last) &&
            (next == SP_UNKNOWN || parts[k].areas[reason] > parts[next].areas[reason]))
            next = k;
    return next;
}

size_t sp_missing_after(const sp_figures *figures, sp_reason reason, size_t last, double *area)
{
    size_t count = 0;
    *area = 0;
    for (size_t k = 0; k < figures->missing_count; k++)
        if (comes_after(figures->missing, reason, k, last)) {
            *area += figures->missing[k].areas[reason];
            count++;
        }
    return count;
}
