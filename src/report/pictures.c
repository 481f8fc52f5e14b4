/* Three views of every design, with the colour bar. */
#include "clock.h"
#include "labels.h"
#include "layers.h"
#include "overlay.h"
#include "page.h"
#include "render.h"

#include "result/design.h"

#include <sprayplan/image.h>

#include <stdlib.h>
#include <string.h>

#ifndef PIXELS /* fewer under the sanitizers */
#define PIXELS 900
#endif
#define PIXELS_OF_MANY (PIXELS / 3 * 2) /* each, from the fifth design on */

#define SMALLER 4 /* of pictures that tell how long the others take, by edge; and others half as large */

#define LOOK_GREY (SP_LOOK_NOTHING - 1)

/* Patches; grey what needs no cleaning; what is dry is looked through. */
static uint32_t look_at_patch(const void *user, uint32_t triangle, double u, double v, int back)
{
    const sp_layers *layers = user;
    if (!(sp_evaluator_wet_at(layers->evaluator, triangle, u, v) >> back & 1))
        return SP_LOOK_NOTHING;
    uint32_t patch = sp_layers_patch(layers, triangle, u, v, back);
    return patch == SP_NONE ? LOOK_GREY : patch;
}

/* What the colours of one design's patches come from. */
typedef struct {
    const sp_layers *layers;
    const sp_colour_scale *scale;
    const sp_deposits *deposits;
} colouring;

static void colour_patch(const void *user, uint32_t look, int stripe, uint8_t rgb[3])
{
    const colouring *by = user;
    if (look == LOOK_GREY)
        memcpy(rgb, sp_colour_obstacle, 3);
    else
        sp_layers_colour(by->layers, by->scale, by->deposits, look, stripe, rgb);
}

/* `camera` is that of a picture at full size: what is written over a smaller shot keeps its size on the page. */
static bool add_picture(const sp_page *page, sp_text *text, size_t design, const sp_viewpoint *viewpoint,
                        const sp_camera *camera, const sp_layers *layers, const sp_shot *shot,
                        const sp_listed_shadows *shadows, sp_error *error)
{
    const sp_design *shown = &page->result->designs[design];
    const colouring by = {layers, &page->scale, &shown->coverage->deposits};
    uint8_t *pixels = sp_shot_picture(shot, colour_patch, &by, error);
    size_t size = 0;
    uint8_t *bytes = pixels ? sp_image_encode_webp(pixels, shot->width, shot->height, &size, error) : NULL;
    free(pixels);
    if (!bytes)
        return false;
    sp_text_add(text, "<figure><svg class=\"view\" viewBox=\"0 0 %d %d\" role=\"img\" aria-label=\"", camera->width,
                camera->height + SP_SCALE_STRIP);
    sp_page_name(page, text, design);
    sp_text_add(text,
                ", %s: %s in false colour with %zu nozzle%s\"><image width=\"%d\" height=\"%d\" "
                "preserveAspectRatio=\"none\" href=\"data:image/webp;base64,",
                viewpoint->caption,
                page->scale.style.quantity == SP_QUANTITY_FLUX ? "coverage"
                                                               : sp_quantity_words_of[page->scale.style.quantity].name,
                shown->layout->count, shown->layout->count == 1 ? "" : "s", camera->width, camera->height);
    sp_markup_base64(text, bytes, size);
    sp_text_add(text, "\"/>\n");
    free(bytes);
    sp_overlay_sprays(text, camera, shown->evaluator, shown->layout);
    sp_labels labels = {.width = camera->width, .height = camera->height, .sample = 0.5 * camera->width / shot->width};
    sp_labels_nozzles(&labels, text, camera, shown->layout);
    sp_labels_shadows(&labels, text, shot, shadows);
    sp_overlay_scale(text, camera);
    sp_text_add(text, "</svg><figcaption>");
    sp_page_name(page, text, design);
    sp_text_add(text, "<br><span class=\"unit\">");
    sp_page_coverage(text, &page->figures[design]);
    sp_text_add(text, " with ");
    sp_markup_water(text, 6e4 * page->figures[design].flow);
    sp_text_add(text, "&nbsp;L/min</span></figcaption></figure>\n");
    return true;
}

/* What is found once serves all designs in a row that share an evaluator. */
static bool add_view(const sp_page *page, sp_text *text, const sp_viewpoint *viewpoint, int full, int pixels,
                     const sp_listed_shadows *shadows, sp_error *error)
{
    sp_camera camera = {0};
    sp_layers layers = {0};
    sp_shot shot = {0};
    bool done = true;
    for (size_t i = 0; done && i < page->result->design_count; ++i) {
        const sp_evaluator *evaluator = page->result->designs[i].evaluator;
        if (!evaluator)
            continue;
        if (layers.evaluator != evaluator) {
            sp_layers_free(&layers);
            sp_shot_free(&shot);
            camera = sp_camera_create(evaluator, page->result, viewpoint, full);
            sp_camera smaller = sp_camera_create(evaluator, page->result, viewpoint, pixels);
            done =
                sp_layers_create_for(&layers, evaluator, &page->scale, error) &&
                sp_shot_create(&shot, evaluator, &smaller, page->scale.style.wireframe, look_at_patch, &layers, error);
        }
        done = done && add_picture(page, text, i, viewpoint, &camera, &layers, &shot, &shadows[i], error);
    }
    sp_shot_free(&shot);
    sp_layers_free(&layers);
    return done;
}

/* How the geometry was opened, which a reader must know to understand the pictures. */
static void add_note(const sp_page *page, sp_text *text, const sp_evaluator *first)
{
    sp_cavity_kind cavity = sp_evaluator_setup(first)->cavity;
    sp_camera camera = sp_camera_create(first, page->result, &sp_viewpoints[0], PIXELS);
    sp_text_add(
        text,
        "<p class=\"note\">One colour scale for all pictures. %s Dots are nozzles; the outlines show where and how "
        "wide they spray, not how far. Numbers are those of the <a href=\"#shadows\">spray shadows</a>. What lies "
        "behind a nearer "
        "edge is shaded along it. The bar's length is to scale at the middle's depth; x, y, z are the geometry's.",
        cavity == SP_CAVITY_POINT ? "Walls are looked through from outside, so that their wet inner sides show."
        : camera.cut              ? "The geometry is cut open across the line of sight at its middle."
                                  : "");
    for (size_t i = 0; i < page->result->design_count; ++i)
        if (!page->result->designs[i].evaluator) {
            sp_text_add(text, " Designs known only from a result.json have no pictures.");
            break;
        }
    sp_text_add(text, "</p>\n");
}

/* Of every design [design_count]; all zeros of those without an evaluator. */
static sp_listed_shadows *list_shadows(const sp_result *result, sp_error *error)
{
    sp_listed_shadows *shadows = calloc(result->design_count + 1, sizeof *shadows);
    bool done = shadows || sp_fail_memory(error);
    for (size_t i = 0; done && i < result->design_count; ++i)
        done = !result->designs[i].evaluator || sp_listed_shadows_find(&shadows[i], &result->designs[i], error);
    for (size_t i = 0; !done && shadows && i < result->design_count; ++i)
        sp_listed_shadows_free(&shadows[i]);
    if (!done) {
        free(shadows);
        shadows = NULL;
    }
    return shadows;
}

/* As large as they are best. */
static int full_size(size_t drawn)
{
    return drawn > 4 ? PIXELS_OF_MANY : PIXELS;
}

static bool add_views(const sp_page *page, sp_text *text, size_t drawn, sp_error *error)
{
    double share = page->result->picture_share;
    int full = full_size(drawn), pixels = share > 0 ? 2 * (int)(share * full / 2) : full;
    sp_listed_shadows *shadows = list_shadows(page->result, error);
    bool done = shadows != NULL;
    /* three alternatives and the manual layout make a square */
    size_t row = drawn < 3 ? drawn : drawn == 4 && page->alternatives ? 2 : 3;
    for (int i = 0; done && i < SP_VIEWPOINTS; ++i) {
        sp_text_add(text, "<div class=\"block\"><h3>%s</h3>\n<div class=\"views of%zu\">\n", sp_viewpoints[i].caption,
                    row);
        done = add_view(page, text, &sp_viewpoints[i], full, pixels, shadows, error);
        sp_text_add(text, "</div></div>\n");
    }
    for (size_t i = 0; shadows && i < page->result->design_count; ++i)
        sp_listed_shadows_free(&shadows[i]);
    free(shadows);
    return done;
}

/* What one view takes, s: whatever its size, to find what it shows, and of each design to paint and pack it. */
typedef struct {
    double layers, showing, painting;
} view_time;

/* One view of a design, drawn and thrown away. */
static bool try_view(const sp_result *result, const sp_design *design, int pixels, view_time *taken, sp_error *error)
{
    const sp_colour_scale scale = sp_colour_scale_of(design, 1, result->style);
    sp_camera camera = sp_camera_create(design->evaluator, result, &sp_viewpoints[0], pixels);
    sp_layers layers = {0};
    sp_shot shot = {0};
    const colouring by = {&layers, &scale, &design->coverage->deposits};
    size_t size = 0;
    double start = sp_now();
    bool done = sp_layers_create_for(&layers, design->evaluator, &scale, error);
    double laid = sp_now();
    done =
        done && sp_shot_create(&shot, design->evaluator, &camera, scale.style.wireframe, look_at_patch, &layers, error);
    double shown = sp_now();
    uint8_t *drawn = done ? sp_shot_picture(&shot, colour_patch, &by, error) : NULL;
    uint8_t *bytes = drawn ? sp_image_encode_webp(drawn, shot.width, shot.height, &size, error) : NULL;
    *taken = (view_time){laid - start, shown - laid, sp_now() - shown};
    done = bytes != NULL;
    free(bytes);
    free(drawn);
    sp_shot_free(&shot);
    sp_layers_free(&layers);
    return done;
}

/* By what it takes at two sizes: one part grows with the area, the other, which is of triangles, does not. */
static double at_full_size(double smaller, double half_of_it)
{
    return smaller + (SMALLER * SMALLER - 1) / 0.75 * fmax(smaller - half_of_it, 0);
}

bool sp_report_picture_time(const sp_result *result, double *seconds, sp_error *error)
{
    if (!sp_result_is_whole(result, error))
        return false;
    const sp_design *first = NULL;
    size_t drawn = 0;
    for (size_t i = 0; i < result->design_count; ++i)
        if (result->designs[i].evaluator && !drawn++)
            first = &result->designs[i];
    int pixels = full_size(drawn) / SMALLER;
    view_time half = {0}, one = {0};
    bool done =
        !first || (try_view(result, first, pixels / 2, &half, error) && try_view(result, first, pixels, &one, error));
    *seconds = SP_VIEWPOINTS * (one.layers + at_full_size(one.showing, half.showing) +
                                (double)drawn * at_full_size(one.painting, half.painting));
    return done;
}

bool sp_page_pictures(const sp_page *page, sp_text *text, sp_error *error)
{
    const sp_evaluator *first = NULL;
    size_t drawn = 0;
    for (size_t i = 0; i < page->result->design_count; ++i)
        if (page->result->designs[i].evaluator) {
            first = first ? first : page->result->designs[i].evaluator;
            drawn++;
        }
    if (drawn == 0 || page->result->picture_share < 0)
        return true;
    sp_text_add(text, "<section id=\"pictures\"><h2>Coverage in pictures</h2>\n");
    sp_page_colour_bar(page, text);
    add_note(page, text, first);
    bool done = add_views(page, text, drawn, error);
    sp_text_add(text, "</section>\n");
    return done;
}
