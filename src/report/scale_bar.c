/* What stands under a picture: how long things are in it, and where the axes of the geometry's coordinates point. */
#include "overlay.h"

#include <stdlib.h>

#define MARGIN 10.0  /* pixels, all */
#define LONGEST 0.35 /* of the picture's width */
#define AXIS 30.0
#define LETTER 12.0 /* from an axis's end to its letter's middle */
#define LETTER_DROP 7.0
#define NEAR_LETTER 20.0
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

/* One of the axes as it is drawn, pixels. */
typedef struct {
    char name;
    double right, down; /* unit where it is seen whole */
    double at[2];       /* its letter's middle, from where the axes meet */
    bool beside;        /* its letter: beyond its end that of another is near */
} drawn_axis;

static double seen_of(const drawn_axis *axis)
{
    return hypot(axis->right, axis->down);
}

static int longest_first(const void *left, const void *right)
{
    double a = seen_of(left), b = seen_of(right);
    return (a < b) - (a > b);
}

/* Beyond its end, or beside it where the letters of the `before` axes in front of it are near. */
static void place_letter(drawn_axis *axis, const drawn_axis *others, size_t before)
{
    double seen = seen_of(axis), far = AXIS + LETTER / seen;
    axis->at[0] = far * axis->right;
    axis->at[1] = far * axis->down;
    for (size_t i = 0; i < before && !axis->beside; ++i)
        axis->beside = hypot(axis->at[0] - others[i].at[0], axis->at[1] - others[i].at[1]) < NEAR_LETTER;
    if (!axis->beside)
        return;
    axis->at[0] = AXIS * axis->right + LETTER * axis->down / seen;
    axis->at[1] = AXIS * axis->down - LETTER * axis->right / seen;
}

static void add_axis(sp_text *text, const drawn_axis *axis, double x, double y)
{
    double seen = seen_of(axis), across = axis->beside ? 0.5 * LETTER / seen : 0; /* a stroke says where it ends */
    sp_text_add(text,
                "<path class=\"axis\" d=\"M%.1f %.1fl%.1f %.1fl%.1f %.1f\"/><text class=\"length\" x=\"%.1f\" "
                "y=\"%.1f\" text-anchor=\"middle\">%c</text>",
                x, y, AXIS * axis->right, AXIS * axis->down, across * axis->down, -across * axis->right,
                x + axis->at[0], y + axis->at[1] + LETTER_DROP, axis->name);
}

static void add_axes(sp_text *text, const sp_camera *camera)
{
    const sp_vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    drawn_axis drawn[3];
    double x = MARGIN + AXIS + LETTER, y = camera->height + 0.5 * SP_SCALE_STRIP;
    for (int k = 0; k < 3; ++k)
        drawn[k] = (drawn_axis){
            .name = "xyz"[k], .right = sp_dot(axes[k], camera->right), .down = -sp_dot(axes[k], camera->up)};
    qsort(drawn, 3, sizeof *drawn, longest_first);
    for (size_t k = 0; k < 3 && seen_of(&drawn[k]) > SHORTEST; ++k) {
        place_letter(&drawn[k], drawn, k);
        add_axis(text, &drawn[k], x, y);
    }
    sp_text_add(text, "\n");
}

void sp_overlay_scale(sp_text *text, const sp_camera *camera)
{
    add_length(text, camera);
    add_axes(text, camera);
}
