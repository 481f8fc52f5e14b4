/* The strict reader of what sprayplan-cad writes: nothing in it is trusted. */
#ifndef MESH_CAD_STREAM_H
#define MESH_CAD_STREAM_H

#include "mesh/cad/records.h"
#include "mesh/soup.h"

enum { SP_CAD_MOST_TRIANGLES = 1 << 25 };

typedef struct {
    const char *path; /* of the CAD file, for errors; borrowed */
    sp_soup *soup;    /* borrowed: what has arrived */
    double done;      /* 0 to 1 */
    sp_cad_fineness fineness;
    uint64_t faults;
    char fault[200];

    bool greeted, fine, ended;
    sp_cad_record record;
    size_t filled, room; /* of the record that is arriving, its head included */
    unsigned char *bytes;
    sp_cad_totals totals;
    char *name; /* of the part that is arriving; NULL before the first */
    double volume;
    uint32_t part; /* SP_NONE until it has a triangle */
    size_t first_vertex;
    double *volumes; /* [soup->part_count], m³, as in sp_part */
    size_t volume_room;
    uint32_t *copies; /* [soup->part_count], how often this name has come */
    size_t copy_room;
} sp_cad_stream;

sp_cad_stream sp_cad_stream_open(const char *path, sp_soup *soup);
/* The next bytes, however they are cut. False for what does not follow records.h, or for a failure that is reported. */
bool sp_cad_stream_take(sp_cad_stream *stream, const void *bytes, size_t size, sp_error *error);
void sp_cad_stream_clear(sp_cad_stream *stream);

/* part_name.c: the name of a part from `size` bytes, texts as in its record; "body" where they say nothing. NULL where
 * memory runs out; the caller frees. */
char *sp_cad_part_name(const char *texts, size_t size, sp_error *error);

#endif
