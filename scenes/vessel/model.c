#include "model.h"

#include <inttypes.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define TICKS_PER_MM 10000 /* four decimals */

typedef struct {
    int64_t x, y, z;
} point;

typedef struct {
    const char *part;
    int count;
    point corners[4];
} face;

struct model {
    const char *part;
    face *faces;
    size_t count, capacity;
    bool failed;
};

model *model_create(void)
{
    return calloc(1, sizeof(model));
}

void model_destroy(model *model)
{
    if (model)
        free(model->faces);
    free(model);
}

void model_part(model *model, const char *name)
{
    model->part = name;
}

static point rounded(sp_vec3 p)
{
    return (point){llround(p.x * TICKS_PER_MM), llround(p.y * TICKS_PER_MM), llround(p.z * TICKS_PER_MM)};
}

static int compare_points(const void *a, const void *b)
{
    const point *p = a, *q = b;
    if (p->x != q->x)
        return p->x < q->x ? -1 : 1;
    if (p->y != q->y)
        return p->y < q->y ? -1 : 1;
    return p->z < q->z ? -1 : p->z > q->z;
}

static bool reserve(model *model)
{
    if (model->count < model->capacity)
        return true;
    size_t capacity = model->capacity ? 2 * model->capacity : 4096;
    face *faces = realloc(model->faces, capacity * sizeof *faces);
    if (!faces) {
        model->failed = true;
        return false;
    }
    model->faces = faces;
    model->capacity = capacity;
    return true;
}

void model_face(model *model, const sp_vec3 *corners, int count)
{
    face face = {.part = model->part};
    for (int i = 0; i < count; ++i) {
        point p = rounded(corners[i]);
        bool seen = false;
        for (int j = 0; j < face.count; ++j)
            seen = seen || compare_points(&p, &face.corners[j]) == 0;
        if (!seen)
            face.corners[face.count++] = p;
    }
    if (face.count >= 3 && !model->failed && reserve(model))
        model->faces[model->count++] = face;
}

size_t model_triangles(const model *model)
{
    size_t triangles = 0;
    for (size_t i = 0; i < model->count; ++i)
        triangles += (size_t)model->faces[i].count - 2;
    return triangles;
}

/* All corners, each once, in ascending order. */
static point *distinct_points(const model *model, size_t *count)
{
    point *points = malloc((4 * model->count + 1) * sizeof *points);
    size_t n = 0;
    if (!points)
        return NULL;
    for (size_t i = 0; i < model->count; ++i)
        for (int j = 0; j < model->faces[i].count; ++j)
            points[n++] = model->faces[i].corners[j];
    qsort(points, n, sizeof *points, compare_points);
    *count = 0;
    for (size_t i = 0; i < n; ++i)
        if (i == 0 || compare_points(&points[i], &points[i - 1]) != 0)
            points[(*count)++] = points[i];
    return points;
}

static void write_coordinate(FILE *file, int64_t ticks)
{
    int64_t size = ticks < 0 ? -ticks : ticks;
    fprintf(file, " %s%" PRId64 ".%04" PRId64, ticks < 0 ? "-" : "", size / TICKS_PER_MM, size % TICKS_PER_MM);
}

static void write_faces(FILE *file, const model *model, const point *points, size_t point_count)
{
    const char *part = NULL;
    for (size_t i = 0; i < model->count; ++i) {
        const face *face = &model->faces[i];
        if (!part || strcmp(part, face->part) != 0)
            fprintf(file, "g %s\n", part = face->part);
        fputc('f', file);
        for (int j = 0; j < face->count; ++j) {
            const point *p = bsearch(&face->corners[j], points, point_count, sizeof *points, compare_points);
            fprintf(file, " %zu", (size_t)(p - points) + 1);
        }
        fputc('\n', file);
    }
}

bool model_write(const model *model, const char *path)
{
    size_t count = 0;
    point *points = model->failed ? NULL : distinct_points(model, &count);
    FILE *file = points ? fopen(path, "w") : NULL;
    if (!file) {
        free(points);
        return false;
    }
    fprintf(file, "# A 2 m3 stirred vessel, mm, z up; made by scenes/vessel\n");
    for (size_t i = 0; i < count; ++i) {
        fputc('v', file);
        write_coordinate(file, points[i].x);
        write_coordinate(file, points[i].y);
        write_coordinate(file, points[i].z);
        fputc('\n', file);
    }
    write_faces(file, model, points, count);
    free(points);
    bool written = !ferror(file);
    return fclose(file) == 0 && written;
}
