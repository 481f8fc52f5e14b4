/* The vessel in false colour as a binary glTF 2.0 model: the atlas pages are its textures. A wall's wet side is drawn
 * and its dry side is not, so that a viewer looks through the near wall. Each part is a node, and so is each nozzle. */
#include "gltf.h"
#include "nozzle_body.h"
#include "scaled_files.h"
#include "surface.h"

#include "result/design.h"

#include <sprayplan/image.h>
#include <sprayplan/report.h>

#include <stdlib.h>
#include <string.h>

static const uint8_t nozzle_colour[3] = {16, 32, 42};

typedef struct {
    const sp_design *design;
    const sp_colour_scale *scale;
    sp_layers layers;
    sp_drawn_surface surface;
    uint32_t edge;         /* of the textures: a power of two, of which a page fills the upper left */
    json_int_t *materials; /* [page_count + 1][2]: of each page and side, and of what is not cleaned; -1: none yet */
    sp_gltf gltf;
    json_t *children; /* of the root */
    sp_error *error;
} model;

static uint8_t *enlarged(const uint8_t *pixels, size_t from, size_t to)
{
    uint8_t *large = malloc(3 * to * to);
    for (size_t i = 0; large && i < to * to; ++i)
        memcpy(large + 3 * i, sp_colour_obstacle, 3);
    for (size_t y = 0; large && y < from; ++y)
        memcpy(large + 3 * y * to, pixels + 3 * y * from, 3 * from);
    return large;
}

static bool add_page(model *m, uint32_t page, int layer, json_int_t *material)
{
    size_t size = 0;
    char name[48];
    uint8_t *pixels =
        sp_layers_picture(&m->layers, m->design->coverage, m->scale, page, layer, sp_colour_obstacle, true, m->error);
    if (!pixels)
        return false;
    uint8_t *large = enlarged(pixels, sp_evaluator_atlas(m->design->evaluator)->page_edge, m->edge);
    free(pixels);
    if (!large)
        return sp_fail_memory(m->error);
    uint8_t *png = sp_image_encode_png(large, (int)m->edge, (int)m->edge, 3, &size, m->error);
    free(large);
    if (!png)
        return false;
    snprintf(name, sizeof name, "page%u%s", (unsigned)page, layer ? "-back" : "");
    *material =
        sp_gltf_add_material(&m->gltf, name, NULL, sp_gltf_add_texture(&m->gltf, png, size), m->layers.two_sided);
    free(png);
    return true;
}

static bool find_material(model *m, const sp_drawn_range *range, json_int_t *material)
{
    size_t pages = sp_evaluator_atlas(m->design->evaluator)->page_count;
    json_int_t *known = range->page == SP_NONE ? &m->materials[2 * pages]
                                               : &m->materials[2 * (size_t)range->page + (size_t)range->layer];
    bool found = *known >= 0;
    if (!found && range->page == SP_NONE) {
        *known = sp_gltf_add_material(&m->gltf, "not cleaned", sp_colour_obstacle, -1, m->layers.two_sided);
        found = true;
    }
    found = found || add_page(m, range->page, range->layer, known);
    *material = *known;
    return found;
}

/* The vertices of a part: `count` from `first` on. */
typedef struct {
    size_t first, count;
    bool textured;
    json_int_t places, uv;
} part_vertices;

static bool add_vertices(model *m, part_vertices *part)
{
    const sp_mesh *mesh = sp_evaluator_setup(m->design->evaluator)->mesh;
    float *places = malloc(3 * part->count * sizeof *places), *uv = malloc(2 * part->count * sizeof *uv);
    float filled = (float)sp_evaluator_atlas(m->design->evaluator)->page_edge / (float)m->edge;
    for (size_t i = 0; places && uv && i < part->count; ++i) {
        const sp_drawn_vertex *vertex = &m->surface.vertices[part->first + i];
        places[3 * i] = (float)mesh->vertices[vertex->at].x;
        places[3 * i + 1] = (float)mesh->vertices[vertex->at].y;
        places[3 * i + 2] = (float)mesh->vertices[vertex->at].z;
        uv[2 * i] = vertex->uv[0] * filled;
        uv[2 * i + 1] = (1 - vertex->uv[1]) * filled;
    }
    bool done = places && uv;
    if (done) {
        part->places = sp_gltf_add_vectors(&m->gltf, places, part->count, 3);
        part->uv = part->textured ? sp_gltf_add_vectors(&m->gltf, uv, part->count, 2) : -1;
    }
    free(places);
    free(uv);
    return done || sp_fail_memory(m->error);
}

static bool add_range(model *m, const part_vertices *part, const sp_drawn_range *range, json_t *primitives)
{
    json_int_t material;
    uint32_t *indices = malloc(3 * range->count * sizeof *indices);
    if (!indices)
        return sp_fail_memory(m->error);
    for (size_t i = 0; i < 3 * range->count; ++i)
        indices[i] = m->surface.corners[range->first + i / 3][i % 3] - (uint32_t)part->first;
    json_int_t corners = sp_gltf_add_indices(&m->gltf, indices, 3 * range->count, part->count);
    free(indices);
    if (!find_material(m, range, &material))
        return false;
    json_t *attributes = json_pack("{s:I}", "POSITION", part->places);
    if (range->page != SP_NONE)
        json_object_set_new(attributes, "TEXCOORD_0", json_integer(part->uv));
    json_array_append_new(
        primitives, json_pack("{s:o, s:I, s:I}", "attributes", attributes, "indices", corners, "material", material));
    return true;
}

/* Takes the node over. */
static void add_child(model *m, json_t *node)
{
    json_array_append_new(m->children, json_integer(sp_gltf_add(&m->gltf, SP_GLTF_NODES, node)));
}

/* Ranges from `first` on that are of one part, of which the last ends before *end. */
static bool add_part(model *m, size_t first, size_t *end)
{
    const sp_drawn_range *ranges = m->surface.ranges;
    uint32_t part = ranges[first].part;
    part_vertices own = {.first = ranges[first].vertex_first};
    for (*end = first; *end < m->surface.range_count && ranges[*end].part == part; ++*end) {
        own.count = ranges[*end].vertex_end - own.first;
        own.textured |= ranges[*end].page != SP_NONE;
    }
    char *name = sp_text_utf8(sp_evaluator_setup(m->design->evaluator)->mesh->parts[part].name);
    json_t *primitives = json_array();
    bool done = (name && primitives) || sp_fail_memory(m->error);
    done = done && add_vertices(m, &own);
    for (size_t i = first; done && i < *end; ++i)
        done = add_range(m, &own, &ranges[i], primitives);
    if (done) {
        json_int_t mesh =
            sp_gltf_add(&m->gltf, SP_GLTF_MESHES, json_pack("{s:s, s:O}", "name", name, "primitives", primitives));
        add_child(m, json_pack("{s:s, s:I}", "name", name, "mesh", mesh));
    }
    json_decref(primitives);
    free(name);
    return done;
}

static json_int_t add_body(model *m)
{
    sp_nozzle_body body = sp_nozzle_body_create(sp_evaluator_setup(m->design->evaluator));
    float places[SP_BODY_VERTICES][3];
    for (int i = 0; i < SP_BODY_VERTICES; ++i) {
        places[i][0] = (float)body.vertices[i].x;
        places[i][1] = (float)body.vertices[i].y;
        places[i][2] = (float)body.vertices[i].z;
    }
    json_int_t material = sp_gltf_add_material(&m->gltf, "nozzle", nozzle_colour, -1, false);
    json_int_t vertices = sp_gltf_add_vectors(&m->gltf, places[0], SP_BODY_VERTICES, 3);
    json_int_t corners = sp_gltf_add_indices(&m->gltf, body.corners[0], 3 * SP_BODY_TRIANGLES, SP_BODY_VERTICES);
    return sp_gltf_add(&m->gltf, SP_GLTF_MESHES,
                       json_pack("{s:s, s:[{s:{s:I}, s:I, s:I}]}", "name", "nozzle", "primitives", "attributes",
                                 "POSITION", vertices, "indices", corners, "material", material));
}

/* A nozzle's own z is its axis, its x and y follow from its roll. */
static bool add_nozzles(model *m)
{
    const sp_setup *setup = sp_evaluator_setup(m->design->evaluator);
    const sp_layout *layout = m->design->layout;
    json_int_t body = layout->count ? add_body(m) : -1;
    for (size_t i = 0; i < layout->count; ++i) {
        const sp_nozzle *nozzle = &layout->nozzles[i];
        char *name = sp_text_utf8(nozzle->name);
        if (!name)
            return sp_fail_memory(m->error);
        add_child(m, json_pack("{s:s, s:I, s:[f,f,f], s:o}", "name", name, "mesh", body, "translation",
                               nozzle->position.x, nozzle->position.y, nozzle->position.z, "rotation",
                               sp_gltf_rotation(sp_nozzle_frame(nozzle->axis, nozzle->roll, setup->up))));
        free(name);
    }
    return true;
}

/* glTF is y up; a model with z up is turned by -90 degrees about x. Its children are added to it as they come. */
static bool add_root(model *m)
{
    const sp_setup *setup = sp_evaluator_setup(m->design->evaluator);
    bool z_up = setup->up.z > 0.5;
    sp_vec3 o = setup->origin, there = z_up ? sp_v(o.x, o.z, -o.y) : o;
    char *name = sp_text_utf8(m->design->name);
    m->children = json_array();
    json_t *node = name && m->children ? json_pack("{s:s, s:O}", "name", name, "children", m->children) : NULL;
    free(name);
    if (!node)
        return sp_fail_memory(m->error);
    /* floats do not tell a part from the next far from (0, 0, 0) */
    if (sp_length(o) > 0)
        json_object_set_new(node, "translation", json_pack("[f,f,f]", there.x, there.y, there.z));
    if (z_up)
        json_object_set_new(node, "rotation", json_pack("[f,f,f,f]", -sqrt(0.5), 0.0, 0.0, sqrt(0.5)));
    sp_gltf_add(&m->gltf, SP_GLTF_NODES, node);
    return true;
}

static bool prepare(model *m)
{
    const sp_atlas *atlas = sp_evaluator_atlas(m->design->evaluator);
    for (m->edge = 1; m->edge < atlas->page_edge;)
        m->edge *= 2;
    m->materials = malloc((2 * atlas->page_count + 1) * sizeof *m->materials);
    if (!m->materials)
        return sp_fail_memory(m->error);
    for (size_t i = 0; i <= 2 * atlas->page_count; ++i)
        m->materials[i] = -1;
    return sp_layers_create_for(&m->layers, m->design->evaluator, m->scale, m->error) &&
           sp_drawn_surface_create(&m->surface, &m->layers, m->error) && add_root(m);
}

bool sp_model_glb(const sp_design *design, const sp_colour_scale *scale, const char *path, sp_error *error)
{
    model m = {.design = design, .scale = scale, .error = error};
    bool done = prepare(&m);
    for (size_t next, i = 0; done && i < m.surface.range_count; i = next)
        done = add_part(&m, i, &next);
    done = done && add_nozzles(&m) && sp_gltf_write(&m.gltf, path, error);
    json_decref(m.children);
    sp_gltf_free(&m.gltf);
    free(m.materials);
    sp_drawn_surface_free(&m.surface);
    sp_layers_free(&m.layers);
    return done;
}

bool sp_report_model_glb(const sp_design *design, const char *path, sp_error *error)
{
    if (!sp_design_is_evaluated(design) || !design->layout || !path)
        return false;
    sp_colour_scale scale = sp_colour_scale_of(design, 1, (sp_picture_style){0});
    return sp_model_glb(design, &scale, path, error);
}
