/* What sprayplan-cad writes into the pipe and the library reads from it: records of a kind, a size and so many bytes,
 * in this machine's byte order, one of greeting first. Lengths in m, angles in rad. */
#ifndef MESH_CAD_RECORDS_H
#define MESH_CAD_RECORDS_H

#include <stdint.h>

typedef struct {
    uint32_t kind, size; /* of what follows, at most SP_CAD_MOST_BYTES */
} sp_cad_record;

enum {
    SP_CAD_FORMAT = 1,
    SP_CAD_MOST_BYTES = 1 << 20,

    SP_CAD_GREETING = 1, /* uint32_t SP_CAD_FORMAT */
    SP_CAD_PROGRESS = 2, /* double, 0 to 1 */
    SP_CAD_FINENESS = 3, /* sp_cad_fineness; once, before any part */
    SP_CAD_FAULTS = 4,   /* uint64_t how many, then the first of them as text */
    SP_CAD_PART = 5,     /* double, m³, of a solid, 0 of anything else; then texts, each with a zero behind it, two for
                          * each level of the assembly from the top: the name of this copy, and of what it is one of */
    SP_CAD_VERTICES = 6, /* double [][3], of the last part */
    SP_CAD_TRIANGLES = 7, /* uint32_t [][3], of that part's vertices so far */
    SP_CAD_FAILURE = 8,   /* text: why there is no more; the last record */
    SP_CAD_END = 9,       /* sp_cad_totals; the last record */
};

typedef struct {
    double chord, angle; /* as used */
    double sewing;       /* m, the tolerance */
    uint64_t sewn;       /* faces that were in no solid */
} sp_cad_fineness;

typedef struct {
    uint64_t parts, vertices, triangles;
} sp_cad_totals;

#endif
