/* What the shared library exports: it is built with all else hidden. */
#ifndef SPRAYPLAN_EXPORT_H
#define SPRAYPLAN_EXPORT_H

#ifdef __GNUC__
#define SP_API __attribute__((visibility("default")))
#else
#define SP_API
#endif

#endif
