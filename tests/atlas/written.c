/* What stands in the OBJ that is written, and nothing else: charts apart, none over another, lengths kept; and that the
 * file's own texture coordinates are taken back as they are, or refused for what they break. */
#include "shapes.h"

#include <stdio.h>
#include <unistd.h>

/* A file as any reader sees it. A "side" is a triangle's corner's texture coordinate. */
typedef struct {
    size_t v_count, vt_count, f_count, page_count, edge;
    double (*v)[3], (*vt)[2], texel;
    unsigned (*corner)[3], (*side)[3], *page, *island;
} written;

static written parse(const char *text)
{
    size_t length = strlen(text);
    written w = {.v = malloc(length * sizeof *w.v / 4), .vt = malloc(length * sizeof *w.vt / 4)};
    w.corner = malloc(length * sizeof *w.corner / 8);
    w.side = malloc(length * sizeof *w.side / 8);
    w.page = malloc(length * sizeof *w.page / 8);
    unsigned page = 0;
    for (const char *line = text; *line; line = strchr(line, '\n') + 1) {
        unsigned *c = w.corner[w.f_count], *s = w.side[w.f_count];
        double *v = w.v[w.v_count], *vt = w.vt[w.vt_count];
        if (line[0] == '#')
            assert_int_equal(sscanf(strstr(line, "texel: "), "texel: %zu %lf", &w.edge, &w.texel), 2);
        else if (strncmp(line, "v ", 2) == 0)
            w.v_count += sscanf(line, "v %lf %lf %lf", &v[0], &v[1], &v[2]) == 3;
        else if (strncmp(line, "vt ", 3) == 0)
            w.vt_count += sscanf(line, "vt %lf %lf", &vt[0], &vt[1]) == 2;
        else if (strncmp(line, "usemtl", 6) == 0)
            assert_int_equal(sscanf(line, "usemtl page_%u", &page), 1);
        else if (line[0] == 'f') {
            assert_int_equal(sscanf(line, "f %u/%u %u/%u %u/%u", &c[0], &s[0], &c[1], &s[1], &c[2], &s[2]), 6);
            for (int i = 0; i < 3; i++) {
                c[i]--;
                s[i]--;
            }
            w.page[w.f_count++] = page;
            w.page_count = page >= w.page_count ? page + 1 : w.page_count;
        }
    }
    return w;
}

static void forget(written *w)
{
    free(w->v);
    free(w->vt);
    free(w->corner);
    free(w->side);
    free(w->page);
    free(w->island);
}

static unsigned root_of(unsigned *root, unsigned i)
{
    while (root[i] != i)
        i = root[i] = root[root[i]];
    return i;
}

/* Islands are joined through shared texture coordinates. */
static void find_islands(written *w)
{
    unsigned *root = malloc((w->vt_count + 1) * sizeof *root);
    for (unsigned i = 0; i < w->vt_count; i++)
        root[i] = i;
    for (size_t f = 0; f < w->f_count; f++)
        for (int i = 1; i < 3; i++)
            root[root_of(root, w->side[f][i])] = root_of(root, w->side[f][0]);
    w->island = malloc((w->f_count + 1) * sizeof *w->island);
    for (size_t f = 0; f < w->f_count; f++)
        w->island[f] = root_of(root, w->side[f][0]) + 1;
    free(root);
}

static void in_pixels(const written *w, size_t f, double p[3][2])
{
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 2; k++)
            p[i][k] = w->vt[w->side[f][i]][k] * (double)w->edge;
}

static double twice_area(const double p[3][2])
{
    return (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
}

/* Whether a closed triangle reaches into a closed square, both a little enlarged. */
static bool touches(const double p[3][2], double x, double y)
{
    const double slack = 1e-9, corner[4][2] = {{x, y}, {x + 1, y}, {x, y + 1}, {x + 1, y + 1}};
    for (int k = 0; k < 2; k++)
        if (fmax(p[0][k], fmax(p[1][k], p[2][k])) < corner[0][k] - slack ||
            fmin(p[0][k], fmin(p[1][k], p[2][k])) > corner[3][k] + slack)
            return false;
    for (int i = 0; i < 3; i++) {
        double dx = p[(i + 1) % 3][0] - p[i][0], dy = p[(i + 1) % 3][1] - p[i][1];
        int outside = 0;
        for (int c = 0; c < 4; c++)
            outside += dy * (corner[c][0] - p[i][0]) - dx * (corner[c][1] - p[i][1]) > slack * hypot(dx, dy);
        if (outside == 4)
            return false;
    }
    return true;
}

/* The area that two convex polygons share: one is cut by the other's edges. */
static double shared_area(const double a[3][2], const double b[3][2])
{
    double poly[12][2], next[12][2];
    int count = 3;
    memcpy(poly, a, 3 * sizeof *poly);
    for (int i = 0; i < 3; i++) {
        double dx = b[(i + 1) % 3][0] - b[i][0], dy = b[(i + 1) % 3][1] - b[i][1];
        int kept = 0;
        for (int k = 0; k < count; k++) {
            const double *p = poly[k], *q = poly[(k + 1) % count];
            double dp = dx * (p[1] - b[i][1]) - dy * (p[0] - b[i][0]);
            double dq = dx * (q[1] - b[i][1]) - dy * (q[0] - b[i][0]);
            if (dp >= 0)
                memcpy(next[kept++], p, sizeof *next);
            if ((dp > 0 && dq < 0) || (dp < 0 && dq > 0)) {
                next[kept][0] = p[0] + dp / (dp - dq) * (q[0] - p[0]);
                next[kept++][1] = p[1] + dp / (dp - dq) * (q[1] - p[1]);
            }
        }
        memcpy(poly, next, sizeof poly);
        count = kept;
    }
    double twice = 0;
    for (int k = 2; k < count; k++)
        twice += (poly[k - 1][0] - poly[0][0]) * (poly[k][1] - poly[0][1]) -
                 (poly[k - 1][1] - poly[0][1]) * (poly[k][0] - poly[0][0]);
    return 0.5 * twice;
}

/* Counts what breaks the rules on one page. `first` and `next` list the triangles that touch each pixel. */
static void inspect_page(const written *w, unsigned page, size_t *shared, size_t *foreign, size_t *overlaps)
{
    size_t edge = w->edge, listed = 0, room = 1 << 16;
    unsigned *first = calloc(edge * edge, sizeof *first), (*list)[2] = malloc(room * sizeof *list);
    for (size_t f = 0; f < w->f_count; f++) {
        double p[3][2];
        in_pixels(w, f, p);
        if (w->page[f] != page || twice_area((const double(*)[2])p) == 0)
            continue;
        size_t right = (size_t)fmin((double)edge - 1, fmax(p[0][0], fmax(p[1][0], p[2][0])));
        size_t top = (size_t)fmin((double)edge - 1, fmax(p[0][1], fmax(p[1][1], p[2][1])));
        for (size_t y = (size_t)fmin(p[0][1], fmin(p[1][1], p[2][1])); y <= top; y++)
            for (size_t x = (size_t)fmin(p[0][0], fmin(p[1][0], p[2][0])); x <= right; x++) {
                if (!touches((const double(*)[2])p, (double)x, (double)y))
                    continue;
                for (unsigned i = first[y * edge + x]; i; i = list[i][1]) {
                    double q[3][2];
                    in_pixels(w, list[i][0], q);
                    double least =
                        0.5 * fmin(fabs(twice_area((const double(*)[2])p)), fabs(twice_area((const double(*)[2])q)));
                    *overlaps += shared_area((const double(*)[2])p, (const double(*)[2])q) > 0.02 * least + 1e-9;
                }
                if (++listed == room)
                    list = realloc(list, (room *= 2) * sizeof *list);
                list[listed][0] = (unsigned)f;
                list[listed][1] = first[y * edge + x];
                first[y * edge + x] = (unsigned)listed;
            }
    }
    for (size_t y = 0; y < edge; y++)
        for (size_t x = 0; x < edge; x++) {
            if (!first[y * edge + x])
                continue;
            unsigned island = w->island[list[first[y * edge + x]][0]];
            for (unsigned i = first[y * edge + x]; i; i = list[i][1])
                *shared += w->island[list[i][0]] != island;
            for (size_t b = y - (y > 0); b <= y + 1 && b < edge; b++)
                for (size_t a = x - (x > 0); a <= x + 1 && a < edge; a++)
                    *foreign += first[b * edge + a] && w->island[list[first[b * edge + a]][0]] != island;
        }
    free(first);
    free(list);
}

/* Areas, pages and islands as they stand in the file. */
static void expect_sound_text(const char *text, const sp_atlas *atlas, const sp_mesh *mesh)
{
    written w = parse(text);
    find_islands(&w);
    assert_int_equal(w.f_count, mesh->source_triangle_count);
    assert_int_equal(w.page_count, atlas->page_count);
    double flat = 0, surface = 0, strained = 0;
    for (size_t f = 0; f < w.f_count; f++) {
        double p[3][2];
        in_pixels(&w, f, p);
        sp_vec3 c[3];
        for (int i = 0; i < 3; i++)
            c[i] = sp_v(w.v[w.corner[f][i]][0], w.v[w.corner[f][i]][1], w.v[w.corner[f][i]][2]);
        double area = 0.5 * sp_length(sp_cross(sp_sub(c[1], c[0]), sp_sub(c[2], c[0])));
        bool bent = false;
        for (int i = 0; i < 3; i++) {
            int j = (i + 1) % 3;
            double length = sp_distance(c[i], c[j]), laid = w.texel * hypot(p[j][0] - p[i][0], p[j][1] - p[i][1]);
            bent = bent || fabs(laid / length - 1) > 0.0501;
        }
        surface += area;
        strained += bent ? area : 0;
        flat += 0.5 * twice_area((const double(*)[2])p) * w.texel * w.texel;
        assert_true(twice_area((const double(*)[2])p) >= 0);
    }
    assert_true(fabs(flat / surface - 1) < 0.02);
    assert_true(strained <= 0.0501 * surface);
    size_t shared = 0, foreign = 0, overlaps = 0;
    for (unsigned page = 0; page < w.page_count; page++)
        inspect_page(&w, page, &shared, &foreign, &overlaps);
    assert_int_equal(shared, 0);
    assert_int_equal(foreign, 0);
    assert_int_equal(overlaps, 0);
    forget(&w);
}

static const char *const scratch = BINARY_DIR "/atlas-written.obj";

static void write_scratch(const char *text)
{
    FILE *file = fopen(scratch, "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
}

/* Reads the file back; its coordinates give the same bytes again. */
static void expect_taken_back(const char *text)
{
    write_scratch(text);
    sp_error error = {0};
    sp_mesh *mesh = sp_mesh_load(scratch, 1, &error);
    sp_atlas *atlas = sp_atlas_reuse(mesh, scratch, 0, &error);
    if (!atlas)
        fail_msg("%s:%d: %s", error.file, error.line, error.message);
    assert_true(figures_of(atlas, mesh).area_error <= 1e-12);
    char *again = sp_atlas_obj(atlas, mesh, &error);
    assert_string_equal(again, text);
    free(again);
    sp_atlas_destroy(atlas);
    sp_mesh_destroy(mesh);
    unlink(scratch);
}

static void expect_sound_file(const sp_mesh *mesh, double texel, uint32_t page_edge, sp_packing packing)
{
    sp_error error = {0};
    sp_charts *charts = charts_of(mesh, texel * (page_edge ? page_edge : 4096));
    sp_atlas_options options = {.texel = texel, .page_edge = page_edge, .packing = packing};
    sp_atlas *atlas = sp_atlas_create(mesh, charts, &options, &error);
    if (!atlas)
        fail_msg("%s", error.message);
    char *text = sp_atlas_obj(atlas, mesh, &error);
    assert_non_null(text);
    expect_sound_text(text, atlas, mesh);
    expect_taken_back(text);
    free(text);
    sp_atlas_destroy(atlas);
    sp_charts_destroy(charts);
}

static void shapes_stand_sound_in_the_file(void **state)
{
    (void)state;
    sp_mesh *meshes[] = {box(1, 2, 3),
                         net(64, 16, on_cylinder, 1),
                         net(48, 12, on_cone, 1),
                         net(40, 20, on_sphere, 1),
                         net(24, 24, on_saddle, 1),
                         net(40, 20, on_sphere, 1e-5),
                         net(60, 12, on_strip, 1),
                         net(60, 16, on_two_tubes, 0.5)};
    for (int i = 0; i < 8; i++) {
        double size = i == 5 ? 1e-5 : 1;
        expect_sound_file(meshes[i], 0.02 * size, 0, SP_PACKING_PIXELS);
        expect_sound_file(meshes[i], 0.0173 * size, 0, SP_PACKING_SKYLINE);
        expect_sound_file(meshes[i], 0.05 * size, 100, SP_PACKING_PIXELS); /* several pages */
        expect_sound_file(meshes[i], 0.5 * size, 0, SP_PACKING_PIXELS);    /* charts of few pixels */
        sp_mesh_destroy(meshes[i]);
    }
}

/* Of a name that OBJ cannot say what it can is written: a backslash at the end would swallow the line behind it. */
static void names_that_obj_cannot_say_do_no_harm(void **state)
{
    (void)state;
    sp_error error = {0};
    sp_mesh *mesh = net(24, 24, on_saddle, 1);
    free(mesh->parts[0].name);
    mesh->parts[0].name = strdup("#1 shell #2 a#b \\");
    sp_charts *charts = charts_of(mesh, 0.05 * 100);
    sp_atlas_options options = {.texel = 0.05, .page_edge = 100};
    sp_atlas *atlas = sp_atlas_create(mesh, charts, &options, &error);
    char *text = sp_atlas_obj(atlas, mesh, &error);
    assert_non_null(strstr(text, "\ng _1 shell _2 a#b _\n"));
    expect_taken_back(text);
    free(text);
    sp_atlas_destroy(atlas);
    sp_charts_destroy(charts);
    sp_mesh_destroy(mesh);
}

static void expect_sound_data(const char *name)
{
    char path[1024];
    snprintf(path, sizeof path, DATA_DIR "/%s", name);
    if (access(path, R_OK) != 0) {
        print_message("skipped: %s is not there\n", path);
        skip();
    }
    sp_error error = {0};
    sp_mesh *mesh = sp_mesh_load(path, 1, &error);
    assert_non_null(mesh);
    expect_sound_file(mesh, sqrt(sp_mesh_area(mesh) / 30000), 0, SP_PACKING_PIXELS);
    sp_mesh_destroy(mesh);
}

static void beetle_stands_sound_in_the_file(void **state)
{
    (void)state;
    expect_sound_data("beetle.obj"); /* open and non-manifold */
}

static void elephant_stands_sound_in_the_file(void **state)
{
    (void)state;
    expect_sound_data("elephant.obj");
}

/* By their pixels charts lie closer than by their boxes. */
static void pages_are_used(void **state)
{
    (void)state;
    sp_mesh *sphere = net(60, 30, on_sphere, 1);
    sp_charts *charts = charts_of(sphere, 2);
    double used[2];
    for (int k = 0; k < 2; k++) {
        sp_atlas *atlas = sp_atlas_create(
            sphere, charts, &(sp_atlas_options){.texel = 0.006, .packing = k ? SP_PACKING_SKYLINE : 0}, NULL);
        used[k] = figures_of(atlas, sphere).utilisation;
        sp_atlas_destroy(atlas);
    }
    print_message("sphere: %.3f by pixels, %.3f by boxes\n", used[0], used[1]);
    assert_true(used[0] > used[1] && used[0] > 0.55);
    sp_charts_destroy(charts);
    sp_mesh_destroy(sphere);
}

static sp_vec3 on_thin_ring(double s, double t, double size)
{
    double around = 2 * acos(-1) * s, across = 2 * acos(-1) * t, from = size * (1 + 0.05 * cos(across));
    return sp_v(from * cos(around), from * sin(around), 0.05 * size * sin(across));
}

/* Six equal squares leave a third of a page; a thin ring's strips are not strung together to rings as wide as it. */
static void charts_suit_the_page(void **state)
{
    (void)state;
    const struct {
        sp_mesh *mesh;
        double size, least;
    } pieces[] = {{box(1, 1, 1), 2.45, 0.62}, {box(3, 2, 1), 4.7, 0.6}, {net(200, 16, on_thin_ring, 1), 1.4, 0.5}};
    for (size_t i = 0; i < sizeof pieces / sizeof *pieces; i++) {
        sp_charts *charts = charts_of(pieces[i].mesh, 1000);
        sp_atlas *atlas =
            sp_atlas_create(pieces[i].mesh, charts, &(sp_atlas_options){.texel = pieces[i].size / 500}, NULL);
        double used = figures_of(atlas, pieces[i].mesh).utilisation;
        print_message("%zu: %zu charts, %.3f used\n", i, charts->chart_count, used);
        assert_true(used > pieces[i].least);
        sp_atlas_destroy(atlas);
        sp_charts_destroy(charts);
        sp_mesh_destroy(pieces[i].mesh);
    }
}

static const char *const two_triangles = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 5\nv 1 0 5\nv 0 1 5\n";

/* The coordinates of two triangles with legs of 1 m on a page of 2.5 m, the faces, and what is wrong with them. */
static void refuses_what_breaks_an_atlas(void **state)
{
    (void)state;
    static const struct {
        const char *rest, *complaint;
        int line;
    } files[] = {
        {"vt .05 .05\nvt .45 .05\nvt .05 .45\nvt .55 .55\nvt .95 .55\nvt .55 .95\nf 1/1 2/2 3/3\nf 4/4 5/5 6/6\n", NULL,
         0},
        {"vt .05 .05\nvt .45 .05\nvt .05 .45\nf 1/1 2/2 3/3\nf 4 5 6\n", "without texture coordinates", 11},
        {"vt .05 .05\nvt .45 .05\nvt .05 .45\nvt .75 .55\nvt 1.15 .55\nvt .75 .95\nf 1/1 2/2 3/3\nf 4/4 5/5 6/6\n",
         "off the page", 14},
        {"vt .05 .05\nvt .45 .05\nvt .05 .45\nvt .55 .55\nvt .55 .95\nvt .95 .55\nf 1/1 2/2 3/3\nf 4/4 5/5 6/6\n",
         "turned over", 14},
        {"vt .05 .05\nvt .45 .05\nvt .05 .45\nvt .10 .10\nvt .50 .10\nvt .10 .50\nf 1/1 2/2 3/3\nf 4/4 5/5 6/6\n",
         "lies on another", 14},
        {"vt .05 .05\nvt .45 .05\nvt .05 .45\nvt .50 .55\nvt .98 .55\nvt .50 .95\nf 1/1 2/2 3/3\nf 4/4 5/5 6/6\n",
         "lengths", 14},
        {"vt .05 .05\nvt .45 .05\nvt .05 .45\nvt .4501 .05\nvt .8501 .05\nvt .4501 .45\nf 1/1 2/2 3/3\nf 4/4 5/5 6/6\n",
         "without a pixel between", 14},
        {"v 1 0 0\nv 0 1 0\nv -1 0 0\nv 0 -1 0\nv 0 0 1\nv .6 .8 0\nvt .5 .5\nvt .9 .5\nvt .5 .9\nvt .1 .5\nvt .5 .1\n"
         "f 1/1 2/2 3/3\nf 1/1 3/3 9/4\nf 1/1 9/4 10/5\nf 1/1 10/5 11/2\nf 1/1 11/2 12/3\n",
         "overlaps", 22},
        {"usemtl wood\nvt .05 .05\nvt .45 .05\nvt .05 .45\nf 1/1 2/2 3/3\nf 4/1 5/2 6/3\n", "page_0", 7},
        {"vt .05 .05\nvt .45 .05\nvt .05 .45\nf 1/1 2/2 3/3\nusemtl page_9\nf 4/1 5/2 6/3\n", "10 pages", 0},
        {"vt .05 .05\nvt .45 .05\nvt .05 .45\nf 1/1 2/2 3/3\nusemtl page_1\nf 4/1 5/2 6/3\n", NULL, 0},
    };
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        char text[1024];
        snprintf(text, sizeof text, "%s%s", two_triangles, files[i].rest);
        write_scratch(text);
        sp_error error = {0};
        sp_mesh *mesh = sp_mesh_load(scratch, 1, &error);
        assert_non_null(mesh);
        sp_atlas *atlas = sp_atlas_reuse(mesh, scratch, 0.1, &error);
        if (files[i].complaint) {
            assert_null(atlas);
            if (!strstr(error.message, files[i].complaint) || error.line != files[i].line)
                fail_msg("file %zu: line %d: %s", i, error.line, error.message);
            assert_int_equal(error.kind, SP_ERROR_INPUT);
            assert_string_equal(error.file, scratch);
        } else {
            if (!atlas)
                fail_msg("file %zu: %s", i, error.message);
            assert_int_equal(atlas->chart_count, 2);
            assert_int_equal(atlas->page_edge, 25);
            assert_true(fabs(atlas->texel - 0.1) < 1e-12);
        }
        sp_atlas_destroy(atlas);
        sp_mesh_destroy(mesh);
        unlink(scratch);
    }
}

/* 25 mm between two charts: no pixel of 100 mm, nor one of 50 or 25 mm wherever it begins. */
static void goes_below_too_long_a_texel(void **state)
{
    (void)state;
    char text[1024];
    snprintf(text, sizeof text, "%s%s", two_triangles,
             "vt .05 .05\nvt .45 .05\nvt .05 .45\nvt .46 .05\nvt .86 .05\nvt .46 .45\nf 1/1 2/2 3/3\nf 4/4 5/5 6/6\n");
    write_scratch(text);
    sp_error error = {0};
    sp_mesh *mesh = sp_mesh_load(scratch, 1, &error);
    assert_non_null(mesh);
    sp_atlas *atlas = sp_atlas_reuse(mesh, scratch, 0.1, &error);
    assert_non_null(atlas);
    assert_int_equal(atlas->chart_count, 2);
    assert_true(atlas->texel <= 0.025 * (1 + 1e-12) && atlas->texel > 0.1 / 16);
    sp_atlas_destroy(atlas);
    sp_mesh_destroy(mesh);
    unlink(scratch);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shapes_stand_sound_in_the_file),
        cmocka_unit_test(names_that_obj_cannot_say_do_no_harm),
        cmocka_unit_test(beetle_stands_sound_in_the_file),
        cmocka_unit_test(elephant_stands_sound_in_the_file),
        cmocka_unit_test(pages_are_used),
        cmocka_unit_test(charts_suit_the_page),
        cmocka_unit_test(refuses_what_breaks_an_atlas),
        cmocka_unit_test(goes_below_too_long_a_texel),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
