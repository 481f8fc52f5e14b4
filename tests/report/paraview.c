/* What ParaView is given, read back, and the bodies of the nozzles. */
#include "exported.h"

typedef struct {
    exported e;
    char *bytes;
    size_t size;
    const char *data; /* where appended arrays begin */
} vtp_file;

static void read_vtp(vtp_file *f, export_writer *write)
{
    f->bytes = export_bytes(&f->e, write, BINARY_DIR "/paraview-test.vtp", &f->size);
    const char *mark = strstr(f->bytes, "<AppendedData encoding=\"raw\">\n_");
    assert_non_null(mark);
    f->data = strchr(mark, '_') + 1;
    assert_non_null(strstr(f->bytes, "byte_order=\"LittleEndian\" header_type=\"UInt64\""));
    static const char end[] = "\n</AppendedData>\n</VTKFile>\n";
    assert_memory_equal(f->bytes + f->size - strlen(end), end, strlen(end));
}

static void close_vtp(vtp_file *f)
{
    free(f->bytes);
    export_tear_down(&f->e);
}

/* The bytes of an array of `count` values. */
static const char *array_of(const vtp_file *f, const char *name, const char *type, size_t size)
{
    char start[100];
    snprintf(start, sizeof start, "<DataArray type=\"%s\" Name=\"%s\" ", type, name);
    const char *element = strstr(f->bytes, start);
    if (!element || element > f->data)
        fail_msg("no %s", start);
    size_t offset = strtoull(strstr(element, "offset=\"") + 8, NULL, 10);
    assert_true((size_t)(f->data - f->bytes) + offset + 8 + size < f->size);
    assert_int_equal(export_number(f->data + offset, 8), size);
    return f->data + offset + 8;
}

static size_t stated(const vtp_file *f, const char *key)
{
    const char *at = strstr(f->bytes, key);
    assert_non_null(at);
    return strtoull(at + strlen(key), NULL, 10);
}

static float float_at(const char *bytes)
{
    uint32_t bits = (uint32_t)export_number(bytes, 4);
    float value;
    memcpy(&value, &bits, 4);
    return value;
}

static double real_at(const char *bytes, size_t index)
{
    uint64_t bits = export_number(bytes + 8 * index, 8);
    double value;
    memcpy(&value, &bits, 8);
    return value;
}

static sp_vec3 place_at(const char *bytes, size_t index)
{
    return sp_v(real_at(bytes, 3 * index), real_at(bytes, 3 * index + 1), real_at(bytes, 3 * index + 2));
}

static int32_t whole_at(const char *bytes, size_t index)
{
    return (int32_t)(uint32_t)export_number(bytes + 4 * index, 4);
}

static void check_names(const vtp_file *f)
{
    static const char expected[] = "shell\0" EXPORTED_NAME_TOLD "\0shaft";
    assert_memory_equal(array_of(f, "part_names", "String", sizeof expected), expected, sizeof expected);
    assert_int_equal(stated(f, "NumberOfTuples=\""), 3);
}

/* To the bit, also far away and of those that are not the largest of a pixel. */
static void texels_are_the_patches(void **state)
{
    (void)state;
    vtp_file f;
    const sp_vec3 far = sp_v(1048576, -2097152, 4194304);
    export_set_up(&f.e, true, far, sp_transform_default());
    read_vtp(&f, sp_report_texels_vtp);
    const sp_patches *p = sp_evaluator_patches(f.e.evaluator);
    const sp_deposits *d = &f.e.coverage->deposits;
    const struct {
        const char *name;
        const double *values;
    } channels[] = {{"flux", d->flux},
                    {"jets", d->jets},
                    {"speed", d->speed},
                    {"speed_max", d->speed_max},
                    {"incidence", d->incidence},
                    {"incidence_min", d->incidence_min},
                    {"impact", d->impact},
                    {"impact_max", d->impact_max},
                    {"covered", d->share},
                    {"area", p->area},
                    {"film", d->film}};
    assert_true(stated(&f, "NumberOfPoints=\"") == p->count && stated(&f, "NumberOfVerts=\"") == p->count);
    for (size_t k = 0; k < sizeof channels / sizeof *channels; k++) {
        const char *bytes = array_of(&f, channels[k].name, "Float32", 4 * p->count);
        for (size_t i = 0; i < p->count; i++)
            assert_true(float_at(bytes + 4 * i) == (float)channels[k].values[i]);
    }
    const char *points = array_of(&f, "Points", "Float64", 24 * p->count);
    const char *normals = array_of(&f, "normal", "Float32", 12 * p->count);
    const char *part = array_of(&f, "part", "Int32", 4 * p->count), *side = array_of(&f, "side", "UInt8", p->count);
    const char *chart = array_of(&f, "chart", "Int32", 4 * p->count);
    const char *cells = array_of(&f, "connectivity", "Int32", 4 * p->count);
    const char *ends = array_of(&f, "offsets", "Int32", 4 * p->count);
    const sp_atlas *atlas = sp_evaluator_atlas(f.e.evaluator);
    size_t further = 0;
    for (size_t i = 0; i < p->count; i++) {
        assert_true(sp_distance(place_at(points, i), sp_add(p->point[i], far)) == 0);
        assert_true(float_at(normals + 12 * i) == (float)p->normal[i].x &&
                    float_at(normals + 12 * i + 8) == (float)p->normal[i].z);
        assert_int_equal(whole_at(part, i), f.e.mesh->part[p->triangle[i]]);
        assert_int_equal(side[i], p->side[i]);
        assert_int_equal(whole_at(chart, i), sp_atlas_place(atlas, p->texel[i]).chart);
        assert_true(whole_at(cells, i) == (int32_t)i && whole_at(ends, i) == (int32_t)i + 1);
        further += p->texel[i] >= atlas->pixel_count;
    }
    assert_true(further > 0);
    check_names(&f);
    close_vtp(&f);
}

typedef struct {
    const char *points, *corners, *part, *side, *area, *covered, *flux, *speed, *incidence;
    size_t count;
} cells;

static cells cells_of(const vtp_file *f)
{
    size_t count = stated(f, "NumberOfPolys=\"");
    return (cells){.points = array_of(f, "Points", "Float64", 24 * stated(f, "NumberOfPoints=\"")),
                   .corners = array_of(f, "connectivity", "Int32", 12 * count),
                   .part = array_of(f, "part", "Int32", 4 * count),
                   .side = array_of(f, "side", "UInt8", count),
                   .area = array_of(f, "area", "Float32", 4 * count),
                   .covered = array_of(f, "covered", "Float32", 4 * count),
                   .flux = array_of(f, "flux", "Float32", 4 * count),
                   .speed = array_of(f, "speed", "Float32", 4 * count),
                   .incidence = array_of(f, "incidence", "Float32", 4 * count),
                   .count = count};
}

/* What lies on all triangles is what lies on all patches. */
static void check_sums(const vtp_file *f, const cells *c)
{
    const sp_patches *p = sp_evaluator_patches(f->e.evaluator);
    const sp_deposits *d = &f->e.coverage->deposits;
    double expected[5] = {0}, found[5] = {0};
    for (size_t i = 0; i < p->count; i++) {
        const double liquid = d->flux[i] * p->area[i];
        const double values[5] = {p->area[i], d->share[i] * p->area[i], liquid, d->speed[i] * liquid,
                                  d->incidence[i] * liquid};
        for (int k = 0; k < 5; k++)
            expected[k] += values[k];
    }
    for (size_t i = 0; i < c->count; i++) {
        double area = (double)float_at(c->area + 4 * i), liquid = area * (double)float_at(c->flux + 4 * i);
        const double values[5] = {area, area * (double)float_at(c->covered + 4 * i), liquid,
                                  liquid * (double)float_at(c->speed + 4 * i),
                                  liquid * (double)float_at(c->incidence + 4 * i)};
        if (!(area > 0)) {
            assert_true(isnan(values[1]) && isnan(values[2]) && isnan(values[3]) && isnan(values[4]));
            continue;
        }
        for (int k = 0; k < 5; k++)
            found[k] += values[k];
    }
    for (int k = 0; k < 5; k++)
        assert_true(expected[k] > 0 && fabs(found[k] - expected[k]) < 1e-6 * expected[k]);
}

/* Every cell is a wet side of a triangle of its part, anticlockwise seen from there. */
static void check_cells(const vtp_file *f, const cells *c, bool cavity)
{
    size_t sides = 0, inwards = 0, shell = 0;
    for (uint32_t t = 0; t < f->e.mesh->triangle_count; t++) {
        unsigned wet = sp_evaluator_wet(f->e.evaluator, t);
        sides += cavity ? (wet & 1) + (wet >> 1 & 1) : 1;
    }
    assert_int_equal(c->count, sides);
    for (size_t i = 0; i < c->count; i++) {
        sp_vec3 corner[3];
        for (size_t k = 0; k < 3; k++)
            corner[k] = place_at(c->points, (size_t)whole_at(c->corners, 3 * i + k));
        sp_vec3 normal = sp_cross(sp_sub(corner[1], corner[0]), sp_sub(corner[2], corner[0]));
        sp_vec3 middle = sp_v(0, 0, TANK_HEIGHT / 2);
        assert_true(cavity ? c->side[i] == SP_SIDE_BACK || (c->side[i] == SP_SIDE_FRONT && whole_at(c->part, i) > 0)
                           : c->side[i] == SP_SIDE_BOTH);
        shell += whole_at(c->part, i) == 0;
        inwards += whole_at(c->part, i) == 0 && sp_dot(normal, sp_sub(middle, corner[0])) > 0;
        assert_true(whole_at(c->part, i) < 2 || !(float_at(c->area + 4 * i) > 0)); /* the shaft is not cleaned */
    }
    assert_true(shell > 0 && inwards == (cavity ? shell : 0));
}

static void the_surface_holds_what_the_patches_hold(void **state)
{
    (void)state;
    for (int cavity = 0; cavity < 2; cavity++) {
        vtp_file f;
        export_set_up(&f.e, cavity, sp_v(0, 0, 0), sp_transform_default());
        read_vtp(&f, sp_report_surface_vtp);
        check_names(&f);
        cells c = cells_of(&f);
        check_sums(&f, &c);
        check_cells(&f, &c, cavity);
        close_vtp(&f);
    }
}

/* In millimetres of a file that the scene turns, moves and scales; closed, facing outwards, tips at the nozzles. */
static void bodies_fit_the_first_file(void **state)
{
    (void)state;
    exported e;
    sp_transform file = sp_transform_default();
    sp_transform_rotation(&file, sp_v(1, 2, 3), 0.8);
    file.translate = sp_v(0.5, -3, 2);
    file.scale = 2e-3;
    export_set_up(&e, true, sp_v(16, 0, 0), file);
    size_t size, each = 64;
    char *bytes = export_bytes(&e, sp_report_nozzles_stl, BINARY_DIR "/paraview-test.stl", &size);
    assert_int_equal(export_number(bytes + 80, 4), each * e.layout->count);
    assert_int_equal(size, 84 + 50 * each * e.layout->count);
    assert_non_null(strstr(bytes, "1 is 0.002 m"));
    assert_true(strncmp(bytes, "solid", 5) != 0);
    for (size_t n = 0; n < e.layout->count; n++) {
        const sp_nozzle *nozzle = &e.layout->nozzles[n];
        double volume = 0, nearest = INFINITY, length = 0;
        for (size_t t = 0; t < each; t++) {
            sp_vec3 v[4];
            for (size_t k = 0; k < 4; k++) {
                const char *at = bytes + 84 + 50 * (n * each + t) + 12 * k;
                v[k] = sp_v((double)float_at(at), (double)float_at(at + 4), (double)float_at(at + 8));
                if (k == 0)
                    continue;
                v[k] = sp_sub(sp_transform_point(&file, v[k]), sp_v(16, 0, 0));
                nearest = fmin(nearest, sp_distance(v[k], nozzle->position));
                length = fmax(length, sp_dot(sp_sub(nozzle->position, v[k]), nozzle->axis));
            }
            volume += sp_dot(v[1], sp_cross(v[2], v[3])) / 6;
            assert_true(fabs(sp_length(v[0]) - 1) < 1e-5);
        }
        sp_vec3 low, high;
        assert_true(nearest < 1e-5);
        assert_true(fabs(length - sp_mesh_box(e.mesh, &low, &high) / 50) < 1e-5);
        assert_true(volume > 0);
    }
    free(bytes);
    export_tear_down(&e);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(texels_are_the_patches),
        cmocka_unit_test(the_surface_holds_what_the_patches_hold),
        cmocka_unit_test(bodies_fit_the_first_file),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
