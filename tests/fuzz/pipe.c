/* What comes through the pipe from sprayplan-cad. */
#include "mesh.h"
#include "mesh/cad/mend.h"
#include "mesh/cad/stream.h"

bool target_accepted;

/* In pieces, whose length is as odd as the input's. */
static bool take(sp_cad_stream *stream, const uint8_t *data, size_t size, sp_error *error)
{
    size_t piece = 1 + size % 61;
    for (size_t at = 0; at < size; at += piece)
        if (!sp_cad_stream_take(stream, data + at, size - at < piece ? size - at : piece, error))
            return false;
    return true;
}

static void require_sound_stream(const sp_cad_stream *stream)
{
    const sp_cad_fineness *fineness = &stream->fineness;
    REQUIRE(isfinite(fineness->chord) && fineness->chord > 0 && isfinite(fineness->angle) && fineness->angle > 0);
    REQUIRE(isfinite(fineness->sewing) && fineness->sewing >= 0 && stream->done >= 0 && stream->done <= 1);
    require_utf8(stream->fault);
    for (size_t i = 0; i < stream->soup->part_count; i++)
        REQUIRE(isfinite(stream->volumes[i]));
}

/* Splitting triangles at corners that lie on their edges leaves the surface as it is. */
static void require_mended(sp_soup *soup)
{
    sp_error error = {0};
    size_t mended = 0, triangles = soup->triangle_count;
    double extent = 0;
    for (size_t i = 0; i < soup->vertex_count; i++)
        extent = fmax(extent, sp_length(soup->vertices[i]));
    sp_mesh *mesh = weld_soup(soup);
    double before = sp_mesh_area(mesh);
    mesh = sp_cad_mend(mesh, &mended, &error);
    REQUIRE(mesh && error.kind == SP_OK);
    require_sound_mesh(mesh);
    double round_off = 1e-12 * extent * extent * (double)(1 + triangles);
    REQUIRE(mended > 0 || mesh->source_triangle_count == triangles);
    REQUIRE(fabs(sp_mesh_area(mesh) - before) <= round_off);
    sp_mesh_destroy(mesh);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    sp_error error = {0};
    sp_soup soup = {0};
    meter_start();
    sp_cad_stream stream = sp_cad_stream_open("strange", &soup);
    bool taken = take(&stream, data, size, &error);
    REQUIRE(taken == (error.kind == SP_OK));
    target_accepted = taken && stream.ended;
    require_sound_soup(&soup);
    if (target_accepted) {
        require_sound_stream(&stream);
        if (soup.triangle_count)
            require_mended(&soup);
    } else if (!taken) {
        require_located(&error, "strange", data, size);
    }
    require_frugal(size);
    sp_cad_stream_clear(&stream);
    sp_soup_clear(&soup);
    return 0;
}
