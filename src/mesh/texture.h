/* What an OBJ file says beyond its surface: texture coordinates and materials. */
#ifndef SPRAYPLAN_MESH_TEXTURE_H
#define SPRAYPLAN_MESH_TEXTURE_H

#include <sprayplan/error.h>

#include <stddef.h>
#include <stdint.h>

typedef struct {
    size_t triangle_count; /* polygons as sp_polygon_cut has them, in the file's order */
    double (*uv)[3][2];    /* [triangle_count], NAN at a corner without */
    uint32_t *page;        /* [triangle_count], N of the last `usemtl page_N`, 0 before any */
    int *line;             /* [triangle_count], of the face */
} sp_texture;

/* Reads the text of a file that sp_obj_read reads without complaint, `size` bytes and a '\0' behind them. Fails for
 * materials that are not page_N. Needs the "C" locale. */
bool sp_texture_read(const char *path, const char *text, size_t size, sp_texture *texture, sp_error *error);
/* Accepts what was never read, if it is all zeros. */
void sp_texture_free(sp_texture *texture);

#endif
