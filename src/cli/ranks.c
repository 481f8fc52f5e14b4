/* The processes that mpirun started beside this one. */
#include "cli.h"

/* The program's own state, as what signals leave: errors are reported from everywhere. */
static sp_ranks *ranks;

bool cli_join(sp_error *error)
{
    return sp_ranks_join(cli_interrupted, &ranks, error);
}

sp_ranks *cli_ranks(void)
{
    return ranks;
}

void cli_leave(void)
{
    sp_ranks_leave(ranks);
    ranks = NULL;
}
