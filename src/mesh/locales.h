/* newlocale() and uselocale(), which POSIX has in <locale.h> and macOS in a header of its own. */
#ifndef MESH_LOCALES_H
#define MESH_LOCALES_H

#include <locale.h>
#if __has_include(<xlocale.h>)
#include <xlocale.h>
#endif

#endif
