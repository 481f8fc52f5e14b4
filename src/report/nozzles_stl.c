/* Bodies of the nozzles, to be loaded beside the vessel: binary STL in the coordinates of the vessel's own file. */
#include "nozzle_body.h"

#include "mesh/file.h"
#include "result/growing_text.h"

#include <sprayplan/report.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define HEADER 80

static void put(sp_text *bytes, uint32_t value, size_t size)
{
    char little[4];
    for (size_t k = 0; k < size; ++k)
        little[k] = (char)(value >> (8 * k) & 0xff);
    sp_text_append(bytes, little, size);
}

static void put_vector(sp_text *bytes, sp_vec3 v)
{
    const float values[3] = {(float)v.x, (float)v.y, (float)v.z};
    for (int k = 0; k < 3; ++k) {
        uint32_t bits;
        memcpy(&bits, &values[k], sizeof bits);
        put(bytes, bits, 4);
    }
}

/* A point of the setup in the first geometry file's coordinates; its rotation is undone by its transpose. */
static sp_vec3 in_file(const sp_setup *setup, sp_vec3 point)
{
    const sp_transform *t = &setup->file;
    sp_vec3 p = sp_sub(sp_setup_outside(setup, point), t->translate);
    const double(*r)[3] = t->rotate;
    return sp_scale(sp_v(r[0][0] * p.x + r[1][0] * p.y + r[2][0] * p.z, r[0][1] * p.x + r[1][1] * p.y + r[2][1] * p.z,
                         r[0][2] * p.x + r[1][2] * p.y + r[2][2] * p.z),
                    1 / t->scale);
}

static void put_nozzle(sp_text *bytes, const sp_setup *setup, const sp_nozzle_body *body, const sp_nozzle *nozzle)
{
    sp_frame frame = sp_nozzle_frame(nozzle->axis, nozzle->roll, setup->up);
    for (int t = 0; t < SP_BODY_TRIANGLES; ++t) {
        sp_vec3 corners[3];
        for (int k = 0; k < 3; ++k) {
            sp_vec3 p = body->vertices[body->corners[t][k]];
            p = sp_along(sp_along(sp_along(nozzle->position, p.x, frame.x), p.y, frame.y), p.z, frame.z);
            corners[k] = in_file(setup, p);
        }
        put_vector(bytes, sp_unit(sp_cross(sp_sub(corners[1], corners[0]), sp_sub(corners[2], corners[0]))));
        for (int k = 0; k < 3; ++k)
            put_vector(bytes, corners[k]);
        put(bytes, 0, 2);
    }
}

bool sp_report_nozzles_stl(const sp_design *design, const char *path, sp_error *error)
{
    if (!design || !design->evaluator || !design->layout || !path)
        return false;
    const sp_setup *setup = sp_evaluator_setup(design->evaluator);
    sp_nozzle_body body = sp_nozzle_body_create(setup);
    sp_text bytes = {0};
    /* Text that begins with "solid" would be taken for an STL file of text. */
    char header[HEADER + 1] = {0};
    snprintf(header, sizeof header, "sprayplan nozzles, in the first geometry file's coordinates: 1 is %.6g m",
             setup->file.scale);
    sp_text_append(&bytes, header, HEADER);
    put(&bytes, (uint32_t)(design->layout->count * SP_BODY_TRIANGLES), 4);
    for (size_t i = 0; i < design->layout->count; ++i)
        put_nozzle(&bytes, setup, &body, &design->layout->nozzles[i]);
    bool done = bytes.failed ? sp_fail_memory(error) != NULL : sp_write_file(path, bytes.text, bytes.length, error);
    free(bytes.text);
    return done;
}
