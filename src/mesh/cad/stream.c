#include "mesh/cad/stream.h"

#include "mesh/grow.h"
#include "mesh/utf8.h"

#include <stdio.h>

sp_cad_stream sp_cad_stream_open(const char *path, sp_soup *soup)
{
    return (sp_cad_stream){.path = path, .soup = soup, .part = SP_NONE};
}

void sp_cad_stream_clear(sp_cad_stream *stream)
{
    free(stream->bytes);
    free(stream->name);
    free(stream->volumes);
    free(stream->copies);
    *stream = (sp_cad_stream){0};
}

static bool broken(const sp_cad_stream *stream, const char *found, sp_error *error)
{
    return sp_fail(error, SP_ERROR_INPUT, stream->path, 0, 0, "found %s in what sprayplan-cad made of it", found);
}

/* Text of a record, as UTF-8 without control characters, cut to what fits. */
static void copy_text(char *to, size_t room, const unsigned char *bytes, size_t size)
{
    size_t length = sp_utf8_append(to, (const char *)bytes, size < (room - 1) / 2 ? size : (room - 1) / 2);
    to[length] = '\0';
    for (char *at = to; *at; at++)
        if ((unsigned char)*at < ' ' || *at == 127)
            *at = ' ';
}

static bool take_greeting(sp_cad_stream *stream, const unsigned char *bytes, size_t size, sp_error *error)
{
    uint32_t format;
    memcpy(&format, bytes, size);
    if (format != SP_CAD_FORMAT)
        return broken(stream, "another version's records", error);
    stream->greeted = true;
    return true;
}

static bool take_progress(sp_cad_stream *stream, const unsigned char *bytes, size_t size, sp_error *error)
{
    double done;
    memcpy(&done, bytes, size);
    if (!(done >= 0 && done <= 1.01))
        return broken(stream, "progress beyond 0 to 1", error);
    stream->done = done < 1 ? done : 1;
    return true;
}

static bool take_fineness(sp_cad_stream *stream, const unsigned char *bytes, size_t size, sp_error *error)
{
    sp_cad_fineness *fineness = &stream->fineness;
    memcpy(fineness, bytes, size);
    if (stream->fine)
        return broken(stream, "its fineness twice", error);
    stream->fine = true;
    return (fineness->chord > 0 && isfinite(fineness->chord) && fineness->angle > 0 && isfinite(fineness->angle) &&
            fineness->sewing >= 0 && isfinite(fineness->sewing) && fineness->sewn <= UINT32_MAX) ||
           broken(stream, "a chord, angle or tolerance that is none", error);
}

static bool take_faults(sp_cad_stream *stream, const unsigned char *bytes, size_t size, sp_error *error)
{
    if (stream->faults)
        return broken(stream, "its faults twice", error);
    memcpy(&stream->faults, bytes, sizeof stream->faults);
    copy_text(stream->fault, sizeof stream->fault, bytes + sizeof stream->faults, size - sizeof stream->faults);
    return (stream->faults > 0 && stream->faults <= UINT32_MAX) || broken(stream, "no number of faults", error);
}

static bool take_part(sp_cad_stream *stream, const unsigned char *bytes, size_t size, sp_error *error)
{
    memcpy(&stream->volume, bytes, sizeof stream->volume);
    if (!stream->fine || !isfinite(stream->volume))
        return broken(stream, stream->fine ? "a part's volume that is no number" : "a part before its fineness", error);
    free(stream->name);
    stream->name = sp_cad_part_name((const char *)bytes + sizeof stream->volume, size - sizeof stream->volume, error);
    stream->part = SP_NONE;
    stream->first_vertex = stream->soup->vertex_count;
    stream->totals.parts++;
    return stream->name != NULL;
}

static bool take_vertices(sp_cad_stream *stream, const unsigned char *bytes, size_t size, sp_error *error)
{
    size_t count = size / (3 * sizeof(double));
    if (!stream->name)
        return broken(stream, "vertices of no part", error);
    if (stream->soup->vertex_count + count > 3 * (size_t)SP_CAD_MOST_TRIANGLES)
        return sp_fail(error, SP_ERROR_INPUT, stream->path, 0, 0,
                       "found more than %zu vertices, expected a longer chord", 3 * (size_t)SP_CAD_MOST_TRIANGLES);
    stream->totals.vertices += count;
    for (size_t i = 0; i < count; i++, bytes += 3 * sizeof(double)) {
        double at[3];
        memcpy(at, bytes, sizeof at);
        if (!sp_coordinates_allowed(sp_v(at[0], at[1], at[2])))
            return broken(stream, "a coordinate that is not finite or beyond 1e30 m", error);
        if (!sp_soup_add_vertex(stream->soup, sp_v(at[0], at[1], at[2]), error))
            return false;
    }
    return true;
}

/* The part that is arriving becomes one of the soup, under a name that no other has. */
static bool open_part(sp_cad_stream *stream, sp_error *error)
{
    sp_soup *soup = stream->soup;
    size_t before = soup->part_count, length = strlen(stream->name);
    uint32_t first = sp_soup_part(soup, stream->name, error);
    stream->part = first;
    if (first != SP_NONE && soup->part_count == before) {
        char *name = malloc(length + 16);
        while (name && stream->part != SP_NONE && soup->part_count == before) {
            snprintf(name, length + 16, "%s#%lu", stream->name, (unsigned long)++stream->copies[first]);
            stream->part = sp_soup_part(soup, name, error);
        }
        if (!name)
            return sp_fail_memory(error);
        free(name);
    }
    if (stream->part == SP_NONE)
        return false;
    if (!sp_grow(&stream->volumes, &stream->volume_room, soup->part_count, sizeof *stream->volumes) ||
        !sp_grow(&stream->copies, &stream->copy_room, soup->part_count, sizeof *stream->copies))
        return sp_fail_memory(error);
    stream->volumes[stream->part] = stream->volume;
    stream->copies[stream->part] = 1;
    return true;
}

static bool take_triangles(sp_cad_stream *stream, const unsigned char *bytes, size_t size, sp_error *error)
{
    uint32_t corners[3];
    if (!stream->name)
        return broken(stream, "triangles of no part", error);
    if (stream->soup->triangle_count + size / sizeof corners > SP_CAD_MOST_TRIANGLES)
        return sp_fail(error, SP_ERROR_INPUT, stream->path, 0, 0,
                       "found more than %d triangles, expected a longer chord", SP_CAD_MOST_TRIANGLES);
    if (stream->part == SP_NONE && !open_part(stream, error))
        return false;
    stream->totals.triangles += size / sizeof corners;
    size_t count = stream->soup->vertex_count - stream->first_vertex;
    uint32_t first = (uint32_t)stream->first_vertex;
    for (const unsigned char *end = bytes + size; bytes < end; bytes += sizeof corners) {
        memcpy(corners, bytes, sizeof corners);
        if (corners[0] >= count || corners[1] >= count || corners[2] >= count)
            return broken(stream, "a corner that no vertex has", error);
        if (!sp_soup_add_triangle(stream->soup, first + corners[0], first + corners[1], first + corners[2],
                                  stream->part, error))
            return false;
    }
    return true;
}

static bool take_failure(sp_cad_stream *stream, const unsigned char *bytes, size_t size, sp_error *error)
{
    char text[400];
    copy_text(text, sizeof text, bytes, size);
    return sp_fail(error, SP_ERROR_INPUT, stream->path, 0, 0, "OpenCASCADE cannot read it: %s", text);
}

static bool take_end(sp_cad_stream *stream, const unsigned char *bytes, size_t size, sp_error *error)
{
    const sp_cad_totals *totals = &stream->totals;
    sp_cad_totals sent;
    memcpy(&sent, bytes, size);
    stream->ended = true;
    return (stream->fine && sent.parts == totals->parts && sent.vertices == totals->vertices &&
            sent.triangles == totals->triangles) ||
           broken(stream, "other totals than what came", error);
}

typedef bool take_function(sp_cad_stream *stream, const unsigned char *bytes, size_t size, sp_error *error);

/* By kind: how many bytes at least, and how many more at a time. */
static const struct {
    size_t least, step;
    take_function *take;
} rules[] = {
    [SP_CAD_GREETING] = {sizeof(uint32_t), 0, take_greeting},
    [SP_CAD_PROGRESS] = {sizeof(double), 0, take_progress},
    [SP_CAD_FINENESS] = {sizeof(sp_cad_fineness), 0, take_fineness},
    [SP_CAD_FAULTS] = {sizeof(uint64_t), 1, take_faults},
    [SP_CAD_PART] = {sizeof(double), 1, take_part},
    [SP_CAD_VERTICES] = {3 * sizeof(double), 3 * sizeof(double), take_vertices},
    [SP_CAD_TRIANGLES] = {3 * sizeof(uint32_t), 3 * sizeof(uint32_t), take_triangles},
    [SP_CAD_FAILURE] = {0, 1, take_failure},
    [SP_CAD_END] = {sizeof(sp_cad_totals), 0, take_end},
};

static bool check_head(const sp_cad_stream *stream, sp_error *error)
{
    uint32_t kind = stream->record.kind;
    size_t size = stream->record.size;
    if (kind >= sizeof rules / sizeof *rules || !rules[kind].take || stream->greeted == (kind == SP_CAD_GREETING))
        return broken(stream, "a record of no kind that is expected there", error);
    size_t more = size - rules[kind].least, step = rules[kind].step;
    return (size <= SP_CAD_MOST_BYTES && size >= rules[kind].least && (step ? more % step == 0 : more == 0)) ||
           broken(stream, "a record of another size than its kind has", error);
}

bool sp_cad_stream_take(sp_cad_stream *stream, const void *bytes, size_t size, sp_error *error)
{
    const size_t head = sizeof stream->record;
    for (const unsigned char *at = bytes, *end = at + size; at < end;) {
        if (stream->ended)
            return broken(stream, "more behind the last record", error);
        size_t needed = stream->filled < head ? head : head + stream->record.size;
        size_t some = needed - stream->filled < (size_t)(end - at) ? needed - stream->filled : (size_t)(end - at);
        if (!sp_grow(&stream->bytes, &stream->room, stream->filled + some, 1))
            return sp_fail_memory(error);
        memcpy(stream->bytes + stream->filled, at, some);
        stream->filled += some;
        at += some;
        if (stream->filled == head && needed == head) {
            memcpy(&stream->record, stream->bytes, head);
            if (!check_head(stream, error))
                return false;
        }
        if (stream->filled >= head && stream->filled == head + stream->record.size) {
            stream->filled = 0;
            if (!rules[stream->record.kind].take(stream, stream->bytes + head, stream->record.size, error))
                return false;
        }
    }
    return true;
}
