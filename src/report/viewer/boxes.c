#include "boxes.h"

#include "trace/ray/visit.h"

#include <stdlib.h>

#define MOST 30000
#define FULL 65535.0

static uint16_t in_parts(double value, double low, double high, bool up)
{
    double parts = high > low ? FULL * (value - low) / (high - low) : 0;
    return (uint16_t)fmin(fmax(up ? ceil(parts) : floor(parts), 0), FULL);
}

static void pack(const double (*boxes)[6], size_t count, const double low[3], const double high[3], uint16_t *shorts,
                 sp_packed *packed)
{
    for (int k = 0; k < 6; ++k) {
        for (size_t i = 0; i < count; ++i)
            shorts[i] = in_parts(boxes[i][k], low[k % 3], high[k % 3], k > 2);
        sp_packed_shorts(packed, shorts, count, true);
    }
}

bool sp_viewer_boxes(const sp_evaluator *evaluator, json_t *object, sp_packed *packed, sp_error *error)
{
    const sp_tracer *tracer = sp_evaluator_tracer(evaluator);
    size_t count = sp_tracer_leaves(tracer, NULL);
    if (count == 0 || count > MOST)
        return true;
    double(*boxes)[6] = malloc(count * sizeof *boxes);
    uint16_t *shorts = malloc(count * sizeof *shorts);
    sp_vec3 from, to;
    sp_mesh_box(sp_evaluator_setup(evaluator)->mesh, &from, &to);
    const double low[3] = {from.x, from.y, from.z}, high[3] = {to.x, to.y, to.z};
    bool done = boxes && shorts;
    if (done) {
        sp_tracer_leaves(tracer, boxes);
        pack((const double(*)[6])boxes, count, low, high, shorts, packed);
        json_t *about = json_pack("{s:I, s:[fff], s:[fff]}", "count", (json_int_t)count, "low", low[0], low[1], low[2],
                                  "high", high[0], high[1], high[2]);
        done = json_object_set_new(object, "leaves", about) == 0;
    }
    free(boxes);
    free(shorts);
    return done || sp_fail_memory(error);
}
