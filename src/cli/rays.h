/* Files of rays, as trace reads them. */
#ifndef CLI_RAYS_H
#define CLI_RAYS_H

#include <sprayplan/trace.h>

#include <stdio.h>

/* Starts with a path and an open file, the rest 0. Whoever closes the file frees `text`. */
typedef struct {
    const char *path; /* for errors */
    FILE *file;
    int line;
    char *text; /* of the line */
    size_t capacity;
} cli_rays;

/* Up to `room` rays; fewer only at the end of the file. Fails at the first line that is neither blank, a comment nor
 * six numbers, origin in m and velocity in m/s, at most 1e30 each and a velocity of more than 0. */
bool cli_rays_read(cli_rays *reader, sp_ray *rays, size_t room, size_t *count, sp_error *error);

#endif
