/* What the liquid can reach, as the wet sides have it: for whoever looks after the geometry. The upper row is cut open
 * at the middle, across the line of sight, the lower one is whole, so that a leak shows on the outside. */
#include "render.h"

#include <sprayplan/image.h>
#include <sprayplan/report.h>

#include <stdlib.h>
#include <string.h>

#define TILE 480 /* pixels */
#define GAP 16
#define ROWS 2

enum { LOOK_WET, LOOK_OBSTACLE, LOOK_DRY };
static const uint8_t colours[][3] = {{70, 140, 220}, {235, 160, 60}, {172, 178, 184}};

static uint32_t look_at_side(const void *user, uint32_t triangle, double u, double v, int back)
{
    const sp_evaluator *evaluator = user;
    const sp_setup *setup = sp_evaluator_setup(evaluator);
    if (!(sp_evaluator_wet_at(evaluator, triangle, u, v) >> back & 1))
        return LOOK_DRY;
    return setup->surfaces[setup->mesh->part[triangle]].clean ? LOOK_WET : LOOK_OBSTACLE;
}

static void colour_side(const void *user, uint32_t look, int stripe, uint8_t rgb[3])
{
    (void)user;
    (void)stripe;
    memcpy(rgb, colours[look], 3);
}

/* In the middle of its tile. */
static void place_tile(const uint8_t *tile, const sp_shot *shot, int column, int row, int width, uint8_t *picture)
{
    int left = GAP + column * (TILE + GAP) + (TILE - shot->width) / 2;
    int top = GAP + row * (TILE + GAP) + (TILE - shot->height) / 2;
    for (int y = 0; y < shot->height; y++)
        memcpy(picture + 3 * ((size_t)(top + y) * (size_t)width + (size_t)left),
               tile + 3 * (size_t)y * (size_t)shot->width, 3 * (size_t)shot->width);
}

static bool add_tile(const sp_evaluator *evaluator, int column, int row, int width, uint8_t *picture, sp_error *error)
{
    sp_camera camera = sp_camera_create(evaluator, NULL, &sp_viewpoints[column], TILE);
    sp_shot shot = {0};
    camera.cut = row == 0;
    uint8_t *tile = sp_shot_create(&shot, evaluator, &camera, false, look_at_side, evaluator, error)
                        ? sp_shot_picture(&shot, colour_side, NULL, error)
                        : NULL;
    if (tile)
        place_tile(tile, &shot, column, row, width, picture);
    free(tile);
    sp_shot_free(&shot);
    return tile != NULL;
}

bool sp_report_wet_png(const sp_evaluator *evaluator, const char *path, sp_error *error)
{
    if (!evaluator || !path)
        return false;
    enum { WIDTH = GAP + SP_VIEWPOINTS * (TILE + GAP), HEIGHT = GAP + ROWS * (TILE + GAP) };
    uint8_t *picture = malloc((size_t)3 * WIDTH * HEIGHT);
    if (!picture)
        return sp_fail_memory(error);
    memset(picture, 255, (size_t)3 * WIDTH * HEIGHT);
    bool done = true;
    for (int i = 0; done && i < ROWS * SP_VIEWPOINTS; i++)
        done = add_tile(evaluator, i % SP_VIEWPOINTS, i / SP_VIEWPOINTS, WIDTH, picture, error);
    done = done && sp_image_write_png(path, picture, WIDTH, HEIGHT, 3, error);
    free(picture);
    return done;
}
