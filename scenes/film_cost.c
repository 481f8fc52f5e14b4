/* What film costs, in seconds of one core: building its linear map on the cells of a scene, cut to a texel (m), and
 * running it. Each as many times as the third argument says, or ten times. */
#include "film/film.h"
#include "film/laminar.h"
#include "spray/state/state.h"

#include <sprayplan/sprayplan.h>

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static double spent(void)
{
    struct timespec time;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static int by_size(const void *left, const void *right)
{
    double a = *(const double *)left, b = *(const double *)right;
    return (a > b) - (a < b);
}

/* Seconds, as many times as asked for. */
static bool measure(const sp_film_surface *surface, size_t times, double *build, double *run, sp_error *error)
{
    double *per_width = calloc(surface->cells->count + 1, sizeof *per_width);
    bool done = per_width || sp_fail_memory(error);
    for (size_t i = 0; done && i < times; i++) {
        double start = spent();
        sp_film *film = sp_film_create(surface, error);
        build[i] = spent() - start;
        start = spent();
        done = film && sp_film_run(film, surface->cells->area, per_width, NULL, error);
        run[i] = spent() - start;
        sp_film_destroy(film);
    }
    free(per_width);
    return done;
}

static void print(const char *what, double *seconds, size_t times, size_t cells)
{
    qsort(seconds, times, sizeof *seconds, by_size);
    double scale = 1e9 / (double)cells;
    printf("%s: median %.1f ns a cell, from %.1f to %.1f\n", what, scale * seconds[times / 2], scale * seconds[0],
           scale * seconds[times - 1]);
}

/* Rain on every cell of all wet sides. */
static bool cost(const sp_scene *scene, double texel, size_t times, sp_error *error)
{
    sp_setup setup = *sp_scene_setup(scene);
    setup.criterion.film = 1e-4;
    setup.fidelity.texel = texel;
    sp_evaluator *evaluator = sp_evaluator_create(&setup, error);
    sp_evaluator *walls = evaluator ? sp_evaluator_resample(evaluator, texel, error) : NULL;
    double *build = malloc((times + 1) * sizeof *build), *run = malloc((times + 1) * sizeof *run);
    bool done = walls && ((build && run) || sp_fail_memory(error));
    if (done) {
        const sp_film_surface surface = {.mesh = setup.mesh,
                                         .atlas = walls->atlas,
                                         .tracer = walls->tracer,
                                         .cells = &walls->patches,
                                         .cell_of = (const uint32_t(*)[2])walls->texel_patch,
                                         .down = sp_scale(sp_unit(setup.up), -1),
                                         .wave = sp_film_wave(&setup.liquid, setup.gravity)};
        done = measure(&surface, times, build, run, error);
    }
    if (done) {
        printf("%zu triangles, %zu cells, %zu times\n", setup.mesh->triangle_count, walls->patches.count, times);
        print("build", build, times, walls->patches.count);
        print("run", run, times, walls->patches.count);
    }
    free(build);
    free(run);
    sp_evaluator_destroy(walls);
    sp_evaluator_destroy(evaluator);
    return done;
}

int main(int count, char **arguments)
{
    double texel = count > 2 ? strtod(arguments[2], NULL) : 0;
    long times = count > 3 ? strtol(arguments[3], NULL, 10) : 10;
    if (count < 3 || count > 4 || !(texel > 0) || times < 1 || times > 1000000) {
        fprintf(stderr, "usage: film_cost SCENE TEXEL [TIMES]\n");
        return 2;
    }
    sp_error error = {0};
    sp_scene *scene = sp_scene_load(arguments[1], &error);
    bool done = scene && cost(scene, texel, (size_t)times, &error);
    if (!done)
        fprintf(stderr, "%s\n", error.message);
    sp_scene_destroy(scene);
    return done ? 0 : 1;
}
