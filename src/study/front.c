/* What is worth its cost, and how fast errors fall. */
#include <sprayplan/study.h>

#include <math.h>

double sp_study_slope(const double *x, const double *y, size_t count)
{
    double n = 0, sum_x = 0, sum_y = 0, sum_xx = 0, sum_xy = 0;
    for (size_t i = 0; i < count; i++) {
        if (!(x[i] > 0) || !(y[i] > 0) || isinf(x[i]) || isinf(y[i]))
            continue;
        double u = log(x[i]), v = log(y[i]);
        n += 1;
        sum_x += u;
        sum_y += v;
        sum_xx += u * u;
        sum_xy += u * v;
    }
    double spread = n * sum_xx - sum_x * sum_x;
    return n >= 3 && spread > 1e-12 * n * sum_xx ? (n * sum_xy - sum_x * sum_y) / spread : NAN;
}

static bool beaten(const double *cost, const double *loss, size_t by, size_t i)
{
    return cost[by] <= cost[i] && loss[by] <= loss[i] && (cost[by] < cost[i] || loss[by] < loss[i]);
}

void sp_study_front(const double *cost, const double *loss, size_t count, bool *on)
{
    for (size_t i = 0; i < count; i++) {
        on[i] = !isnan(cost[i]) && !isnan(loss[i]);
        for (size_t k = 0; on[i] && k < count; k++)
            on[i] = !beaten(cost, loss, k, i);
    }
}
