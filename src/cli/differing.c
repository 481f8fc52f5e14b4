/* What layouts side by side do not have in common besides their nozzles, said before their figures. */
#include "cli.h"

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

void cli_print_differing(const sp_result *result, const sp_figures *figures)
{
    print_geometries(result, figures);
}
