/* What is gathered of the flights to a chunk of patches, before it is known whether their way is free. */
#ifndef SPRAY_RAY_QUEUE_STATE_H
#define SPRAY_RAY_QUEUE_STATE_H

#include "aim.h"

/* What else is to be known of a ray where goods move. */
typedef struct {
    size_t position; /* theirs */
    uint32_t target; /* triangle, of the setup's mesh */
} sp_passing_ray;

/* Arrivals, and the rays along their ways, which are traced together when the chunk is gathered. */
typedef struct sp_ray_queue {
    size_t count, capacity;
    sp_arrival *arrivals; /* [capacity], as what follows */
    size_t ray_count;
    sp_ray *rays; /* of those whose way is not known yet */
    bool *blocked;
    sp_passing_ray *passing;
    bool *shaded;  /* [positions of the goods], while one way is looked along */
    size_t places; /* that flights were solved for */
    size_t ways;   /* that were looked along, with drag one by one */
    bool failed;   /* for want of memory */
} sp_ray_queue;

/* One patch while its flights are gathered. */
typedef struct {
    sp_source source; /* as the patch sees it from where the mesh has it */
    const sp_aim *aim;
    uint32_t patch;
    sp_ray_queue *queue;
    double share;    /* of the pass, that the goods' position stands for */
    double step;     /* m, that the goods move from one position to the next; 0: the patch does not */
    size_t position; /* theirs */
    sp_vec3 offset;  /* m, theirs */
} sp_gathering;

#endif
