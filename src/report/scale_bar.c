/* What stands under a picture: how long things are in it, and where the axes of the geometry's coordinates point. */
#include "overlay.h"

#define MARGIN 10.0  /* pixels, all */
#define LONGEST 0.35 /* of the picture's width */
#define AXIS 30.0
#define LETTER 12.0 /* from an axis's end to its letter's middle */
#define LETTER_DROP 7.0
#define SHORTEST 0.3 /* of an axis: one that points at the reader or away is a dot */

/* The longest of 1, 2 or 5 times a power of ten below `most`. */
static double round_length(double most)
{
    double power = pow(10, floor(log10(most)));
    return power * (most >= 5 * power ? 5 : most >= 2 * power ? 2 : 1);
}

static void add_length(sp_text *text, const sp_camera *camera)
{
    double pixels = 0.5 * camera->width / (camera->reach_x * camera->distance); /* of a metre */
    double length = round_length(LONGEST * camera->width / pixels), right = camera->width - MARGIN;
    double y = camera->height + 0.5 * SP_SCALE_STRIP, left = right - length * pixels;
    sp_text_add(text, "<path class=\"axis\" d=\"M%.1f %.1fv12M%.1f %.1fH%.1fM%.1f %.1fv12\"/>", left, y - 6, left, y,
                right, right, y - 6);
    sp_text_add(text, "<text class=\"length\" x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\">%g %s</text>\n",
                0.5 * (left + right), y + 30, length < 1 ? 1e3 * length : length, length < 1 ? "mm" : "m");
}

static void add_axes(sp_text *text, const sp_camera *camera)
{
    const sp_vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    double x = MARGIN + AXIS + LETTER, y = camera->height + 0.5 * SP_SCALE_STRIP;
    for (int k = 0; k < 3; ++k) {
        double right = sp_dot(axes[k], camera->right), down = -sp_dot(axes[k], camera->up);
        double seen = hypot(right, down), far = seen > SHORTEST ? AXIS + LETTER / seen : 0;
        if (!(seen > SHORTEST))
            continue;
        sp_text_add(text,
                    "<path class=\"axis\" d=\"M%.1f %.1fl%.1f %.1f\"/><text class=\"length\" x=\"%.1f\" y=\"%.1f\" "
                    "text-anchor=\"middle\">%c</text>",
                    x, y, AXIS * right, AXIS * down, x + far * right, y + far * down + LETTER_DROP, "xyz"[k]);
    }
    sp_text_add(text, "\n");
}

void sp_overlay_scale(sp_text *text, const sp_camera *camera)
{
    add_length(text, camera);
    add_axes(text, camera);
}
