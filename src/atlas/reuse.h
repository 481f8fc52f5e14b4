/* Texture coordinates of a file as an atlas. */
#ifndef ATLAS_REUSE_H
#define ATLAS_REUSE_H

/* The first line of an OBJ that sp_atlas_obj writes; the page's edge in texels and the texel in m follow. */
#define SP_ATLAS_MARK "# sprayplan atlas: texels along a page's edge, and metres of a texel: "

#endif
