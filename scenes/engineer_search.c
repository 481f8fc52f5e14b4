/* Is the engineer's layout as good as a careful engineer would draw it? Tries every choice of catalogue types at every
 * two and every three of a scene's ports, the axes along the ports, at every depth and pressure that the scene allows
 * (fans also turned about their axis), and says what the best of them cover for how much water, and what stands beside
 * the scene's own layout: more area with no more water, or as much with less. */
#include <sprayplan/sprayplan.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Combinations are compared on coarse texels; what they are compared with is judged by the same texels. */
static const double TEXEL = 0.03;
enum { ROLLS = 4, MOST_USED = 3, FRONT_BINS = 400, LANES = 8 };

/* One nozzle that might sit in one port, and what it does alone. */
typedef struct {
    size_t port;
    sp_nozzle nozzle;
    double flow;    /* m³/s */
    float *counted; /* [padded patches], m/s */
} option;

typedef struct {
    double area, flow;
    size_t options[MOST_USED];
    int used;
} choice;

typedef struct {
    const sp_evaluator *evaluator;
    const sp_setup *setup;
    size_t patch_count, padded_count; /* padded to a multiple of LANES with patches of no area */
    float *area;                      /* [padded] */
    option *options;
    size_t count, capacity;
    float *sums[MOST_USED];  /* [padded], of the first 0, 1, 2 options of a choice */
    choice best[FRONT_BINS]; /* by flow, of FLOW_STEP each */
    double tried;
} search;

static const double FLOW_STEP = 1.0 / 6e4; /* 1 L/min */

static void fail(const sp_error *error)
{
    char text[1400];
    sp_error_text(error, text, sizeof text);
    fprintf(stderr, "engineer_search: %s\n", text);
    exit(1);
}

static void *allocate(size_t count, size_t size)
{
    void *memory = calloc(count ? count : 1, size);
    if (!memory) {
        fprintf(stderr, "engineer_search: out of memory\n");
        exit(1);
    }
    return memory;
}

static bool fits(const sp_mount *port, const sp_nozzle_type *type)
{
    for (size_t i = 0; i < port->type_count; ++i)
        if (port->types[i] == type)
            return true;
    return port->type_count == 0;
}

/* Single nozzles need no criterion of their own: what counts of each adds up (combine: sum), patches at a spray's edge
 * counting whole or not at all. */
static void add_option(search *search, size_t port, const sp_nozzle *nozzle)
{
    sp_error error = {0};
    if (search->count == search->capacity) {
        search->capacity = search->capacity ? 2 * search->capacity : 256;
        search->options = realloc(search->options, search->capacity * sizeof *search->options);
        if (!search->options)
            fail(&(sp_error){.kind = SP_ERROR_MEMORY, .message = "out of memory"});
    }
    sp_layout *layout = sp_layout_create(nozzle, 1, &error);
    sp_coverage *alone = layout ? sp_evaluate_inverse(search->evaluator, layout, &error) : NULL;
    if (!alone)
        fail(&error);
    option *option = &search->options[search->count++];
    option->port = port;
    option->nozzle = *nozzle;
    option->flow = alone->flow;
    double threshold = sp_evaluator_setup(search->evaluator)->criterion.flux;
    option->counted = allocate(search->padded_count, sizeof *option->counted);
    for (size_t i = 0; i < search->patch_count; ++i)
        option->counted[i] = (float)(alone->deposits.covered[i] ? fmax(alone->deposits.even[i], threshold)
                                                                : alone->deposits.even[i]);
    sp_coverage_destroy(alone);
    sp_layout_destroy(layout);
}

static bool round_about_axis(const sp_nozzle_type *type)
{
    return type->pattern != SP_PATTERN_FLAT_FAN;
}

static void add_port(search *search, const sp_place_options *place, size_t number)
{
    const sp_mount *port = &place->mounts[number];
    size_t depths =
        port->depth_spacing > 0 ? (size_t)((port->depth_to - port->depth_from) / port->depth_spacing + 1.5) : 1;
    for (size_t t = 0; t < place->type_count; ++t)
        for (size_t d = 0; d < depths && fits(port, place->types[t]); ++d)
            for (size_t p = 0; p < place->pressure_count; ++p)
                for (int roll = 0; roll < (round_about_axis(place->types[t]) ? 1 : ROLLS); ++roll) {
                    double depth = port->depth_from + (double)d * port->depth_spacing;
                    sp_nozzle nozzle = {.type = place->types[t],
                                        .position = sp_along(port->position, depth, port->axis),
                                        .axis = port->axis,
                                        .roll = roll * M_PI / ROLLS,
                                        .pressure = place->pressures[p]};
                    snprintf(nozzle.name, sizeof nozzle.name, "%.55s", port->name);
                    add_option(search, number, &nozzle);
                }
}

/* Eight sums side by side, which the compiler can keep in vector registers. */
static double covered(const search *search, const float *sum, const float *extra, float threshold)
{
    float lanes[LANES] = {0};
    for (size_t i = 0; i < search->padded_count; i += LANES)
        for (size_t k = 0; k < LANES; ++k)
            lanes[k] += sum[i + k] + extra[i + k] >= threshold ? search->area[i + k] : 0.0f;
    double area = 0;
    for (size_t k = 0; k < LANES; ++k)
        area += lanes[k];
    return area;
}

static void keep_better(search *search, const choice *choice)
{
    size_t bin = (size_t)(choice->flow / FLOW_STEP);
    if (bin < FRONT_BINS && choice->area > search->best[bin].area)
        search->best[bin] = *choice;
}

static void extend(search *search, choice *choice)
{
    /* Without a flux criterion any liquid covers, and every float above 0 is more than this. */
    float threshold = search->setup->criterion.flux > 0 ? (float)search->setup->criterion.flux : 1e-30f;
    const float *sum = search->sums[choice->used];
    double flow = choice->flow;
    size_t first = choice->used ? choice->options[choice->used - 1] + 1 : 0;
    for (size_t i = first; i < search->count; ++i) {
        const option *option = &search->options[i];
        if (choice->used && option->port == search->options[choice->options[choice->used - 1]].port)
            continue;
        choice->options[choice->used++] = i;
        choice->flow = flow + option->flow;
        if (choice->used > 1) {
            choice->area = covered(search, sum, option->counted, threshold);
            search->tried += 1;
            keep_better(search, choice);
        }
        if (choice->used < MOST_USED) {
            for (size_t k = 0; k < search->patch_count; ++k)
                search->sums[choice->used][k] = sum[k] + option->counted[k];
            extend(search, choice);
        }
        --choice->used;
    }
}

static void print_choice(const search *search, const choice *choice, const sp_coverage *fine)
{
    printf("| %.1f | %.2f | %.1f %% |", 6e4 * choice->flow, fine->covered_area, 100 * fine->fraction);
    for (int i = 0; i < choice->used; ++i) {
        const sp_nozzle *nozzle = &search->options[choice->options[i]].nozzle;
        printf("%s %s at %s, z %.3f m, %.1f bar", i ? ";" : "", nozzle->type->name, nozzle->name, nozzle->position.z,
               nozzle->pressure / 1e5);
        if (!round_about_axis(nozzle->type))
            printf(", roll %.0f deg", nozzle->roll * 180 / M_PI);
    }
    printf(" |\n");
}

/* The choices of which none with less water covers as much, judged again on the scene's own texels. */
static void print_front(const search *search, const sp_evaluator *fine, const sp_coverage *manual)
{
    double most = 0, most_within = 0, least_water = INFINITY;
    printf("| L/min | covered m2 | coverage | nozzles |\n|---|---|---|---|\n");
    for (size_t bin = 0; bin < FRONT_BINS; ++bin) {
        const choice *choice = &search->best[bin];
        if (choice->area <= most)
            continue;
        most = choice->area;
        sp_error error = {0};
        sp_nozzle nozzles[MOST_USED];
        for (int i = 0; i < choice->used; ++i)
            nozzles[i] = search->options[choice->options[i]].nozzle;
        sp_layout *layout = sp_layout_create(nozzles, (size_t)choice->used, &error);
        sp_coverage *coverage = layout ? sp_evaluate_inverse(fine, layout, &error) : NULL;
        if (!coverage)
            fail(&error);
        print_choice(search, choice, coverage);
        if (coverage->flow <= manual->flow * (1 + 1e-9))
            most_within = fmax(most_within, coverage->covered_area);
        if (coverage->covered_area >= manual->covered_area)
            least_water = fmin(least_water, coverage->flow);
        sp_coverage_destroy(coverage);
        sp_layout_destroy(layout);
    }
    printf("\nThe scene's own layout: %.2f m2 (%.1f %%) with %.1f L/min.\n", manual->covered_area,
           100 * manual->fraction, 6e4 * manual->flow);
    printf("Best choice with no more water: %.2f m2, %+.1f %%.\n", most_within,
           100 * (most_within / manual->covered_area - 1));
    printf("Least water of a choice that covers as much: %.1f L/min, %+.1f %%.\n", 6e4 * least_water,
           100 * (least_water / manual->flow - 1));
}

static void prepare(search *search, const sp_evaluator *coarse)
{
    const sp_patches *patches = sp_evaluator_patches(coarse);
    search->evaluator = coarse;
    search->setup = sp_evaluator_setup(coarse);
    search->patch_count = patches->count;
    search->padded_count = (patches->count + LANES - 1) / LANES * LANES;
    search->area = allocate(search->padded_count, sizeof *search->area);
    for (size_t i = 0; i < patches->count; ++i)
        search->area[i] = (float)patches->area[i];
    for (int i = 0; i < MOST_USED; ++i)
        search->sums[i] = allocate(search->padded_count, sizeof *search->sums[i]);
}

static void finish(search *search)
{
    for (size_t i = 0; i < search->count; ++i)
        free(search->options[i].counted);
    for (int i = 0; i < MOST_USED; ++i)
        free(search->sums[i]);
    free(search->options);
    free(search->area);
}

int main(int argc, char **argv)
{
    if (argc != 2) {
        fprintf(stderr, "usage: engineer_search SCENE\n");
        return 2;
    }
    sp_error error = {0};
    sp_scene *scene = sp_scene_load(argv[1], &error);
    sp_evaluator *fine = sp_evaluator_create(sp_scene_setup(scene), &error);
    sp_evaluator *coarse = fine ? sp_evaluator_resample(fine, TEXEL, &error) : NULL;
    sp_coverage *manual = coarse ? sp_evaluate_inverse(fine, sp_scene_layout(scene), &error) : NULL;
    if (!manual)
        fail(&error);
    if (sp_scene_setup(scene)->criterion.combine != SP_COMBINE_SUM)
        fail(&(sp_error){.kind = SP_ERROR_UNSUPPORTED, .message = "only scenes with combine: sum"});
    sp_place_options place = sp_scene_place_options(scene);
    static search search;
    prepare(&search, coarse);
    for (size_t i = 0; i < place.mount_count; ++i)
        if (place.mounts[i].kind == SP_MOUNT_PORT)
            add_port(&search, &place, i);
    choice choice = {0};
    extend(&search, &choice);
    printf("%.0f choices of two or three nozzles, of %zu single ones.\n\n", search.tried, search.count);
    print_front(&search, fine, manual);
    finish(&search);
    sp_coverage_destroy(manual);
    sp_evaluator_destroy(coarse);
    sp_evaluator_destroy(fine);
    sp_scene_destroy(scene);
    return 0;
}
