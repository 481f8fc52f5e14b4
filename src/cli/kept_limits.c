/* Limits on number and water that the nozzles to be kept alone go beyond: what `place` answers with these alone. */
#include "cli.h"

#include <math.h>

#define ROUND_OFF 1e-9 /* of the water, by which a sum of flows may lie above what is allowed */

typedef struct {
    size_t nozzles;
    double flow; /* m³/s */
} kept_sum;

static kept_sum sum_kept(const cli_scene *opened)
{
    const sp_layout *layout = sp_scene_layout(opened->scene);
    kept_sum kept = {0};
    for (size_t i = 0; i < layout->count; i++)
        if (layout->nozzles[i].keep) {
            kept.nozzles++;
            kept.flow += sp_nozzle_flow(&layout->nozzles[i], &sp_scene_setup(opened->scene)->liquid);
        }
    return kept;
}

/* `alternative`: its name, NULL for the limits of `place` itself. */
static void warn_of_limits(kept_sum kept, const sp_place_options *limits, const char *alternative,
                           cli_warning_handler *warn, void *user)
{
    char text[320], of[160] = "place";
    if (alternative)
        snprintf(of, sizeof of, "alternative \"%s\"", alternative);
    if (kept.flow > limits->max_water * (1 + ROUND_OFF)) {
        snprintf(text, sizeof text,
                 "%s: max_water of %.4g L/min is less than the %.4g L/min that the %zu nozzle%s to keep take%s", of,
                 6e4 * limits->max_water, 6e4 * kept.flow, kept.nozzles, kept.nozzles == 1 ? "" : "s",
                 kept.nozzles == 1 ? "s" : "");
        warn(user, text);
    }
    if (limits->max_nozzles > 0 && kept.nozzles > limits->max_nozzles) {
        snprintf(text, sizeof text, "%s: max_nozzles of %zu is less than the %zu nozzles to keep", of,
                 limits->max_nozzles, kept.nozzles);
        warn(user, text);
    }
}

/* An alternative that says nothing of its own has the limits of `place`, which are warned of once. */
void cli_warn_of_kept_limits(const cli_scene *opened, cli_warning_handler *warn, void *user)
{
    const kept_sum kept = sum_kept(opened);
    const sp_place_options place = sp_scene_place_options(opened->scene);
    warn_of_limits(kept, &place, NULL, warn, user);
    for (size_t i = 0; i < sp_scene_alternative_count(opened->scene); i++) {
        sp_place_options own = sp_scene_alternative_options(opened->scene, i);
        if (own.max_nozzles == place.max_nozzles)
            own.max_nozzles = 0;
        if (!(own.max_water < place.max_water) && !(own.max_water > place.max_water))
            own.max_water = INFINITY;
        warn_of_limits(kept, &own, sp_scene_alternative_name(opened->scene, i), warn, user);
    }
}
