/* The mesh and its place on the pages as OBJ text. */
#include "atlas/reuse.h"
#include "mesh/obj_name.h"

#include <sprayplan/atlas.h>

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    char *bytes;
    size_t count, capacity;
    bool failed;
} text;

static void append(text *t, const char *format, ...)
{
    va_list arguments;
    while (!t->failed) {
        va_start(arguments, format);
        char *end = t->bytes ? t->bytes + t->count : NULL;
        int length = vsnprintf(end, t->capacity - t->count, format, arguments);
        va_end(arguments);
        if (length >= 0 && (size_t)length < t->capacity - t->count) {
            t->count += (size_t)length;
            return;
        }
        size_t capacity = 2 * t->capacity + 4096;
        char *bytes = length >= 0 ? realloc(t->bytes, capacity) : NULL;
        t->failed = !bytes;
        if (bytes) {
            t->bytes = bytes;
            t->capacity = capacity;
        }
    }
}

/* One `vt`: where a vertex lies on a page. A vertex on a cut lies in several places. */
typedef struct {
    uint32_t page;
    double uv[2];
    uint32_t next; /* the vertex's next place, SP_NONE after the last */
} place;

typedef struct {
    uint32_t *first; /* [vertex_count], SP_NONE for a vertex of degenerate triangles alone */
    place *places;
    size_t count;
    uint32_t (*corner)[3]; /* [triangle_count], the place of each corner */
} places;

static void free_places(places *p)
{
    free(p->first);
    free(p->places);
    free(p->corner);
}

static uint32_t place_of(places *p, uint32_t vertex, uint32_t page, const double uv[2])
{
    for (uint32_t i = p->first[vertex]; i != SP_NONE; i = p->places[i].next)
        if (p->places[i].page == page && p->places[i].uv[0] == uv[0] && p->places[i].uv[1] == uv[1])
            return i;
    p->places[p->count] = (place){page, {uv[0], uv[1]}, p->first[vertex]};
    p->first[vertex] = (uint32_t)p->count;
    return (uint32_t)p->count++;
}

/* Collects the places, those of equal coordinates once, so that what is joined in a chart is joined in the file. */
static bool find_places(places *p, const sp_atlas *atlas, const sp_mesh *mesh)
{
    p->first = malloc((mesh->vertex_count + 1) * sizeof *p->first);
    p->places = malloc((mesh->triangle_count + 1) * 3 * sizeof *p->places);
    p->corner = malloc((mesh->triangle_count + 1) * sizeof *p->corner);
    if (!p->first || !p->places || !p->corner)
        return false;
    for (size_t v = 0; v < mesh->vertex_count; v++)
        p->first[v] = SP_NONE;
    for (size_t t = 0; t < mesh->triangle_count; t++)
        for (int i = 0; i < 3; i++)
            p->corner[t][i] = place_of(p, mesh->triangles[t][i], atlas->chart_page[atlas->chart[t]], atlas->uv[t][i]);
    if (p->count == 0)
        p->places[p->count++] = (place){0, {0, 0}, SP_NONE};
    return true;
}

static void write_points(text *out, const places *p, const sp_mesh *mesh, uint32_t page_edge)
{
    for (size_t v = 0; v < mesh->vertex_count; v++)
        append(out, "v %.17g %.17g %.17g\n", mesh->vertices[v].x, mesh->vertices[v].y, mesh->vertices[v].z);
    for (size_t i = 0; i < p->count; i++)
        append(out, "vt %.17g %.17g\n", p->places[i].uv[0] / page_edge, p->places[i].uv[1] / page_edge);
}

/* A degenerate triangle lies in no chart: all its corners go to one place that one of its vertices has, or to the
 * first. */
static void degenerate_place(const places *p, const uint32_t triangle[3], uint32_t corner[3])
{
    uint32_t found = 0;
    for (int i = 2; i >= 0; i--)
        if (p->first[triangle[i]] != SP_NONE)
            found = p->first[triangle[i]];
    corner[0] = corner[1] = corner[2] = found;
}

static void append_group(text *out, const char *name)
{
    append(out, "g ");
    for (size_t at = 0; name[at]; at++)
        append(out, "%c", sp_obj_name_letter(name, at));
    append(out, "\n");
}

static void write_faces(text *out, const places *p, const sp_mesh *mesh)
{
    uint32_t part = SP_NONE, page = SP_NONE;
    size_t next = 0; /* triangles keep the order of their sources */
    for (size_t s = 0; s < mesh->source_triangle_count; s++) {
        const uint32_t *triangle = mesh->source_triangles[s];
        uint32_t corner[3];
        if (next < mesh->triangle_count && mesh->source[next] == s)
            memcpy(corner, p->corner[next++], sizeof corner);
        else
            degenerate_place(p, triangle, corner);
        if (mesh->source_part[s] != part) {
            part = mesh->source_part[s];
            append_group(out, mesh->parts[part].name);
        }
        if (p->places[corner[0]].page != page) {
            page = p->places[corner[0]].page;
            append(out, "usemtl page_%u\n", page);
        }
        append(out, "f");
        for (int i = 0; i < 3; i++)
            append(out, " %lu/%lu", triangle[i] + 1ul, corner[i] + 1ul);
        append(out, "\n");
    }
}

char *sp_atlas_obj(const sp_atlas *atlas, const sp_mesh *mesh, sp_error *error)
{
    if (!atlas || !mesh)
        return NULL;
    places p = {0};
    text out = {0};
    bool done = find_places(&p, atlas, mesh);
    if (done) {
        append(&out, SP_ATLAS_MARK "%u %.17g\n", atlas->page_edge, atlas->texel);
        write_points(&out, &p, mesh, atlas->page_edge);
        write_faces(&out, &p, mesh);
        append(&out, "%s", ""); /* terminates an empty text too */
    }
    free_places(&p);
    if (done && !out.failed)
        return out.bytes;
    free(out.bytes);
    return sp_fail_memory(error);
}
