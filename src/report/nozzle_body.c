#include "nozzle_body.h"

#include <string.h>

#define LENGTH 0.02  /* of the diagonal */
#define RADIUS 0.005 /* of the diagonal */
#define CONE 0.5     /* of the length */

enum { TIP = 2 * SP_BODY_SIDES, BASE };

static void add(sp_nozzle_body *body, int *count, int a, int b, int c)
{
    const uint32_t corners[3] = {(uint32_t)a, (uint32_t)b, (uint32_t)c};
    memcpy(body->corners[(*count)++], corners, sizeof corners);
}

/* Vertices: the rim of the base, that of the cone, the tip, the middle of the base. */
sp_nozzle_body sp_nozzle_body_create(const sp_setup *setup)
{
    sp_nozzle_body body;
    sp_vec3 low, high;
    double diagonal = sp_mesh_box(setup->mesh, &low, &high), length = LENGTH * diagonal;
    int count = 0;
    body.vertices[TIP] = sp_v(0, 0, 0);
    body.vertices[BASE] = sp_v(0, 0, -length);
    for (int i = 0; i < SP_BODY_SIDES; ++i) {
        int next = (i + 1) % SP_BODY_SIDES, cone = SP_BODY_SIDES + i, cone_next = SP_BODY_SIDES + next;
        double turn = 2 * M_PI * i / SP_BODY_SIDES;
        double x = RADIUS * diagonal * cos(turn), y = RADIUS * diagonal * sin(turn);
        body.vertices[i] = sp_v(x, y, -length);
        body.vertices[cone] = sp_v(x, y, -CONE * length);
        add(&body, &count, BASE, next, i);
        add(&body, &count, i, next, cone_next);
        add(&body, &count, i, cone_next, cone);
        add(&body, &count, cone, cone_next, TIP);
    }
    return body;
}
