/* In which order alternatives are placed. */
#include "cli.h"

#include <math.h>
#include <stdlib.h>

enum { AMOUNTS = 6 };

/* What an alternative allows: where one allows all that another does, none of its amounts is less. */
static void list_amounts(const sp_place_options *options, double amounts[AMOUNTS])
{
    double tightness = 0;
    for (size_t m = 0; m < options->mount_count; m++)
        tightness += options->mounts[m].most ? 1 / (double)options->mounts[m].most : 0;
    amounts[0] = (double)options->mount_count;
    amounts[1] = (double)options->type_count;
    amounts[2] = (double)options->pressure_count;
    amounts[3] = options->max_nozzles ? (double)options->max_nozzles : INFINITY;
    amounts[4] = options->max_water;
    amounts[5] = -tightness; /* of equally many mounts */
}

static bool allows_less(const sp_scene *scene, size_t one, size_t other)
{
    double a[AMOUNTS], b[AMOUNTS];
    sp_place_options first = sp_scene_alternative_options(scene, one),
                     second = sp_scene_alternative_options(scene, other);
    list_amounts(&first, a);
    list_amounts(&second, b);
    for (int i = 0; i < AMOUNTS; i++)
        if (a[i] != b[i])
            return a[i] < b[i];
    return false;
}

size_t *cli_order_alternatives(const sp_scene *scene)
{
    size_t count = sp_scene_alternative_count(scene);
    size_t *order = calloc(count + 1, sizeof *order);
    for (size_t i = 0; order && i < count; i++) {
        size_t at = i;
        for (; at > 0 && allows_less(scene, i, order[at - 1]); at--)
            order[at] = order[at - 1];
        order[at] = i;
    }
    return order;
}
