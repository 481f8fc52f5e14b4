#include "vtp.h"

#include "result/growing_text.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const struct {
    const char *name;
    size_t size;
} types[] = {[SP_VTP_UINT8] = {"UInt8", 1},
             [SP_VTP_INT32] = {"Int32", 4},
             [SP_VTP_FLOAT32] = {"Float32", 4},
             [SP_VTP_FLOAT64] = {"Float64", 8}};

/* One array, as the file says it and then as it holds it. */
typedef struct {
    sp_vtp_array array;
    const void *of;
    size_t count;
} block;

typedef struct {
    sp_text xml;
    uint64_t offset; /* of the next array's bytes */
    FILE *file;
    int cause; /* of the first failure to write, as errno; 0: none */
} stream;

static void put_bytes(stream *s, const char *bytes, size_t size)
{
    if (!s->cause && fwrite(bytes, 1, size, s->file) != size)
        s->cause = errno;
}

static double corner_of(const void *of, int which, size_t index, int component)
{
    const sp_vtp *vtp = of;
    (void)component;
    return which ? vtp->triangles[index / 3][index % 3] : (double)index;
}

/* VTK tells where each cell ends, not where it begins. */
static double end_of(const void *of, int corners, size_t index, int component)
{
    (void)of;
    (void)component;
    return (double)corners * (double)(index + 1);
}

static void put(stream *s, uint64_t bits, size_t size)
{
    char little[8];
    for (size_t k = 0; k < size; ++k)
        little[k] = (char)(bits >> (8 * k) & 0xff);
    put_bytes(s, little, size);
}

static void put_value(stream *s, sp_vtp_type type, double value)
{
    float single = (float)value;
    uint32_t single_bits;
    uint64_t bits;
    memcpy(&single_bits, &single, sizeof single_bits);
    memcpy(&bits, &value, sizeof bits);
    put(s, type == SP_VTP_FLOAT64 ? bits : type == SP_VTP_FLOAT32 ? single_bits : (uint64_t)value, types[type].size);
}

static uint64_t size_of(const block *b)
{
    return (uint64_t)b->count * (uint64_t)b->array.components * types[b->array.type].size;
}

static void declare(stream *s, const block *b)
{
    sp_text_add(&s->xml,
                "<DataArray type=\"%s\" Name=\"%s\" NumberOfComponents=\"%d\" format=\"appended\" "
                "offset=\"%llu\"/>\n",
                types[b->array.type].name, b->array.name, b->array.components, (unsigned long long)s->offset);
    s->offset += 8 + size_of(b);
}

static void put_block(stream *s, const block *b)
{
    put(s, size_of(b), 8);
    for (size_t i = 0; i < b->count; ++i)
        for (int k = 0; k < b->array.components; ++k)
            put_value(s, b->array.type, b->array.value(b->of, b->array.which, i, k));
}

/* One after the other, each with the zero at its end: no name can be mistaken for XML. */
static bool join_names(const sp_mesh *mesh, sp_text *names)
{
    for (size_t i = 0; i < mesh->part_count && !names->failed; ++i) {
        char *name = sp_text_utf8(mesh->parts[i].name);
        if (!name)
            return false;
        sp_text_append(names, name, strlen(name) + 1);
        free(name);
    }
    return !names->failed;
}

static void declare_names(stream *s, const sp_vtp *vtp, const sp_text *names)
{
    sp_text_add(&s->xml,
                "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
                "header_type=\"UInt64\">\n<PolyData>\n<FieldData>\n<DataArray type=\"String\" Name=\"part_names\" "
                "NumberOfTuples=\"%zu\" format=\"appended\" offset=\"0\"/>\n</FieldData>\n",
                vtp->mesh->part_count);
    s->offset = 8 + names->length;
}

/* The blocks: points, corners and ends of the cells, then the data. */
static void declare_all(stream *s, const sp_vtp *vtp, const block *blocks)
{
    bool cells = vtp->triangles != NULL;
    const char *kind = cells ? "Polys" : "Verts", *data = cells ? "CellData" : "PointData";
    sp_text_add(&s->xml,
                "<Piece NumberOfPoints=\"%zu\" NumberOfVerts=\"%zu\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
                "NumberOfPolys=\"%zu\">\n<Points>\n",
                vtp->point_count, cells ? 0 : vtp->point_count, cells ? vtp->triangle_count : 0);
    declare(s, &blocks[0]);
    sp_text_add(&s->xml, "</Points>\n<%s>\n", kind);
    declare(s, &blocks[1]);
    declare(s, &blocks[2]);
    sp_text_add(&s->xml, "</%s>\n<%s Scalars=\"covered\">\n", kind, data);
    for (size_t i = 0; i < vtp->array_count; ++i)
        declare(s, &blocks[3 + i]);
    sp_text_add(&s->xml, "</%s>\n</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_", data);
}

static void list_blocks(const sp_vtp *vtp, block *blocks)
{
    bool cells = vtp->triangles != NULL;
    int corners = cells ? 3 : 1;
    size_t count = cells ? vtp->triangle_count : vtp->point_count;
    blocks[0] = (block){{"Points", SP_VTP_FLOAT64, 3, vtp->point, 0}, vtp->of, vtp->point_count};
    blocks[1] = (block){{"connectivity", SP_VTP_INT32, 1, corner_of, cells}, vtp, (size_t)corners * count};
    blocks[2] = (block){{"offsets", SP_VTP_INT32, 1, end_of, corners}, vtp, count};
    for (size_t i = 0; i < vtp->array_count; ++i)
        blocks[3 + i] = (block){vtp->arrays[i], vtp->of, count};
}

static bool write_file(stream *s, const sp_vtp *vtp, const block *blocks, const sp_text *names, const char *path,
                       sp_error *error)
{
    static const char end[] = "\n</AppendedData>\n</VTKFile>\n";
    s->file = fopen(path, "wb");
    if (!s->file)
        return sp_fail(error, SP_ERROR_FILE, path, 0, 0, "cannot be written: %s", strerror(errno));
    put_bytes(s, s->xml.text, s->xml.length);
    put(s, names->length, 8);
    put_bytes(s, names->text, names->length);
    for (size_t i = 0; i < 3 + vtp->array_count && !s->cause; ++i)
        put_block(s, &blocks[i]);
    put_bytes(s, end, strlen(end));
    if (fclose(s->file) != 0 && !s->cause)
        s->cause = errno;
    return !s->cause || sp_fail(error, SP_ERROR_FILE, path, 0, 0, "cannot be written: %s", strerror(s->cause));
}

bool sp_vtp_write(const sp_vtp *vtp, const char *path, sp_error *error)
{
    if (vtp->point_count > INT32_MAX || vtp->triangle_count > INT32_MAX / 3)
        return sp_fail(error, SP_ERROR_INPUT, path, 0, 0, "%zu points and %zu triangles are too many for this file",
                       vtp->point_count, vtp->triangle_count);
    block *blocks = calloc(3 + vtp->array_count, sizeof *blocks);
    sp_text names = {0};
    stream s = {0};
    bool done = blocks && join_names(vtp->mesh, &names);
    if (done) {
        list_blocks(vtp, blocks);
        declare_names(&s, vtp, &names);
        declare_all(&s, vtp, blocks);
    }
    if (!done || s.xml.failed)
        done = sp_fail_memory(error) != NULL;
    else
        done = write_file(&s, vtp, blocks, &names, path, error);
    free(s.xml.text);
    free(names.text);
    free(blocks);
    return done;
}
