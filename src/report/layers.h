/* The atlas seen from each side: which patch lies under a texel or a point of the surface, and pages as pictures. */
#ifndef REPORT_LAYERS_H
#define REPORT_LAYERS_H

#include "false_colour.h"

/* Layer 0 is the front (or both sides as one), layer 1 the back. */
typedef struct {
    const sp_evaluator *evaluator;
    uint32_t *patch[2];    /* [texel_count], SP_NONE where that side of the texel is not cleaned */
    bool two_sided;        /* no cavity: the back shows what the front does */
    bool has_back;         /* layer 1 holds something */
    uint8_t *chart_colour; /* [chart_count], see sp_chart_colours; NULL unless charts are shown */
} sp_layers;

bool sp_layers_create(sp_layers *layers, const sp_evaluator *evaluator, sp_error *error);
/* The same for pictures that may show charts. */
bool sp_layers_create_for(sp_layers *layers, const sp_evaluator *evaluator, const sp_colour_scale *scale,
                          sp_error *error);
void sp_layers_free(sp_layers *layers);
/* chart_colours.c: a colour's number below SP_CHART_COLOURS for every chart [chart_count], unlike that of each chart
 * that it meets along a cut while it meets fewer others than there are colours. The caller frees. */
#define SP_CHART_COLOURS 12
extern const uint8_t sp_chart_palette[SP_CHART_COLOURS][3];
uint8_t *sp_chart_colours(const sp_atlas *atlas, sp_error *error);
/* The colour of a patch, of charts too. */
void sp_layers_colour(const sp_layers *layers, const sp_colour_scale *scale, const sp_deposits *deposits,
                      uint32_t patch, int stripe, uint8_t rgb[3]);

/* True where some of that side of the triangle faces the liquid, cleaned or not. */
bool sp_layers_wet(const sp_layers *layers, uint32_t triangle, int back);
/* True where that side of the triangle is cleaned and counted. */
bool sp_layers_clean(const sp_layers *layers, uint32_t triangle, int back);
/* The patch at (1-u-v, u, v) of a triangle, SP_NONE where that side is not cleaned there. */
uint32_t sp_layers_patch(const sp_layers *layers, uint32_t triangle, double u, double v, int back);

/* Pixels of a page are texels; the first row is the highest y, as pictures and OBJ textures have it. */
size_t sp_layers_pixel(const sp_atlas *atlas, sp_texel_place place);

/* One page in false colour, malloc'd RGB of page_edge² pixels. What is not cleaned is grey, what holds no surface
 * `background`; with `spread` the charts run one texel over their rims, so that a texture leaves no seams. */
uint8_t *sp_layers_picture(const sp_layers *layers, const sp_coverage *coverage, const sp_colour_scale *scale,
                           size_t page, int layer, const uint8_t background[3], bool spread, sp_error *error);

#endif
