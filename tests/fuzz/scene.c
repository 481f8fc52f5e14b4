/* Scenes. */
#include "scene.h"

bool target_accepted;

enum { WRITTEN = 256 }; /* one in so many: writing reads the database of units */

static bool read_scene(sp_scene *scene, const char *text, size_t size, sp_error *error)
{
    sp_reader reader = {units_of_all_inputs(), error};
    scene->tree = sp_yaml_parse("strange", text, size, error);
    if (!scene->tree)
        return false;
    if (scene->tree->kind != SP_YAML_MAP)
        return sp_read_fail(&reader, scene->tree, "scene", "a map");
    return sp_scene_read(scene, &reader);
}

static void require_sound_layout(const sp_layout *layout)
{
    for (size_t i = 0; i < layout->count; i++) {
        const sp_nozzle *nozzle = &layout->nozzles[i];
        REQUIRE(nozzle->name[0] && nozzle->type && nozzle->pressure > 0 && isfinite(nozzle->pressure));
        REQUIRE(isfinite(sp_length(nozzle->position)) && fabs(sp_length(nozzle->axis) - 1) < 1e-9);
        for (size_t k = 0; layout->count < 10 && k < i; k++)
            REQUIRE(strcmp(nozzle->name, layout->nozzles[k].name) != 0);
    }
}

static void require_sound(const sp_scene *scene)
{
    const sp_setup *setup = &scene->setup;
    REQUIRE(scene->mesh && scene->mesh->triangle_count > 0 && scene->surfaces && scene->layout);
    for (size_t i = 0; i < scene->mesh->vertex_count; i++)
        REQUIRE(isfinite(sp_length(scene->mesh->vertices[i])));
    for (size_t i = 0; i < scene->mesh->part_count; i++)
        REQUIRE(scene->surfaces[i].restitution >= 0 && scene->surfaces[i].restitution <= 1);
    REQUIRE(isfinite(setup->gravity) && setup->liquid.density > 0 && isfinite(setup->liquid.density));
    REQUIRE(setup->criterion.flux >= 0 && isfinite(setup->criterion.flux));
    require_sound_layout(scene->layout);
}

/* Written with its layout it is a scene again. */
static void require_written(const sp_scene *scene)
{
    static const sp_fidelity fidelity = {SP_TRAJECTORY_LINE, SP_METHOD_INVERSE, 0, 0, 0.01, SP_SPLAT_NEAREST, 0.01, 1};
    sp_error error = {0};
    char *text = sp_scene_text(scene, scene->layout, &fidelity, FILES, &error);
    sp_scene *again = scene_in_files();
    if (!text || !read_scene(again, text, strlen(text), &error))
        fprintf(stderr, "%d: %s in\n%s", error.line, error.message, text ? text : "");
    REQUIRE(error.kind == SP_OK && again->layout->count == scene->layout->count);
    REQUIRE(again->mesh->triangle_count == scene->mesh->triangle_count);
    sp_scene_destroy(again);
    free(text);
}

/* Of all bytes, so that the same inputs are written each time. */
static unsigned sum_of(const uint8_t *data, size_t size)
{
    unsigned sum = 0;
    for (size_t i = 0; i < size; i++)
        sum += data[i];
    return sum;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    sp_error error = {0};
    meter_start();
    sp_scene *scene = scene_in_files();
    target_accepted = read_scene(scene, (const char *)data, size, &error);
    require_frugal(size);
    REQUIRE(target_accepted == (error.kind == SP_OK));
    if (!target_accepted)
        require_located_in_files(&error, data, size);
    else
        require_sound(scene);
    if (target_accepted)
        require_written_tree(scene->tree);
    if (target_accepted && sum_of(data, size) % WRITTEN == 0)
        require_written(scene);
    sp_scene_destroy(scene);
    return 0;
}
