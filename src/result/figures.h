/* What the files of this room share about figures. */
#ifndef RESULT_FIGURES_H
#define RESULT_FIGURES_H

#include <sprayplan/result.h>

/* Room for the counts given, every text NULL. False where memory ran out. */
bool sp_figures_make_rows(sp_figures *figures, size_t shadows, size_t nozzles);
/* The same for parts that are not wholly attainable. */
bool sp_figures_make_missing(sp_figures *figures, size_t count);
/* The same for parts that are to be cleaned. */
bool sp_figures_make_parts(sp_figures *figures, size_t count);
/* Everything but the name. False where memory ran out; what was copied is then still to be destroyed. */
bool sp_figures_copy(sp_figures *to, const sp_figures *from);

/* As sp_figures_read, of a text; `path` is for errors. */
sp_figures *sp_figures_parse(const char *path, const char *text, size_t size, size_t *count, sp_error *error);

#endif
