/* From charts to places on the pages. */
#ifndef ATLAS_PACK_H
#define ATLAS_PACK_H

#include <sprayplan/atlas.h>

/* Fills uv, chart_page, page_edge and page_count of an atlas that has its texel, counts, and room for both arrays.
 * `limit` is the largest page edge. */
bool sp_atlas_pack(sp_atlas *atlas, const sp_charts *charts, sp_packing packing, uint32_t limit, sp_error *error);

#endif
