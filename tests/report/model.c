/* The design as glTF: valid, and with the parts and nozzles that it shows. */
#include "exported.h"

#include <jansson.h>

typedef struct {
    exported e;
    char *bytes; /* of the file */
    json_t *json;
    const char *buffer;
    size_t buffer_size;
} fixture;

static size_t number(const json_t *object, const char *key)
{
    assert_true(json_is_integer(json_object_get(object, key)));
    return (size_t)json_integer_value(json_object_get(object, key));
}

static json_t *item(const fixture *f, const char *list, size_t index)
{
    json_t *entry = json_array_get(json_object_get(f->json, list), index);
    assert_non_null(entry);
    return entry;
}

/* glTF 2.0, 4.4: a header, a JSON chunk, a binary chunk. */
static void read_model(fixture *f)
{
    size_t size;
    f->bytes = export_bytes(&f->e, sp_report_model_glb, BINARY_DIR "/model-test.glb", &size);
    assert_memory_equal(f->bytes, "glTF", 4);
    assert_int_equal(export_number(f->bytes + 4, 4), 2);
    assert_int_equal(export_number(f->bytes + 8, 4), size);
    size_t length = export_number(f->bytes + 12, 4);
    assert_memory_equal(f->bytes + 16, "JSON", 4);
    assert_int_equal(length % 4, 0);
    f->json = json_loadb(f->bytes + 20, length, JSON_REJECT_DUPLICATES, NULL);
    assert_non_null(f->json);
    assert_memory_equal(f->bytes + 20 + length + 4, "BIN", 4);
    f->buffer = f->bytes + 28 + length;
    f->buffer_size = export_number(f->bytes + 20 + length, 4);
    assert_int_equal(28 + length + f->buffer_size, size);
    assert_int_equal(number(item(f, "buffers", 0), "byteLength"), f->buffer_size);
}

static void set_up(fixture *f, bool cavity)
{
    export_set_up(&f->e, cavity, sp_v(0, 0, 0), sp_transform_default());
    read_model(f);
}

static void tear_down(fixture *f)
{
    json_decref(f->json);
    free(f->bytes);
    export_tear_down(&f->e);
}

static const char *accessor_bytes(const fixture *f, const json_t *accessor)
{
    return f->buffer + number(item(f, "bufferViews", number(accessor, "bufferView")), "byteOffset");
}

/* 3.6: every accessor lies within its view, every view within the buffer. */
static void check_accessors(const fixture *f)
{
    json_t *views = json_object_get(f->json, "bufferViews"), *accessors = json_object_get(f->json, "accessors"), *one;
    size_t i;
    json_array_foreach(views, i, one)
        assert_true(number(one, "byteOffset") + number(one, "byteLength") <= f->buffer_size);
    json_array_foreach(accessors, i, one)
    {
        const char *type = json_string_value(json_object_get(one, "type"));
        size_t components = !strcmp(type, "SCALAR") ? 1 : !strcmp(type, "VEC2") ? 2 : 3;
        size_t width = number(one, "componentType") == 5123 ? 2 : 4;
        assert_true(number(one, "count") > 0);
        assert_true(number(one, "count") * components * width <=
                    number(item(f, "bufferViews", number(one, "bufferView")), "byteLength"));
    }
}

/* Returns how many triangles; every index is that of a vertex, every vertex of a texture lies on it. */
static size_t check_primitive(const fixture *f, const json_t *primitive)
{
    const json_t *attributes = json_object_get(primitive, "attributes");
    const json_t *corners = item(f, "accessors", number(primitive, "indices"));
    size_t vertices = number(item(f, "accessors", number(attributes, "POSITION")), "count");
    size_t width = number(corners, "componentType") == 5123 ? 2 : 4, count = number(corners, "count");
    const char *bytes = accessor_bytes(f, corners);
    for (size_t i = 0; i < count; i++)
        assert_true(export_number(bytes + i * width, width) < vertices);
    const json_t *material = item(f, "materials", number(primitive, "material"));
    assert_non_null(json_object_get(json_object_get(material, "extensions"), "KHR_materials_unlit"));
    const json_t *pbr = json_object_get(material, "pbrMetallicRoughness");
    assert_true(!json_object_get(attributes, "TEXCOORD_0") == !json_object_get(pbr, "baseColorTexture"));
    assert_int_equal(count % 3, 0);
    return count / 3;
}

static size_t drawn_sides(const fixture *f, bool cavity, uint32_t part)
{
    size_t count = 0;
    for (uint32_t t = 0; t < f->e.mesh->triangle_count; t++) {
        unsigned wet = sp_evaluator_wet(f->e.evaluator, t);
        if (f->e.mesh->part[t] == part)
            count += cavity ? (wet & 1) + (wet >> 1 & 1) : 1;
    }
    return count;
}

static void check_parts(const fixture *f, bool cavity)
{
    static const char *const names[] = {"shell", EXPORTED_NAME_TOLD, "shaft"};
    const json_t *children = json_object_get(item(f, "nodes", 0), "children");
    assert_int_equal(json_array_size(children), 3 + f->e.layout->count);
    for (uint32_t part = 0; part < 3; part++) {
        const json_t *node = item(f, "nodes", (size_t)json_integer_value(json_array_get(children, part)));
        const json_t *mesh = item(f, "meshes", number(node, "mesh"));
        assert_string_equal(json_string_value(json_object_get(node, "name")), names[part]);
        assert_string_equal(json_string_value(json_object_get(mesh, "name")), names[part]);
        json_t *primitives = json_object_get(mesh, "primitives"), *primitive;
        size_t i, triangles = 0;
        json_array_foreach(primitives, i, primitive) triangles += check_primitive(f, primitive);
        assert_int_equal(triangles, drawn_sides(f, cavity, part));
    }
}

static void the_model_is_a_gltf(void **state)
{
    (void)state;
    for (int cavity = 0; cavity < 2; cavity++) {
        fixture f;
        set_up(&f, cavity);
        check_accessors(&f);
        check_parts(&f, cavity);
        tear_down(&f);
    }
}

static sp_vec3 turned(const json_t *rotation, sp_vec3 v)
{
    double q[4];
    for (size_t k = 0; k < 4; k++)
        q[k] = json_number_value(json_array_get(rotation, k));
    sp_vec3 axis = sp_v(q[0], q[1], q[2]), across = sp_add(sp_cross(axis, v), sp_scale(v, q[3]));
    return sp_along(v, 2, sp_cross(axis, across));
}

/* Where they are and where they point: their bodies' tips are the nodes' own (0, 0, 0). */
static void nozzles_are_nodes(void **state)
{
    (void)state;
    fixture f;
    set_up(&f, true);
    for (size_t i = 0; i < f.e.layout->count; i++) {
        const sp_nozzle *nozzle = &f.e.layout->nozzles[i];
        const json_t *node = item(&f, "nodes", 4 + i), *at = json_object_get(node, "translation");
        const json_t *rotation = json_object_get(node, "rotation");
        sp_frame frame = sp_nozzle_frame(nozzle->axis, nozzle->roll, sp_evaluator_setup(f.e.evaluator)->up);
        assert_string_equal(json_string_value(json_object_get(node, "name")),
                            i == 2 ? EXPORTED_NAME_TOLD : nozzle->name);
        sp_vec3 place = sp_v(json_number_value(json_array_get(at, 0)), json_number_value(json_array_get(at, 1)),
                             json_number_value(json_array_get(at, 2)));
        assert_true(sp_distance(place, nozzle->position) < 1e-8);
        assert_true(sp_distance(turned(rotation, sp_v(1, 0, 0)), frame.x) < 1e-7);
        assert_true(sp_distance(turned(rotation, sp_v(0, 1, 0)), frame.y) < 1e-7);
        assert_true(sp_distance(turned(rotation, sp_v(0, 0, 1)), nozzle->axis) < 1e-7);
        const json_t *primitives = json_object_get(item(&f, "meshes", number(node, "mesh")), "primitives");
        const json_t *primitive = json_array_get(primitives, 0);
        const json_t *places = item(&f, "accessors", number(json_object_get(primitive, "attributes"), "POSITION"));
        assert_true(json_number_value(json_array_get(json_object_get(places, "max"), 2)) == 0);
        assert_int_equal(check_primitive(&f, primitive), 64);
    }
    tear_down(&f);
}

/* The first vertex of each textured triangle shows the colour of a page: it lies on the part of the picture that the
 * page fills. Pictures are squares of a power of two. */
static void pages_fill_powers_of_two(void **state)
{
    (void)state;
    fixture f;
    set_up(&f, true);
    const char *png =
        f.buffer + number(item(&f, "bufferViews", number(item(&f, "images", 0), "bufferView")), "byteOffset");
    uint32_t edge = sp_evaluator_atlas(f.e.evaluator)->page_edge, wide = 0, high = 0, power = 1;
    for (int k = 0; k < 4; k++) {
        wide = wide << 8 | (unsigned char)png[16 + k];
        high = high << 8 | (unsigned char)png[20 + k];
    }
    while (power < edge)
        power *= 2;
    assert_true(wide == power && high == power && power != edge);
    json_t *one, *accessors = json_object_get(f.json, "accessors");
    size_t i, textured = 0;
    json_array_foreach(accessors, i, one)
    {
        if (strcmp(json_string_value(json_object_get(one, "type")), "VEC2") != 0)
            continue;
        textured++;
        for (size_t k = 0; k < 2; k++) {
            assert_true(json_number_value(json_array_get(json_object_get(one, "min"), k)) >= 0);
            assert_true(json_number_value(json_array_get(json_object_get(one, "max"), k)) <=
                        (double)edge / power + 1e-7);
        }
    }
    assert_int_equal(textured, 2); /* shell and tube; the shaft is not cleaned */
    tear_down(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_model_is_a_gltf),
        cmocka_unit_test(nozzles_are_nodes),
        cmocka_unit_test(pages_fill_powers_of_two),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
