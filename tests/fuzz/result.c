/* result.json. */
#include "result/figures.h"
#include "target.h"

#include <math.h>

bool target_accepted;

static void require_share(double share)
{
    REQUIRE(isnan(share) || (share >= 0 && share <= 1 + 1e-9));
}

static void require_sound(const sp_figures *figures)
{
    REQUIRE(figures->name[0] && figures->flow >= 0 && figures->coverage >= 0 && isfinite(figures->flow));
    REQUIRE(memchr(figures->trajectory, '\0', sizeof figures->trajectory));
    REQUIRE(memchr(figures->evaluator, '\0', sizeof figures->evaluator));
    require_utf8(figures->name);
    require_share(figures->coverage);
    require_share(figures->of_attainable);
    require_share(figures->misjudged);
    REQUIRE(figures->shadow_count <= SP_SHADOWS_KEPT);
    for (size_t i = 0; i < figures->shadow_count; i++) {
        const sp_shadow_figures *shadow = &figures->shadows[i];
        require_utf8(shadow->part);
        REQUIRE(shadow->reachable >= -1 && shadow->reachable <= 1 && shadow->reason < SP_REASONS);
        REQUIRE(!isinf(shadow->area) && !isinf(shadow->centroid.x));
    }
    for (size_t i = 0; i < figures->missing_count; i++)
        require_utf8(figures->missing[i].part);
    for (size_t i = 0; i < figures->nozzle_count; i++) {
        const sp_nozzle_figures *nozzle = &figures->nozzles[i];
        require_utf8(nozzle->name);
        require_utf8(nozzle->type);
        require_utf8(nozzle->order_code);
        require_utf8(nozzle->url);
        REQUIRE(!nozzle->url[0] || sp_is_url(nozzle->url));
        REQUIRE(!isinf(nozzle->flow) && !isinf(nozzle->position.x) && !isinf(nozzle->roll));
    }
}

static bool same(double a, double b)
{
    return (isnan(a) && isnan(b)) || fabs(a - b) <= 1e-12 * fabs(a);
}

/* Written by itself and read again it is the same. */
static void require_written(const sp_figures *figures)
{
    sp_error error = {0};
    size_t count;
    const sp_design design = {.name = figures->name, .figures = figures};
    const sp_result result = {.command = "compare", .scene = "", .design_count = 1, .designs = &design};
    char *text = sp_result_json(&result, &error);
    REQUIRE(text);
    sp_figures *again = sp_figures_parse("again", text, strlen(text), &count, &error);
    if (!again)
        fprintf(stderr, "%s in\n%s", error.message, text);
    REQUIRE(again && count == 1 && strcmp(again->name, figures->name) == 0);
    REQUIRE(again->shadow_count == figures->shadow_count && again->nozzle_count == figures->nozzle_count);
    REQUIRE(same(figures->flow, again->flow) && same(figures->coverage, again->coverage));
    REQUIRE(same(figures->area, again->area) && same(figures->flux_min, again->flux_min));
    for (size_t i = 0; i < figures->nozzle_count; i++)
        REQUIRE(strcmp(figures->nozzles[i].name, again->nozzles[i].name) == 0 &&
                same(figures->nozzles[i].pressure, again->nozzles[i].pressure));
    free(text);
    sp_figures_destroy(again, count);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    sp_error error = {0};
    size_t count;
    meter_start();
    char *text = target_text(data, size);
    sp_figures *figures = sp_figures_parse("strange", text, size, &count, &error);
    free(text);
    require_frugal(size);
    target_accepted = figures != NULL;
    REQUIRE(target_accepted == (error.kind == SP_OK) && target_accepted == (count > 0));
    for (size_t i = 0; i < count; i++)
        require_sound(&figures[i]);
    if (figures)
        require_written(&figures[0]);
    else
        require_located(&error, "strange", data, size);
    sp_figures_destroy(figures, count);
    return 0;
}
