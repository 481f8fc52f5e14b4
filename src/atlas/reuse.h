/* Texture coordinates of a file as an atlas. */
#ifndef ATLAS_REUSE_H
#define ATLAS_REUSE_H

#include <sprayplan/atlas.h>

/* The first line of an OBJ that sp_atlas_obj writes; the page's edge in texels and the texel in m follow. */
#define SP_ATLAS_MARK "# sprayplan atlas: texels along a page's edge, and metres of a texel: "

/* As sp_unfolding_read, from the file's text of `size` bytes with a '\0' behind them. Needs the "C" locale. */
sp_unfolding *sp_unfolding_parse(const char *path, const char *text, size_t size, double unit, sp_error *error);

#endif
