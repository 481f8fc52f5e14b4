/* Whole files. */
#ifndef SPRAYPLAN_MESH_FILE_H
#define SPRAYPLAN_MESH_FILE_H

#include <sprayplan/error.h>

#include <stddef.h>

/* The whole file with a '\0' behind it, which the caller frees; also of what has no size beforehand, such as a pipe. */
char *sp_read_file(const char *path, size_t *size, sp_error *error);

/* Writes the whole file, which is replaced where it exists. */
bool sp_write_file(const char *path, const void *bytes, size_t size, sp_error *error);

#endif
