/* The catalogue of a page. */
#include "live/numbers.h"
#include "live/state.h"

#include <stdlib.h>

/* Members are of types that have none. */
static bool make_members(sp_live *live, size_t type, size_t first, size_t member_count)
{
    const double *rows = live->arrays[SP_LIVE_MEMBERS];
    sp_nozzle_type *own = &live->types[type];
    if (first > member_count || own->member_count > member_count - first)
        return false;
    own->members = &live->members[first];
    for (size_t i = first; i < first + own->member_count; i++) {
        const double *row = &rows[i * SP_LIVE_MEMBER_NUMBERS];
        if (!(row[0] >= 0 && row[0] < (double)live->type_count) || live->types[(size_t)row[0]].member_count)
            return false;
        live->members[i] = sp_live_read_member(row);
        live->members[i].type = live->types[(size_t)row[0]];
    }
    return true;
}

bool sp_live_make_types(sp_live *live)
{
    const double *rows = live->arrays[SP_LIVE_TYPES];
    size_t count = live->bytes[SP_LIVE_TYPES] / (SP_LIVE_TYPE_NUMBERS * sizeof(double));
    size_t member_count = live->bytes[SP_LIVE_MEMBERS] / (SP_LIVE_MEMBER_NUMBERS * sizeof(double));
    sp_live_free_types(live);
    live->types = calloc(count + 1, sizeof *live->types);
    live->members = calloc(member_count + 1, sizeof *live->members);
    size_t *first = calloc(count + 1, sizeof *first);
    bool room = live->types && live->members && first, good = room;
    live->type_count = count;
    for (size_t i = 0; good && i < count; i++)
        good = sp_live_read_type(&rows[i * SP_LIVE_TYPE_NUMBERS], &live->types[i], &first[i]);
    for (size_t i = 0; good && i < count; i++)
        good = !live->types[i].member_count || make_members(live, i, first[i], member_count);
    free(first);
    if (!room)
        sp_fail_memory(&live->error);
    return good || sp_fail(&live->error, SP_ERROR_ARGUMENT, NULL, 0, 0, "a nozzle type that cannot be");
}

void sp_live_free_types(sp_live *live)
{
    free(live->types);
    free(live->members);
    live->types = NULL;
    live->members = NULL;
    live->type_count = 0;
}
