/* Patternations: the image as a function on the sphere, its integrals, and directions drawn from it. */
#include "patternation.h"

#include "caps.h"

#include <assert.h>
#include <stdlib.h>

#define NARROWEST 1e-6 /* rad */

bool sp_patternation_check(const float *values, size_t columns, size_t rows, double angle, sp_error *error)
{
    bool any = false;
    if (columns < 1 || columns > SP_PATTERNATION_COLUMNS || rows < 1 || rows > SP_PATTERNATION_ROWS)
        return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0, "%zu x %zu values found, expected 1 x 1 to %d x %d", columns,
                       rows, SP_PATTERNATION_COLUMNS, SP_PATTERNATION_ROWS);
    if (!(angle >= NARROWEST && angle <= 2 * M_PI))
        return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0, "an angle of %g rad found, expected %g to 2 pi", angle,
                       NARROWEST);
    if (!values)
        return sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0, "no values found, expected %zu x %zu", columns, rows);
    for (size_t i = 0; i < rows * columns; i++) {
        if (!(values[i] >= 0 && values[i] < INFINITY))
            return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                           "%g found in column %zu of row %zu, expected finite values of 0 or more", (double)values[i],
                           i % columns + 1, i / columns + 1);
        any = any || values[i] > 0;
    }
    return any || sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0, "no value above 0 found, expected some liquid");
}

static bool allocate(sp_patternation *own, size_t columns, size_t rows)
{
    own->columns = columns;
    own->rows = rows;
    own->height = malloc(rows * sizeof *own->height);
    own->node = malloc(rows * columns * sizeof *own->node);
    own->along = malloc(rows * (columns + 1) * sizeof *own->along);
    own->within = malloc(rows * sizeof *own->within);
    own->least = malloc(rows * sizeof *own->least);
    own->most = malloc(rows * sizeof *own->most);
    return own->height && own->node && own->along && own->within && own->least && own->most;
}

static void set_nodes(sp_patternation *own, const float *values, double angle)
{
    size_t columns = own->columns, rows = own->rows;
    double mean = 0, step = 0.5 * angle / (double)(rows - 2);
    for (size_t j = 0; j < rows; j++) {
        double polar = j == 0 ? 0 : j + 1 == rows ? 0.5 * angle : ((double)j - 0.5) * step;
        own->height[j] = sp_cap_height(0, polar);
        size_t row = j == 0 ? 0 : j + 1 == rows ? rows - 3 : j - 1;
        for (size_t i = 0; i < columns; i++)
            own->node[j * columns + i] = (double)values[row * columns + i];
    }
    for (size_t i = 0; i < columns; i++)
        mean += own->node[i] / (double)columns;
    for (size_t i = 0; i < columns; i++)
        own->node[i] = mean;
}

/* All there is, in the image's own measure. */
static double integrate(const sp_patternation *own)
{
    double all = 0;
    for (size_t j = 0; j + 1 < own->rows; j++) {
        double sum = 0;
        for (size_t i = 0; i < 2 * own->columns; i++) /* of both rows */
            sum += own->node[j * own->columns + i];
        all += (own->height[j + 1] - own->height[j]) * 0.5 * sum * 2 * M_PI / (double)own->columns;
    }
    return all;
}

static void sum_up(sp_patternation *own)
{
    size_t columns = own->columns;
    double width = 2 * M_PI / (double)columns;
    for (size_t j = 0; j < own->rows; j++) {
        const double *node = &own->node[j * columns];
        double *along = &own->along[j * (columns + 1)], before = j ? along[-1] : 0;
        own->least[j] = own->most[j] = node[0];
        along[0] = 0;
        for (size_t i = 0; i < columns; i++) {
            along[i + 1] = along[i] + 0.5 * width * (node[i] + node[(i + 1) % columns]);
            own->least[j] = fmin(own->least[j], node[i]);
            own->most[j] = fmax(own->most[j], node[i]);
        }
        own->densest = fmax(own->densest, own->most[j]);
        own->within[j] =
            j ? own->within[j - 1] + 0.5 * (own->height[j] - own->height[j - 1]) * (before + along[columns]) : 0;
    }
}

static double polar_of(double height)
{
    return 2 * asin(sqrt(fmin(1, 0.5 * height)));
}

static void find_ends(sp_patternation *own)
{
    size_t first = 0, last = own->rows - 1;
    while (!(own->most[first + 1] > 0)) /* a row of nodes sprays as far as to the rows beside it */
        first++;
    while (!(own->most[last - 1] > 0))
        last--;
    own->low = first > 0 ? polar_of(own->height[first]) : 0;
    own->high = polar_of(own->height[last]);
}

sp_patternation *sp_patternation_create(const float *values, size_t columns, size_t rows, double angle, sp_error *error)
{
    if (!sp_patternation_check(values, columns, rows, angle, error))
        return NULL;
    sp_patternation *own = calloc(1, sizeof *own);
    if (!own || !allocate(own, columns, rows + 2)) {
        sp_patternation_destroy(own);
        return sp_fail_memory(error);
    }
    set_nodes(own, values, angle);
    own->liquid = integrate(own);
    assert(own->liquid > 0);
    for (size_t i = 0; i < own->rows * columns; i++)
        own->node[i] /= own->liquid;
    sum_up(own);
    assert(fabs(own->within[own->rows - 1] - 1) < 1e-9); /* all leaves within the last row */
    find_ends(own);
    if (sp_pattern_maps_create(own))
        return own;
    sp_patternation_destroy(own);
    return sp_fail_memory(error);
}

void sp_patternation_destroy(sp_patternation *own)
{
    if (!own)
        return;
    sp_pattern_maps_free(own);
    free(own->height);
    free(own->node);
    free(own->along);
    free(own->within);
    free(own->least);
    free(own->most);
    free(own);
}

/* The last of `count` rising numbers that is no more than x, but not the very last. */
static size_t place_of(const double *numbers, size_t count, double x)
{
    size_t low = 0, high = count - 1;
    while (high - low > 1) {
        size_t middle = (low + high) / 2;
        *(numbers[middle] <= x ? &low : &high) = middle;
    }
    return low;
}

static double between(double a, double b, double t)
{
    return a + t * (b - a);
}

double sp_patternation_at(const sp_patternation *own, sp_vec3 direction)
{
    sp_vec3 from_axis = sp_sub(direction, sp_v(0, 0, 1));
    double height = 0.5 * sp_dot(from_axis, from_axis), edge = own->height[own->rows - 1];
    if (height > edge && edge < 2)
        return 0;
    size_t j = place_of(own->height, own->rows, height), columns = own->columns;
    double t = fmin(1, (height - own->height[j]) / (own->height[j + 1] - own->height[j]));
    double turns = atan2(direction.y, direction.x) / (2 * M_PI), column = (turns - floor(turns)) * (double)columns;
    double from_node = column < 0.5 ? column - 0.5 + (double)columns : column - 0.5; /* on from the first node */
    size_t i = (size_t)fmin(from_node, (double)columns - 1), next = (i + 1) % columns;
    const double *near = &own->node[j * columns], *far = near + columns;
    double s = fmin(1, from_node - (double)i);
    return between(between(near[i], near[next], s), between(far[i], far[next], s), t);
}

/* How far into a stretch of `width`, over which something goes evenly from a to b, its integral is `amount`. */
static double reach_amount(double a, double b, double width, double amount)
{
    double root = a + sqrt(fmax(0, a * a + 2 * amount * (b - a) / width));
    return root > 0 ? fmin(width, 2 * amount / root) : 0;
}

/* The azimuth, from the first node, before which the share w of what leaves between two rows of nodes does. */
static double azimuth_of(const sp_patternation *own, size_t j, double t, double w)
{
    size_t columns = own->columns, low = 0, high = columns;
    const double *near = &own->along[j * (columns + 1)], *far = near + columns + 1;
    double amount = w * between(near[columns], far[columns], t), width = 2 * M_PI / (double)columns;
    while (high - low > 1) {
        size_t middle = (low + high) / 2;
        *(between(near[middle], far[middle], t) <= amount ? &low : &high) = middle;
    }
    const double *nodes = &own->node[j * columns];
    size_t next = (low + 1) % columns;
    double a = between(nodes[low], nodes[columns + low], t), b = between(nodes[next], nodes[columns + next], t);
    return width * (double)low + reach_amount(a, b, width, amount - between(near[low], far[low], t));
}

sp_vec3 sp_patternation_direction(const sp_patternation *own, double u, double w)
{
    size_t j = place_of(own->within, own->rows, u), columns = own->columns;
    double step = own->height[j + 1] - own->height[j];
    double near = own->along[j * (columns + 1) + columns], far = own->along[(j + 1) * (columns + 1) + columns];
    double up = reach_amount(near, far, step, u - own->within[j]), height = own->height[j] + up;
    double azimuth = azimuth_of(own, j, up / step, w) + M_PI / (double)columns, level = sqrt(height * (2 - height));
    return sp_v(level * cos(azimuth), level * sin(azimuth), 1 - height);
}

void sp_patternation_densities(const sp_patternation *own, double from, double to, double *least, double *most)
{
    const double *height = own->height;
    double low = sp_cap_height(0, from), high = sp_cap_height(0, to), edge = height[own->rows - 1],
           ends[2] = {low, high};
    *least = low > edge || high > edge ? 0 : INFINITY;
    *most = 0;
    for (int k = 0; k < 2 && ends[k] <= edge; k++) {
        size_t j = place_of(height, own->rows, ends[k]);
        double t = fmin(1, (ends[k] - height[j]) / (height[j + 1] - height[j]));
        *least = fmin(*least, between(own->least[j], own->least[j + 1], t));
        *most = fmax(*most, between(own->most[j], own->most[j + 1], t));
    }
    for (size_t j = 0; j < own->rows; j++)
        if (height[j] >= low && height[j] <= high) {
            *least = fmin(*least, own->least[j]);
            *most = fmax(*most, own->most[j]);
        }
    for (int k = 0; k < 2 && own->maps[k].half; k++) { /* what means may be besides */
        *least *= fmin(1, own->maps[k].scale);
        *most = fmin(own->densest, *most * fmax(1, own->maps[k].scale));
    }
}
