/* Meshes and rays to trace. */
#ifndef TESTS_TRACE_SHAPES_H
#define TESTS_TRACE_SHAPES_H

#include <sprayplan/trace.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

/* xorshift64*, Vigna 2016. */
typedef struct {
    uint64_t state;
} random_source;

/* Uniform in [low, high). */
static inline double draw(random_source *source, double low, double high)
{
    source->state ^= source->state >> 12;
    source->state ^= source->state << 25;
    source->state ^= source->state >> 27;
    return low + (high - low) * (double)((source->state * 0x2545F4914F6CDD1Du) >> 11) * 0x1p-53;
}

static inline sp_vec3 draw_point(random_source *source, double size)
{
    double x = draw(source, -size, size), y = draw(source, -size, size);
    return sp_v(x, y, draw(source, -size, size));
}

static inline sp_mesh *make_mesh(const sp_vec3 *points, size_t point_count, const uint32_t (*triangles)[3],
                                 size_t count)
{
    sp_error error = {0};
    sp_mesh *mesh = sp_mesh_create(points, point_count, triangles, count, NULL, NULL, 0, &error);
    if (!mesh)
        fail_msg("%s", error.message);
    return mesh;
}

/* A closed ball of 2 n (n - 1) triangles around `centre`, its corners at `radius` times 1 to 1 + bumps. */
static inline sp_mesh *make_ball(uint32_t n, sp_vec3 centre, double radius, double bumps)
{
    uint32_t rings = n / 2 - 1, count = 2 + rings * n, made = 0;
    sp_vec3 *points = malloc(count * sizeof *points);
    uint32_t(*triangles)[3] = malloc(2 * n * rings * sizeof *triangles);
    random_source source = {12345};
    assert_non_null(points);
    assert_non_null(triangles);
    for (uint32_t i = 0; i < count; i++) {
        double polar = i < 2 ? i * M_PI : M_PI * (1 + (i - 2) / n) / (rings + 1),
               turn = 2 * M_PI * ((i + 2 * n - 2) % n) / n;
        sp_vec3 d = sp_v(sin(polar) * cos(turn), sin(polar) * sin(turn), cos(polar));
        points[i] = sp_along(centre, radius * draw(&source, 1, 1 + bumps), d);
    }
    for (uint32_t i = 0; i < n; i++) {
        uint32_t j = (i + 1) % n, last = 2 + (rings - 1) * n;
        memcpy(triangles[made++], (uint32_t[]){0, 2 + i, 2 + j}, sizeof *triangles);
        memcpy(triangles[made++], (uint32_t[]){1, last + j, last + i}, sizeof *triangles);
        for (uint32_t r = 0; r + 1 < rings; r++) {
            uint32_t a = 2 + r * n + i, b = 2 + r * n + j, c = a + n, d = b + n;
            memcpy(triangles[made++], (uint32_t[]){a, c, d}, sizeof *triangles);
            memcpy(triangles[made++], (uint32_t[]){a, d, b}, sizeof *triangles);
        }
    }
    sp_mesh *mesh = make_mesh(points, count, (const uint32_t(*)[3])triangles, made);
    free(points);
    free(triangles);
    return mesh;
}

static inline sp_tracer *make_tracer(const sp_mesh *mesh, sp_accelerator accelerator)
{
    sp_error error = {0};
    sp_tracer *tracer = sp_tracer_create(mesh, accelerator, 0, &error);
    if (!tracer)
        fail_msg("%s", error.message);
    return tracer;
}

static inline sp_ray make_ray(sp_vec3 origin, sp_vec3 velocity)
{
    return (sp_ray){origin, velocity, 0, INFINITY, SP_NONE};
}

#endif
