/* Texels that are too long to resolve anything, as where a number stands without its unit. */
#include "cli.h"

#define FEWEST 10 /* texels along the geometry's diagonal, that patches still follow its surface with */

bool cli_warn_of_long_texel(const sp_setup *setup, char text[CLI_LONG_TEXEL])
{
    sp_vec3 low, high;
    double texel = setup->fidelity.texel, diagonal = sp_mesh_box(setup->mesh, &low, &high);
    if (!(FEWEST * texel > diagonal))
        return false;
    int used = snprintf(text, CLI_LONG_TEXEL,
                        "texel: %.4g m is more than a tenth of the geometry's diagonal of %.4g m, so that patches "
                        "cannot follow its surface",
                        texel, diagonal);
    if (texel >= 1 && FEWEST * texel <= 1e3 * diagonal)
        snprintf(text + used, CLI_LONG_TEXEL - (size_t)used, ": %.4g alone is %.4g m; did you mean %.4g mm?", texel,
                 texel, texel);
    return true;
}
