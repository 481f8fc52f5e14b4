#include "placement.h"
#include "scoring/prepare.h"

#include <stdio.h>
#include <stdlib.h>

void fail(const sp_error *error)
{
    char text[1400];
    sp_error_text(error, text, sizeof text);
    fprintf(stderr, "%s\n", text);
    exit(1);
}

void placement_open(const char *scene, placement *p)
{
    sp_error error = {0};
    sp_partial first;
    *p = (placement){.scene = sp_scene_load(scene, &error)};
    p->fine = p->scene ? sp_evaluator_create(sp_scene_setup(p->scene), &error) : NULL;
    if (!p->fine)
        fail(&error);
    p->options = sp_scene_place_options(p->scene);
    p->options.run.threads = 1;
    p->deadline = sp_deadline_start(&p->options.run);
    if (!sp_sites_create(p->fine, &p->options, &p->sites, &error) ||
        !sp_candidates_create(p->fine, &p->options, &p->sites, &p->candidates, &error) ||
        !sp_visibility_fit(p->fine, &p->options, &p->sites, &p->candidates, &p->deadline, &p->coarse, &p->visibility,
                           &error) ||
        !sp_search_create(p->coarse ? p->coarse : p->fine, &p->options, &p->sites, &p->candidates, &p->visibility,
                          &p->search, &error))
        fail(&error);
    p->front.fine = p->fine;
    p->front.objective = p->options.objective;
    p->front.target = p->options.coverage * sp_evaluator_patches(p->fine)->total_area;
    if (!sp_find_first(&p->search, 1, &p->deadline, &p->front, &p->pool, &first, &error) ||
        !sp_find_more(&p->search, &p->deadline, &p->front, &p->pool, &first, &error))
        fail(&error);
    sp_partial_free(&first);
}

void placement_close(placement *p)
{
    sp_front_free(&p->front);
    sp_pool_free(&p->pool);
    sp_search_free(&p->search);
    sp_visibility_free(&p->visibility);
    sp_evaluator_destroy(p->coarse);
    sp_candidates_free(&p->candidates);
    sp_sites_free(&p->sites);
    free(p->deadline.stages);
    sp_evaluator_destroy(p->fine);
    sp_scene_destroy(p->scene);
}
