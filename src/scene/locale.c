#include "scene/locale.h"

bool sp_locale_enter(sp_locale *change, sp_error *error)
{
    change->ours = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    change->theirs = (locale_t)0;
    if (change->ours == (locale_t)0) {
        sp_fail_memory(error);
        return false;
    }
    change->theirs = uselocale(change->ours);
    return true;
}

void sp_locale_leave(const sp_locale *change)
{
    uselocale(change->theirs);
    freelocale(change->ours);
}
