/* What is each way of refinement worth by itself? Looks for the best that candidates give at every amount of water and
 * refines eight of these layouts on the search's own patches: annealing by Ceres from the widest start and from a
 * narrow one, compass search, and both. Says for each which share of what the layout leaves dry is covered then, and
 * the processor time that it took. One thread. */
#include "placement.h"
#include "refine/continuation.h"
#include "refine/compass.h"

#include <stdio.h>
#include <time.h>

#define PARTIALS 8
#define NARROW 3 /* the width at which an annealing starts that keeps what is there */
#define SIGHTS 24
#define STEP_FIRST 0.25 /* of the compass, as refinement has it */
#define STEP_LEAST 0.006

typedef struct {
    const char *name;
    size_t start; /* of an annealing; SP_WIDTHS: none */
    bool compass;
    double closed, seconds; /* sums */
} way;

static double processor_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* What the layout covers after it was refined, m²; *seconds: how long that took. */
static double refine(placement *p, const sp_partial *from, const way *how, double *seconds)
{
    sp_error error = {0};
    sp_sights sights;
    sp_partial partial;
    double water = sp_partial_water(&p->search, from, from->outlay), start = processor_seconds();
    if (!sp_sights_create(&p->search, SIGHTS, false, &sights, &error) ||
        !sp_partial_copy(&p->search, from, &partial, &error) ||
        (how->start < SP_WIDTHS &&
         !sp_continuation(&sights, how->start, SP_WIDTHS, water, &p->deadline, &partial, &error)) ||
        (how->compass && !sp_compass(&sights, STEP_FIRST, STEP_LEAST, water, &p->deadline, &partial, &error)))
        fail(&error);
    *seconds = processor_seconds() - start;
    double covered = partial.covered;
    sp_partial_free(&partial);
    sp_sights_free(&sights);
    return covered;
}

int main(int argc, char **argv)
{
    if (argc != 2) {
        fprintf(stderr, "usage: refinement_ways SCENE\n");
        return 2;
    }
    placement p;
    placement_open(argv[1], &p);
    way ways[] = {{.name = "Ceres", .start = 0},
                  {.name = "Ceres, narrow", .start = NARROW},
                  {.name = "compass", .start = SP_WIDTHS, .compass = true},
                  {.name = "Ceres, compass", .start = 0, .compass = true},
                  {.name = "Ceres, narrow, compass", .start = NARROW, .compass = true}};
    const size_t way_count = sizeof ways / sizeof *ways, partials = p.front.by_water.count;
    size_t tried = 0;
    printf("| water, L/min | nozzles |");
    for (size_t w = 0; w < way_count; w++)
        printf(" %s, %% |", ways[w].name);
    printf("\n|---|---|---|---|---|---|---|\n");
    for (size_t i = 0; i<partials; i += partials> PARTIALS ? partials / PARTIALS : 1) {
        const sp_partial *from = &p.front.by_water.entries[i].partial;
        double dry = p.search.view_area - from->covered;
        if (!from->count || dry <= 0)
            continue;
        tried++;
        printf("| %.1f | %zu |", 6e4 * from->outlay, from->count);
        for (size_t w = 0; w < way_count; w++) {
            double seconds, closed = (refine(&p, from, &ways[w], &seconds) - from->covered) / dry;
            ways[w].closed += closed;
            ways[w].seconds += seconds;
            printf(" %.1f |", 100 * closed);
        }
        printf("\n");
    }
    printf("| mean | |");
    for (size_t w = 0; w < way_count; w++)
        printf(" %.1f in %.2f s |", 100 * ways[w].closed / (double)tried, ways[w].seconds / (double)tried);
    printf("\n");
    placement_close(&p);
    return 0;
}
