/* What layouts side by side do not have in common besides their nozzles, said before their figures. */
#include "cli.h"

#include <math.h>

static void print_geometries(const sp_result *result, const sp_figures *figures)
{
    if (sp_figures_share_surface(figures, result->design_count))
        return;
    for (size_t i = 0; i < result->design_count; i++) {
        printf("%s%s ", i ? "; " : "the geometries differ in what is to be cleaned: ", result->designs[i].name);
        if (sp_figures_tell_surface(&figures[i]))
            printf("%.4g m2, %zu triangles", figures[i].clean_area, figures[i].triangles);
        else
            printf("not told");
    }
    printf("\n\n");
}

static void print_criteria(const sp_result *result, const sp_figures *figures)
{
    bool one = sp_figures_share_criterion(figures, result->design_count);
    if (result->design_count < 2 || (one && figures[0].criterion_known))
        return;
    if (one)
        printf("these results do not tell what covered means in them: that may differ");
    for (size_t i = 0; i < result->design_count && !one; i++) {
        char clause[SP_CRITERION_TEXT];
        sp_criterion_clause(&figures[i], clause);
        printf("%s%s %s", i ? "; " : "the criteria differ in what covered means: ", result->designs[i].name, clause);
    }
    printf("\n\n");
}

static void print_texels(const sp_result *result, const sp_figures *figures)
{
    if (sp_figures_share_texel(figures, result->design_count))
        return;
    for (size_t i = 0; i < result->design_count; i++) {
        printf("%s%s ", i ? "; " : "the texels differ, and with them figures, by about as much as these are off: ",
               result->designs[i].name);
        if (isfinite(figures[i].texel))
            printf("%.3g mm", 1e3 * figures[i].texel);
        else
            printf("not told");
    }
    printf("\n\n");
}

void cli_print_differing(const sp_result *result, const sp_figures *figures)
{
    print_geometries(result, figures);
    print_criteria(result, figures);
    print_texels(result, figures);
}
