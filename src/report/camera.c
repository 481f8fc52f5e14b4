#include "camera.h"

#define REACH 0.3 /* tangent of half the opening angle: about 33 degrees in all, little distortion */
#define MARGIN 1.04
#define MARGIN_OF_NOZZLES 1.12 /* their names stand beside them */
#define RAD (M_PI / 180)

/* From behind one looks up, so that the lid's underside shows; nozzles often leave it dry. */
const sp_viewpoint sp_viewpoints[SP_VIEWPOINTS] = {
    {"From the front", 0, 10 * RAD},
    {"From behind, looking up", 150 * RAD, -28 * RAD},
    {"From above, into the bottom", 0, 72 * RAD},
};

static bool is_shown(const sp_evaluator *evaluator, const sp_result *result, uint32_t triangle)
{
    const sp_setup *setup = sp_evaluator_setup(evaluator);
    return !result ||
           (sp_evaluator_wet(evaluator, triangle) != 0 && setup->surfaces[setup->mesh->part[triangle]].clean);
}

static void shown_box(const sp_evaluator *evaluator, const sp_result *result, sp_vec3 *low, sp_vec3 *high)
{
    const sp_mesh *mesh = sp_evaluator_setup(evaluator)->mesh;
    *low = sp_v(INFINITY, INFINITY, INFINITY);
    *high = sp_v(-INFINITY, -INFINITY, -INFINITY);
    for (uint32_t t = 0; t < mesh->triangle_count; ++t)
        for (int k = 0; k < 3 && is_shown(evaluator, result, t); ++k) {
            sp_vec3 p = mesh->vertices[mesh->triangles[t][k]];
            *low = sp_v(fmin(low->x, p.x), fmin(low->y, p.y), fmin(low->z, p.z));
            *high = sp_v(fmax(high->x, p.x), fmax(high->y, p.y), fmax(high->z, p.z));
        }
    if (low->x > high->x)
        *low = *high = sp_v(0, 0, 0);
}

/* Most lines of sight from the middle meet something. Directions by the golden spiral. */
static bool encloses(const sp_evaluator *evaluator, sp_vec3 middle)
{
    enum { LINES = 200 };
    int hits = 0;
    for (int i = 0; i < LINES; ++i) {
        double z = 1 - (2 * i + 1.0) / LINES, turn = i * M_PI * (3 - sqrt(5));
        sp_ray ray = {middle, sp_v(sqrt(1 - z * z) * cos(turn), sqrt(1 - z * z) * sin(turn), z), 0, INFINITY, SP_NONE};
        hits += sp_trace_occluded(sp_evaluator_tracer(evaluator), &ray, sp_v(0, 0, 0));
    }
    return hits > 0.6 * LINES;
}

static void set_axes(sp_camera *camera, const sp_viewpoint *viewpoint, sp_vec3 up)
{
    sp_vec3 right = sp_v(1, 0, 0), front = sp_cross(right, up);
    sp_vec3 level = sp_add(sp_scale(front, cos(viewpoint->azimuth)), sp_scale(right, sin(viewpoint->azimuth)));
    sp_vec3 towards_eye = sp_add(sp_scale(level, cos(viewpoint->elevation)), sp_scale(up, sin(viewpoint->elevation)));
    camera->forward = sp_scale(towards_eye, -1);
    camera->right = sp_unit(sp_cross(camera->forward, up));
    camera->up = sp_cross(camera->right, camera->forward);
}

/* What the picture has to show: first how far back the eye goes until all of it is inside REACH, then how wide it
 * looks. */
typedef struct {
    const sp_camera *camera;
    bool placed;            /* the distance is known */
    double distance;        /* m, of the eye from the camera's centre */
    double low[2], high[2]; /* to the right and upwards, where the forward component is 1 */
} frame;

static void take_in(frame *f, sp_vec3 point, double margin)
{
    sp_vec3 p = sp_sub(point, f->camera->centre);
    const double at[2] = {margin * sp_dot(p, f->camera->right), margin * sp_dot(p, f->camera->up)};
    double depth = sp_dot(p, f->camera->forward);
    for (int k = 0; k < 2; ++k) {
        if (!f->placed) {
            f->distance = fmax(f->distance, fabs(at[k]) / REACH - depth);
            continue;
        }
        f->low[k] = fmin(f->low[k], at[k] / (f->distance + depth));
        f->high[k] = fmax(f->high[k], at[k] / (f->distance + depth));
    }
}

/* Where a machine is washed from outside, its nozzles stand around it; one that is lost far away is not gone after. */
static void take_in_nozzles(frame *f, const sp_layout *layout)
{
    for (size_t i = 0; i < layout->count; ++i)
        if (sp_distance(layout->nozzles[i].position, f->camera->centre) <= f->camera->size)
            take_in(f, layout->nozzles[i].position, MARGIN_OF_NOZZLES);
}

/* The picture is trimmed to what it shows, on the scale of one about `centre` whose longer side is `pixels`. */
static void trim(sp_camera *camera, const frame *f, int pixels)
{
    bool any = f->low[0] <= f->high[0];
    double half[2] = {1e-6, 1e-6}, middle[2] = {0, 0}, widest = 1e-6;
    for (int k = 0; any && k < 2; ++k) {
        half[k] = fmax(0.5 * (f->high[k] - f->low[k]), 1e-6);
        middle[k] = 0.5 * (f->low[k] + f->high[k]);
        widest = fmax(widest, fmax(-f->low[k], f->high[k]));
    }
    camera->reach_x = fmax(half[0], 0.5 * half[1]);
    camera->reach_y = fmax(half[1], 0.5 * half[0]);
    camera->shift_x = middle[0];
    camera->shift_y = middle[1];
    camera->width = (int)ceil(pixels * camera->reach_x / widest);
    camera->height = (int)ceil(pixels * camera->reach_y / widest);
}

static void frame_all(sp_camera *camera, const sp_evaluator *evaluator, const sp_result *result, int pixels)
{
    const sp_mesh *mesh = sp_evaluator_setup(evaluator)->mesh;
    frame f = {camera, false, camera->size * 1e-3, {INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    for (int pass = 0; pass < 2; ++pass) {
        for (uint32_t t = 0; t < mesh->triangle_count; ++t)
            for (int k = 0; k < 3 && is_shown(evaluator, result, t); ++k)
                take_in(&f, mesh->vertices[mesh->triangles[t][k]], MARGIN);
        for (size_t i = 0; result && i < result->design_count; ++i)
            if (result->designs[i].evaluator == evaluator)
                take_in_nozzles(&f, result->designs[i].layout);
        f.placed = true;
    }
    trim(camera, &f, pixels);
    camera->distance = f.distance;
    camera->eye = sp_along(camera->centre, -f.distance, camera->forward);
}

sp_camera sp_camera_create(const sp_evaluator *evaluator, const sp_result *result, const sp_viewpoint *viewpoint,
                           int pixels)
{
    sp_camera camera = {0};
    const sp_setup *setup = sp_evaluator_setup(evaluator);
    sp_vec3 low, high;
    shown_box(evaluator, result, &low, &high);
    camera.centre = sp_scale(sp_add(low, high), 0.5);
    camera.size = sp_distance(low, high);
    if (!(camera.size > 0))
        camera.size = 1;
    camera.cut = setup->cavity == SP_CAVITY_NONE && encloses(evaluator, camera.centre);
    set_axes(&camera, viewpoint, setup->up);
    frame_all(&camera, evaluator, result, pixels);
    return camera;
}

sp_vec3 sp_camera_direction(const sp_camera *camera, double x, double y)
{
    double right = camera->shift_x + (2 * x / camera->width - 1) * camera->reach_x;
    double up = camera->shift_y + (1 - 2 * y / camera->height) * camera->reach_y;
    return sp_along(sp_along(camera->forward, right, camera->right), up, camera->up);
}

bool sp_camera_project(const sp_camera *camera, sp_vec3 point, double xy[2])
{
    sp_vec3 p = sp_sub(point, camera->eye);
    double depth = sp_dot(p, camera->forward);
    if (depth < 1e-6 * camera->size)
        return false;
    xy[0] = 0.5 * camera->width * (1 + (sp_dot(p, camera->right) / depth - camera->shift_x) / camera->reach_x);
    xy[1] = 0.5 * camera->height * (1 - (sp_dot(p, camera->up) / depth - camera->shift_y) / camera->reach_y);
    return true;
}

bool sp_camera_shows(const sp_camera *camera, sp_vec3 point, double xy[2])
{
    return sp_camera_project(camera, point, xy) && xy[0] >= 0 && xy[0] <= camera->width && xy[1] >= 0 &&
           xy[1] <= camera->height;
}
