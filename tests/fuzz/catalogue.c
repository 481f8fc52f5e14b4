/* Catalogues of nozzles. */
#include "scene.h"

bool target_accepted;

static void require_sound(const sp_nozzle_type *type)
{
    REQUIRE(type->name[0] && memchr(type->name, '\0', sizeof type->name) && type->pattern <= SP_PATTERN_MEASURED);
    REQUIRE(type->flow > 0 && isfinite(type->flow) && type->cv > 0 && type->cv <= 1);
    REQUIRE(type->flow_min <= type->flow && type->flow <= type->flow_max);
    REQUIRE(type->angle_min <= type->angle && type->angle <= type->angle_max);
    REQUIRE(type->hollow >= 0 && type->hollow < 1 && (!type->url[0] || sp_is_url(type->url)));
    REQUIRE((type->pattern == SP_PATTERN_CLUSTER) == (type->member_count > 0));
    for (size_t i = 0; i < type->member_count; i++)
        REQUIRE(type->members[i].share > 0 && isfinite(type->members[i].share));
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    sp_error error = {0};
    sp_reader reader = {units_of_all_inputs(), &error};
    meter_start();
    sp_scene *scene = scene_in_files();
    scene->tree = sp_yaml_parse("strange", (const char *)data, size, &error);
    target_accepted = scene->tree && sp_scene_read_types_of(scene, &reader, scene->tree);
    require_frugal(size);
    REQUIRE(target_accepted == (error.kind == SP_OK));
    if (target_accepted)
        for (size_t i = 0; i < scene->type_count; i++)
            require_sound(&scene->types[i]);
    else
        require_located_in_files(&error, data, size);
    if (target_accepted)
        require_written_tree(scene->tree);
    sp_scene_destroy(scene);
    return 0;
}
