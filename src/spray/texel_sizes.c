#include "texel_sizes.h"

#include <stdlib.h>

#define AROUND 8 /* texels around a thin part */
/* Thin parts may double the number of texels; where there are few, there may be so many. */
#define MOST_TIMES 2
#define FEW_TEXELS 50000
#define HALVINGS 40
#define DRY_SHARE 0.25 /* of these texels, for all that is not cleaned: nothing is recorded there */

typedef struct {
    double area, counted, low[2], high[2];
} chart_size;

static double span(const chart_size *c)
{
    return fmax(c->high[0] - c->low[0], c->high[1] - c->low[1]);
}

static void measure(const sp_evaluator *evaluator, const sp_charts *charts, chart_size *sizes)
{
    for (size_t c = 0; c < charts->chart_count; c++)
        sizes[c] = (chart_size){.low = {INFINITY, INFINITY}, .high = {-INFINITY, -INFINITY}};
    for (uint32_t t = 0; t < charts->triangle_count; t++) {
        chart_size *size = &sizes[charts->chart[t]];
        size->area += sp_triangle_area(evaluator->setup.mesh, t);
        size->counted += sp_counted_area(evaluator, t);
        for (int i = 0; i < 3; i++)
            for (int k = 0; k < 2; k++) {
                size->low[k] = fmin(size->low[k], charts->flat[t][i][k]);
                size->high[k] = fmax(size->high[k], charts->flat[t][i][k]);
            }
    }
}

/* How many texels charts with anything to be cleaned have if none is shorter than `times` what it wants. */
static double count_texels(const chart_size *sizes, const double *wanted, size_t count, double texel, double times)
{
    double texels = 0;
    for (size_t c = 0; c < count; c++) {
        double length = fmin(texel, times * wanted[c]);
        texels += sizes[c].counted > 0 ? sizes[c].area / (length * length) : 0;
    }
    return texels;
}

/* By how much all that want shorter texels must be content with longer ones. */
static double find_times(const chart_size *sizes, const double *wanted, size_t count, double texel)
{
    double most = fmax(MOST_TIMES * count_texels(sizes, wanted, count, texel, INFINITY), FEW_TEXELS);
    double low = 1, high = 1;
    if (count_texels(sizes, wanted, count, texel, 1) <= most)
        return 1;
    for (size_t c = 0; c < count; c++)
        high = fmax(high, texel / wanted[c]);
    for (int i = 0; i < HALVINGS; i++) {
        double middle = sqrt(low * high);
        bool few = count_texels(sizes, wanted, count, texel, middle) <= most;
        *(few ? &high : &low) = middle;
    }
    return high;
}

/* The length on charts where nothing is to be cleaned. */
static double dry_length(const chart_size *sizes, size_t count, double texel, double texels)
{
    double dry = 0;
    for (size_t c = 0; c < count; c++)
        dry += sizes[c].counted > 0 ? 0 : sizes[c].area;
    return fmax(texel, sqrt(dry / fmax(DRY_SHARE * texels, FEW_TEXELS)));
}

typedef struct {
    double length, counted;
} chart_length;

static int by_length(const void *left, const void *right)
{
    const chart_length *a = left, *b = right;
    if (a->length != b->length)
        return a->length < b->length ? -1 : 1;
    return (a->counted > b->counted) - (a->counted < b->counted);
}

/* The length that charts with no more than a share `spare` of what is to be cleaned may fall short of. */
static double spare_length(chart_length *lengths, size_t count, double spare)
{
    double counted = 0, shorter = 0;
    for (size_t c = 0; c < count; c++)
        counted += lengths[c].counted;
    qsort(lengths, count, sizeof *lengths, by_length);
    for (size_t c = 0; c < count; c++) {
        shorter += lengths[c].counted;
        if (shorter > spare * counted)
            return lengths[c].length;
    }
    return 0;
}

/* From girths to lengths of texels. `lengths` is room for the charts. */
static void choose(const chart_size *sizes, chart_length *lengths, size_t count, const sp_texel_limits *limits,
                   sp_texel_sizes *texel_sizes)
{
    double *length = texel_sizes->texel, texel = limits->texel;
    for (size_t c = 0; c < count; c++) {
        length[c] = fmin(texel, fmax(fmax(length[c] / AROUND, limits->least), span(&sizes[c]) / limits->page));
        lengths[c] = (chart_length){length[c], sizes[c].counted};
    }
    double spare = spare_length(lengths, count, limits->spare), times = find_times(sizes, length, count, texel);
    double dry = dry_length(sizes, count, texel, count_texels(sizes, length, count, texel, INFINITY));
    for (size_t c = 0; c < count; c++)
        length[c] = sizes[c].counted > 0 ? fmin(texel, times * fmax(length[c], spare))
                                         : fmax(dry, span(&sizes[c]) / limits->page);
}

/* What follows from the lengths. */
static void conclude(const chart_size *sizes, size_t count, sp_texel_sizes *texel_sizes)
{
    texel_sizes->finest = INFINITY;
    for (size_t c = 0; c < count; c++) {
        double length = texel_sizes->texel[c];
        texel_sizes->finest = sizes[c].counted > 0 ? fmin(texel_sizes->finest, length) : texel_sizes->finest;
        texel_sizes->texels += sizes[c].area / (length * length);
        texel_sizes->longest = fmax(texel_sizes->longest, span(&sizes[c]) / length);
    }
}

bool sp_texel_sizes_create(const sp_evaluator *evaluator, const sp_charts *charts, const sp_texel_limits *limits,
                           sp_texel_sizes *texel_sizes, sp_error *error)
{
    *texel_sizes = (sp_texel_sizes){.texel = sp_charts_girth(charts, evaluator->setup.mesh, error)};
    if (!texel_sizes->texel)
        return false;
    chart_size *sizes = malloc((charts->chart_count + 1) * sizeof *sizes);
    chart_length *lengths = malloc((charts->chart_count + 1) * sizeof *lengths);
    bool done = sizes && lengths;
    if (done) {
        measure(evaluator, charts, sizes);
        choose(sizes, lengths, charts->chart_count, limits, texel_sizes);
        conclude(sizes, charts->chart_count, texel_sizes);
    }
    free(sizes);
    free(lengths);
    if (done)
        return true;
    sp_texel_sizes_free(texel_sizes);
    return sp_fail_memory(error);
}

bool sp_texel_sizes_like(const sp_evaluator *evaluator, const sp_charts *charts, const sp_evaluator *fine,
                         sp_texel_sizes *texel_sizes, sp_error *error)
{
    size_t count = charts->chart_count;
    *texel_sizes = (sp_texel_sizes){.texel = malloc((count + 1) * sizeof *texel_sizes->texel)};
    chart_size *sizes = malloc((count + 1) * sizeof *sizes);
    bool done = texel_sizes->texel && sizes;
    for (size_t c = 0; done && c < count; c++)
        texel_sizes->texel[c] = fine->atlas->chart_texel[c] / fine->fidelity.texel * evaluator->fidelity.texel;
    if (done) {
        measure(evaluator, charts, sizes);
        conclude(sizes, count, texel_sizes);
    }
    free(sizes);
    if (done)
        return true;
    sp_texel_sizes_free(texel_sizes);
    return sp_fail_memory(error);
}

void sp_texel_sizes_free(sp_texel_sizes *texel_sizes)
{
    free(texel_sizes->texel);
    *texel_sizes = (sp_texel_sizes){0};
}
