/* Files of rays, as trace reads them. */
#ifndef CLI_RAYS_H
#define CLI_RAYS_H

#include <sprayplan/trace.h>

#include <stdio.h>

#define CLI_RAYS_LARGEST 1e30 /* m, m/s, m/s2: as of a mesh, whose box no ray need be further from */

/* Starts with a path, an open file and gravity, the rest 0. Whoever closes the file frees `text`. */
typedef struct {
    const char *path; /* for errors */
    FILE *file;
    sp_vec3 gravity; /* m/s2; 0: rays are lines */
    int line;
    char *text; /* of the line */
    size_t capacity;
} cli_rays;

/* Up to `room` rays; fewer only at the end of the file. Fails at the first line that is neither blank, a comment nor
 * six numbers, origin in m and velocity in m/s, at most 1e30 each; without gravity also at the first
 * velocity of 0, or so small that its square is no number. */
bool cli_rays_read(cli_rays *reader, sp_ray *rays, size_t room, size_t *count, sp_error *error);

#endif
