/* Numbers in files have a decimal point whatever language the program speaks: the C locale for this thread, for a
 * while. */
#ifndef SCENE_LOCALE_H
#define SCENE_LOCALE_H

#include <sprayplan/error.h>

#include <locale.h>

typedef struct {
    locale_t ours, theirs;
} sp_locale;

bool sp_locale_enter(sp_locale *change, sp_error *error);
void sp_locale_leave(const sp_locale *change);

#endif
