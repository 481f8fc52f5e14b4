#include "flaws.h"

#include "../boxes.h"
#include "lengths.h"

#include <stddef.h>
#include <stdio.h>

#define INSIDE_OUT offsetof(sp_mesh_diagnosis, inside_out)

static const struct {
    const char *key, *name;
    size_t offset;
} kinds[] = {
    {"degenerate", "triangles without area", offsetof(sp_mesh_diagnosis, degenerate)},
    {"duplicate_triangles", "triangles there twice", offsetof(sp_mesh_diagnosis, duplicate_triangles)},
    {"open_edges", "open edges", offsetof(sp_mesh_diagnosis, open_edges)},
    {"cracks", "corners at cracks", offsetof(sp_mesh_diagnosis, cracks)},
    {"non_manifold_edges", "non-manifold edges", offsetof(sp_mesh_diagnosis, non_manifold_edges)},
    {"flipped_edges", "flipped edges", offsetof(sp_mesh_diagnosis, flipped_edges)},
    {"crossings", "crossings in a shell", offsetof(sp_mesh_diagnosis, crossings)},
    {"inside_out", "shells inside out", INSIDE_OUT},
    {"bits", "loose bits", offsetof(sp_mesh_diagnosis, bits)},
};
#define KINDS (sizeof kinds / sizeof *kinds)
#define A_LINE 3 /* places */
#define INDENT "                                      "

static sp_flaw *flaw_of(sp_mesh_diagnosis *mesh, size_t kind)
{
    return (sp_flaw *)((char *)mesh + kinds[kind].offset);
}

static const sp_flaw *const_flaw_of(const sp_mesh_diagnosis *mesh, size_t kind)
{
    return (const sp_flaw *)((const char *)mesh + kinds[kind].offset);
}

static size_t places_of(const sp_flaw *flaw)
{
    return flaw->count < SP_PLACES ? flaw->count : SP_PLACES;
}

void cli_flaws_outside(const sp_setup *setup, sp_mesh_diagnosis *mesh)
{
    for (size_t kind = 0; kind < KINDS; kind++) {
        sp_flaw *flaw = flaw_of(mesh, kind);
        for (size_t i = 0; i < places_of(flaw); i++)
            flaw->place[i] = sp_setup_outside(setup, flaw->place[i]);
    }
}

bool cli_flaws_print(const sp_mesh_diagnosis *mesh)
{
    bool any = false;
    for (size_t kind = 0; kind < KINDS; kind++) {
        const sp_flaw *flaw = const_flaw_of(mesh, kind);
        if (!flaw->count && !flaw->more)
            continue;
        if (!any)
            printf("\n%-24s %12s  %s\n", "flaw", "count", "the first, at m");
        any = true;
        printf("%-24s %11zu%c ", kinds[kind].name, flaw->count, flaw->more ? '+' : ' ');
        for (size_t i = 0; i < places_of(flaw); i++) {
            char place[CLI_POINT];
            cli_point_text(flaw->place[i], cli_box_step((cli_box){mesh->minimum, mesh->maximum}), "", place);
            printf("%s[%s]", i % A_LINE ? ", " : i ? "\n" INDENT : "", place);
        }
        printf("\n");
    }
    return any;
}

void cli_flaws_print_change(const sp_mesh_diagnosis *before, const sp_mesh_diagnosis *after)
{
    bool any = false;
    for (size_t kind = 0; kind < KINDS; kind++) {
        const sp_flaw *was = const_flaw_of(before, kind), *is = const_flaw_of(after, kind);
        if (!was->count && !was->more && !is->count && !is->more)
            continue;
        if (!any)
            printf("%-24s %12s %12s\n", "flaw", "before", "after");
        any = true;
        /* a mesh alone does not tell whether that is a room, and right */
        const char *name = kinds[kind].offset == INSIDE_OUT ? "shells facing inwards" : kinds[kind].name;
        printf("%-24s %11zu%c %11zu%c\n", name, was->count, was->more ? '+' : ' ', is->count, is->more ? '+' : ' ');
    }
}

json_t *cli_flaws_json(const sp_mesh_diagnosis *mesh)
{
    json_t *all = json_object();
    for (size_t kind = 0; kind < KINDS; kind++) {
        const sp_flaw *flaw = const_flaw_of(mesh, kind);
        json_t *places = json_array();
        for (size_t i = 0; i < places_of(flaw); i++)
            json_array_append_new(places, json_pack("[fff]", flaw->place[i].x, flaw->place[i].y, flaw->place[i].z));
        json_object_set_new(all, kinds[kind].key,
                            json_pack("{s:I, s:b, s:o}", "count", (json_int_t)flaw->count, "perhaps_more",
                                      (int)flaw->more, "places_m", places));
    }
    return all;
}
