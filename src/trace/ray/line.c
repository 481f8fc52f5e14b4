#include "trace/ray/line.h"
#include "trace/ray/barycentric.h"

bool sp_line_start(sp_line *line, const sp_ray *ray)
{
    sp_to_array(ray->origin, line->origin);
    sp_to_array(ray->velocity, line->velocity);
    line->z = 0;
    for (int axis = 1; axis < 3; axis++)
        if (fabs(line->velocity[axis]) > fabs(line->velocity[line->z]))
            line->z = axis;
    line->x = (line->z + 1) % 3;
    line->y = (line->z + 2) % 3;
    double along = line->velocity[line->z];
    line->shear_x = line->velocity[line->x] / along;
    line->shear_y = line->velocity[line->y] / along;
    line->inverse_z = 1 / along;
    return along != 0 && isfinite(line->shear_x + line->shear_y + line->inverse_z);
}

/* The triangle is sheared so that the line becomes the z axis. */
void sp_line_test(const sp_line *line, const sp_corners corners, uint32_t triangle, sp_ray_search *search)
{
    double x[3], y[3], z[3], weights[3];
    for (int i = 0; i < 3; i++) {
        z[i] = corners[i][line->z] - line->origin[line->z];
        x[i] = corners[i][line->x] - line->origin[line->x] - line->shear_x * z[i];
        y[i] = corners[i][line->y] - line->origin[line->y] - line->shear_y * z[i];
    }
    if (!sp_barycentric(x, y, weights))
        return;
    double sum = weights[0] + weights[1] + weights[2];
    double t = (weights[0] * z[0] + weights[1] * z[1] + weights[2] * z[2]) / sum * line->inverse_z;
    if (triangle != search->skip && sp_ray_search_wants(search, t, triangle))
        sp_ray_search_take(search, t, weights[1] / sum, weights[2] / sum, triangle);
}

void sp_line_search_all(const sp_line *line, const sp_corners *corners, size_t count, sp_ray_search *search)
{
    for (size_t t = 0; t < count && !sp_ray_search_done(search); t++)
        sp_line_test(line, corners[t], (uint32_t)t, search);
}

/* A line on its way through a tree. Where the line is at the time of a hit, it is less than 2^-40 of the distance of
 * the farthest corner away from the triangle: the corners' rounding is 2^-52 of that distance, and the sliver's test
 * keeps the weights' from exceeding it by more than 2^8 and a small factor. */
typedef struct {
    const sp_line *line;
    double margin;     /* m */
    double inverse[3]; /* 1 / velocity */
    double slack[3];   /* s, the time that the margin takes */
    bool rising[3];    /* velocity > 0 */
    bool still[3];     /* moves less than the margin along this axis */
} walk;

static bool enter(walk *w, const sp_kd_tree *tree, double *from, double *to)
{
    const sp_line *line = w->line;
    double farthest = 0;
    for (int axis = 0; axis < 3; axis++)
        farthest = sp_greater(farthest, sp_greater(fabs(tree->low[axis] - line->origin[axis]),
                                                   fabs(tree->high[axis] - line->origin[axis])));
    w->margin = SP_LINE_MARGIN * farthest;
    for (int axis = 0; axis < 3; axis++) {
        double low = tree->low[axis] - w->margin - line->origin[axis];
        double high = tree->high[axis] + w->margin - line->origin[axis];
        double speed = line->velocity[axis];
        w->rising[axis] = speed > 0;
        w->inverse[axis] = 1 / speed;
        w->slack[axis] = w->margin * fabs(w->inverse[axis]);
        if (speed == 0 && (low > 0 || high < 0))
            return false;
        if (speed != 0) {
            *from = sp_greater(*from, (speed > 0 ? low : high) / speed);
            *to = sp_lesser(*to, (speed > 0 ? high : low) / speed);
        }
    }
    for (int axis = 0; axis < 3; axis++)
        w->still[axis] = fabs(line->velocity[axis]) * sp_greater(fabs(*from), fabs(*to)) <= w->margin;
    return *from <= *to;
}

static inline double ahead(const walk *w, int axis, double split, double time)
{
    (void)time; /* of which a coordinate that is still does not tell */
    return split - w->line->origin[axis];
}

static inline void pass_plane(const walk *w, int axis, double split, double from, double to, double *arrival,
                              double *departure)
{
    (void)from;
    (void)to;
    double crossing = (split - w->line->origin[axis]) * w->inverse[axis];
    *arrival = crossing - w->slack[axis];
    *departure = crossing + w->slack[axis];
}

static inline void test(const walk *w, const sp_corners corners, uint32_t triangle, sp_ray_search *search)
{
    sp_line_test(w->line, corners, triangle, search);
}

#include "trace/ray/kd_walk.h"

void sp_line_search_tree(const sp_line *line, const sp_corners *corners, const sp_kd_tree *tree, sp_ray_search *search)
{
    walk w = {.line = line};
    double from = search->t_min, to = search->limit;
    if (enter(&w, tree, &from, &to))
        search_leaves(&w, corners, tree, from, to, search);
}
