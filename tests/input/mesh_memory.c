/* No file makes its reader hold more than ten times its size and 64 MiB, the mesh included. */
#include "mesh_files.h"

#include "cli/cli.h"
#include "mesh/texture.h"

#include <pthread.h>
#include <sys/stat.h>

enum { SIZE = 12 << 20 }; /* of most files: a larger share of the limit than the 64 MiB */

typedef struct {
    char *bytes;
    size_t size;
} text;

/* A file of about SIZE that is `head`, then `line` again and again. */
static text repeat(const char *head, const void *line, size_t length)
{
    text t = {malloc(strlen(head) + SIZE + length), strlen(head)};
    assert_non_null(t.bytes);
    memcpy(t.bytes, head, t.size);
    for (; t.size < SIZE; t.size += length)
        memcpy(t.bytes + t.size, line, length);
    return t;
}

static text repeat_line(const char *head, const char *line)
{
    return repeat(head, line, strlen(line));
}

static void append(text *t, const char *more)
{
    t->bytes = realloc(t->bytes, t->size + strlen(more));
    assert_non_null(t->bytes);
    memcpy(t->bytes + t->size, more, strlen(more));
    t->size += strlen(more);
}

/* Reads it within the limit, and frees it; NULL where it is refused. */
static sp_mesh *read_within(text t, const char *extension, size_t limit, sp_error *error)
{
    size_t size = t.size;
    char *bytes = t.bytes;
    cli_meter_start();
    sp_mesh *mesh = read_bytes(extension, bytes, size, error);
    if (cli_meter_peak() > limit)
        fail_msg("%zu bytes for a file of %zu, expected %zu at most", cli_meter_peak(), size, limit);
    free(bytes);
    return mesh;
}

static void read_whole(text t, const char *extension, size_t triangles, size_t parts)
{
    sp_error error = {0};
    sp_mesh *mesh = read_within(t, extension, 10 * t.size + (64 << 20), &error);
    if (!mesh)
        fail_msg("%d: %s", error.line, error.message);
    assert_int_equal(mesh->source_triangle_count, triangles);
    assert_int_equal(mesh->part_count, parts);
    sp_mesh_destroy(mesh);
}

static void refuse(text t, const char *extension, size_t limit, const char *what)
{
    sp_error error = {0};
    assert_null(read_within(t, extension, limit, &error));
    if (error.kind != SP_ERROR_INPUT || !strstr(error.message, what))
        fail_msg("%d: %s\nexpected \"%s\"", error.line, error.message, what);
}

#define TRIANGLE "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
static const char too_many[] = "expected a mesh of at most ten times its file's size";

static void vertices_of_few_bytes(void **state)
{
    (void)state;
    text t = repeat_line(TRIANGLE "f 1 2 3\n", "v 1 2 3\n");
    read_whole(t, ".obj", 1, 1);
}

static void triangles_of_few_bytes(void **state)
{
    (void)state;
    const char head[] = TRIANGLE, line[] = "f 1 2 3\n";
    text t = repeat_line(head, line);
    read_whole(t, ".obj", (t.size - strlen(head)) / strlen(line), 1);
}

static void fans_of_few_bytes(void **state)
{
    (void)state;
    text one = repeat_line(TRIANGLE "f 1 2", " 3 1 2"), many = repeat_line(TRIANGLE, "f 1 2 3 1 2 3 1 2 3\n");
    refuse(one, ".obj", 10 * one.size + (64 << 20), too_many);
    refuse(many, ".obj", 10 * many.size + (64 << 20), too_many);
}

/* A polygon of a surface that is there may have as many corners as it likes. */
static void polygon_of_many_corners(void **state)
{
    (void)state;
    enum { CORNERS = 400000 };
    text t = {malloc(64 * CORNERS), 0};
    assert_non_null(t.bytes);
    for (int i = 0; i < CORNERS; i++)
        t.size += (size_t)sprintf(t.bytes + t.size, "v %d %d 0\n", i, (i % 1000) * i);
    t.bytes[t.size++] = 'f';
    for (int i = 0; i < CORNERS; i++)
        t.size += (size_t)sprintf(t.bytes + t.size, " %d", i + 1);
    read_whole(t, ".obj", CORNERS - 2, 1);
}

static void millions_of_groups(void **state)
{
    (void)state;
    enum { GROUPS = 1000000 };
    text t = {malloc(20 * GROUPS), 0};
    assert_non_null(t.bytes);
    t.size = (size_t)sprintf(t.bytes, TRIANGLE);
    for (int i = 0; i < GROUPS; i++)
        t.size += (size_t)sprintf(t.bytes + t.size, "g %x\nf 1 2 3\n", (unsigned)i);
    read_whole(t, ".obj", GROUPS, GROUPS);
}

static void long_names(void **state)
{
    (void)state;
    text words = repeat_line(TRIANGLE "g", " \xE9"), word = repeat_line(TRIANGLE "g ", "\xE9"),
         solid = repeat_line("solid ", "\xE9");
    append(&words, "\nf 1 2 3\n");
    append(&word, "\nf 1 2 3\n");
    append(&solid, "\nfacet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet endsolid");
    read_whole(words, ".obj", 1, 1);
    read_whole(word, ".obj", 1, 1);
    read_whole(solid, ".stl", 1, 1);
}

/* Corners that no other triangle has: none is welded to another. */
static void stl_of_loose_triangles(void **state)
{
    (void)state;
    enum { RECORD = 50 };
    text t = repeat("", (const char[RECORD]){0}, RECORD);
    uint32_t count = 0;
    t.bytes = realloc(t.bytes, t.size + 84);
    assert_non_null(t.bytes);
    memmove(t.bytes + 84, t.bytes, t.size);
    memset(t.bytes, 0, 84);
    for (char *at = t.bytes + 84; at < t.bytes + 84 + t.size; at += RECORD, count++) {
        const float n = (float)count, corners[9] = {n, 0, 0, n, 1, 0, n, 0, 1};
        memcpy(at + 12, corners, sizeof corners);
    }
    t.size += 84;
    memcpy(t.bytes + 80, &count, sizeof count);
    read_whole(t, ".stl", count, 1);
}

static void solids_without_triangles(void **state)
{
    (void)state;
    enum { SOLIDS = 400000 };
    text t = {malloc(40 * SOLIDS), 0};
    assert_non_null(t.bytes);
    for (int i = 0; i < SOLIDS; i++)
        t.size += (size_t)sprintf(t.bytes + t.size, "solid %x\nendsolid\n", (unsigned)i);
    refuse(t, ".stl", 10 * t.size + (64 << 20), "found no triangle");
}

#define PLY(type, count, corner, faces)                                                                                \
    "ply\nformat binary_little_endian 1.0\nelement vertex " count "\nproperty " type " x\nproperty " type              \
    " y\nproperty " type " z\nelement face " faces "\nproperty list uint " corner " vertex_indices\nend_header\n"

static void ply_of_small_types(void **state)
{
    (void)state;
    text vertices = repeat(PLY("uchar", "4000000", "uchar", "1"), "\1\2\3", 3);
    text fan = repeat(PLY("uchar", "0", "uchar", "1"), "\1\2\3", 3);
    refuse(vertices, ".ply", 10 * vertices.size + (64 << 20), too_many);
    refuse(fan, ".ply", 10 * fan.size + (64 << 20), "a corner that no vertex has");
    fan = repeat(PLY("uchar", "4", "uchar", "1") "0000000000001234", "\1\2\3", 3);
    refuse(fan, ".ply", 10 * fan.size + (64 << 20), too_many);
}

/* Nothing is set aside for what a header says there is. */
static void lying_counts(void **state)
{
    (void)state;
    const struct {
        const char *extension, *bytes;
        size_t size;
        const char *what;
    } lies[] = {
#define LIE(extension, bytes, what) {extension, bytes, sizeof bytes - 1, what}
        LIE(".ply", PLY("float", "4294967294", "uint", "4294967294"), "the end of the file"),
        LIE(".ply", PLY("uchar", "1", "uchar", "4294967294") "123\xFE\xFF\xFF\xFF\0\0\0\0", "the end of the file"),
        LIE(".ply",
            "ply\nformat ascii 1.0\nelement vertex 4294967294\nproperty float x\nproperty float y\nproperty float z\n"
            "element face 4294967294\nproperty list uint uint vertex_indices\nend_header\n0 0 0\n",
            "as many lines"),
    };
    for (size_t i = 0; i < sizeof lies / sizeof *lies; i++) {
        text t = {malloc(lies[i].size), lies[i].size};
        assert_non_null(t.bytes);
        memcpy(t.bytes, lies[i].bytes, t.size);
        refuse(t, lies[i].extension, 1 << 18, lies[i].what);
    }
    text stl = {calloc(1, 1084), 1084};
    assert_non_null(stl.bytes);
    memset(stl.bytes + 80, 0xFF, 4);
    refuse(stl, ".stl", 1 << 18, "bytes of binary STL");
}

/* What an atlas needs of such a file keeps to the limit by itself; the file has its own size of it. */
static void texture_of_few_bytes(void **state)
{
    (void)state;
    const char *const lines[] = {"vt 0\n", "f 1/1 2/1 3/1\n", "f 1 2 3 1 2 3 1 2 3\n"};
    for (int i = 0; i < 3; i++) {
        text t = repeat_line(TRIANGLE "vt 0\n", lines[i]);
        append(&t, "\n"); /* and the zero behind it */
        t.bytes[--t.size] = '\0';
        sp_texture texture;
        sp_error error = {0};
        cli_meter_start();
        bool good = sp_texture_read("texture.obj", t.bytes, t.size, &texture, &error);
        assert_true(cli_meter_peak() <= 9 * t.size + (64 << 20));
        assert_true(good == (i < 2));
        assert_true(good || error.kind == SP_ERROR_INPUT);
        if (good)
            sp_texture_free(&texture);
        free(t.bytes);
    }
}

static void *write_pipe(void *user)
{
    const text *t = user;
    FILE *file = fopen("mesh-memory-pipe.obj", "wb");
    bool good = file && fwrite(t->bytes, 1, t->size, file) == t->size;
    return file && fclose(file) == 0 && good ? user : NULL;
}

/* A pipe's length is not known beforehand. */
static void pipe_is_read_to_its_end(void **state)
{
    (void)state;
    text t = repeat_line(TRIANGLE "f 1 2 3\n", "v 1 2 3\n");
    sp_error error = {0};
    pthread_t writer;
    void *written;
    assert_int_equal(mkfifo("mesh-memory-pipe.obj", 0600), 0);
    assert_int_equal(pthread_create(&writer, NULL, write_pipe, &t), 0);
    cli_meter_start();
    sp_mesh *mesh = sp_mesh_load("mesh-memory-pipe.obj", 1, &error);
    size_t peak = cli_meter_peak();
    assert_int_equal(pthread_join(writer, &written), 0);
    assert_int_equal(remove("mesh-memory-pipe.obj"), 0);
    assert_non_null(written);
    assert_non_null(mesh);
    assert_int_equal(mesh->vertex_count, 4);
    assert_true(peak <= 10 * t.size + (64 << 20));
    sp_mesh_destroy(mesh);
    free(t.bytes);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(vertices_of_few_bytes),  cmocka_unit_test(triangles_of_few_bytes),
        cmocka_unit_test(fans_of_few_bytes),      cmocka_unit_test(polygon_of_many_corners),
        cmocka_unit_test(millions_of_groups),     cmocka_unit_test(long_names),
        cmocka_unit_test(stl_of_loose_triangles), cmocka_unit_test(solids_without_triangles),
        cmocka_unit_test(ply_of_small_types),     cmocka_unit_test(lying_counts),
        cmocka_unit_test(texture_of_few_bytes),   cmocka_unit_test(pipe_is_read_to_its_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
