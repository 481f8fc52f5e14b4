/* Points and triangles with data as ParaView reads them: VTK's XML PolyData, version 1.0, its arrays appended as they
 * are in memory, little-endian, not compressed. */
#ifndef REPORT_VTP_H
#define REPORT_VTP_H

#include <sprayplan/mesh.h>

typedef enum { SP_VTP_UINT8, SP_VTP_INT32, SP_VTP_FLOAT32, SP_VTP_FLOAT64 } sp_vtp_type;

/* The component of item `index` of an array, which its type must be able to hold; `which` as the array says. */
typedef double sp_vtp_value(const void *of, int which, size_t index, int component);

typedef struct {
    const char *name; /* plain: it stands in the XML as it is */
    sp_vtp_type type;
    int components;
    sp_vtp_value *value;
    int which;
} sp_vtp_array;

typedef struct {
    size_t point_count;
    sp_vtp_value *point; /* coordinates, m */
    size_t triangle_count;
    const uint32_t (*triangles)[3]; /* corners, as points; NULL: every point is a cell of its own */
    size_t array_count;
    const sp_vtp_array *arrays; /* one item a triangle, or a point where there are no triangles */
    const sp_mesh *mesh;        /* the names of its parts become the field array "part_names" */
    const void *of;             /* what all values are asked of */
} sp_vtp;

bool sp_vtp_write(const sp_vtp *vtp, const char *path, sp_error *error);

#endif
