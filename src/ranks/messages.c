#include "ranks/messages.h"

#include "mesh/grow.h"

#include <stdlib.h>
#include <string.h>

void sp_pack(sp_outgoing *outgoing, const void *bytes, size_t size)
{
    outgoing->lacks_memory =
        outgoing->lacks_memory || !sp_grow(&outgoing->bytes, &outgoing->capacity, outgoing->count + size, 1);
    if (outgoing->lacks_memory || !size)
        return;
    memcpy(outgoing->bytes + outgoing->count, bytes, size);
    outgoing->count += size;
}

void sp_outgoing_free(sp_outgoing *outgoing)
{
    free(outgoing->bytes);
    *outgoing = (sp_outgoing){0};
}

void sp_gathered_free(sp_gathered *gathered)
{
    free(gathered->at);
    free(gathered->bytes);
    *gathered = (sp_gathered){0};
}

bool sp_unpack(sp_gathered *gathered, size_t rank, void *bytes, size_t size)
{
    if (rank >= gathered->count || size > gathered->end[rank] - gathered->at[rank])
        return false;
    memcpy(bytes, gathered->bytes + gathered->at[rank], size);
    gathered->at[rank] += size;
    return true;
}
