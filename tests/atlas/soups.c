/* Random soups: no surface, however doubled, folded, pinched, degenerate or turned over, may crash an atlas or break
 * what every atlas keeps. */
#include "shapes.h"

#include "atlas/charts/charts.h"

#ifdef SPRAYPLAN_SANITIZE
enum { SOUPS = 200 };
#else
enum { SOUPS = 2000 };
#endif

typedef struct {
    uint64_t first, count;
    int fineness;
} range;

typedef struct {
    uint64_t random;
    int fineness; /* how much larger than usual the pieces are */
    size_t vertex_count, triangle_count, vertex_room, triangle_room;
    sp_vec3 *vertices;
    uint32_t (*triangles)[3];
} soup;

static double between(soup *s, double low, double high)
{
    return low + (high - low) * random_number(&s->random);
}

/* A whole number from 0 to count - 1. */
static uint32_t any(soup *s, size_t count)
{
    return (uint32_t)(random_number(&s->random) * (double)count);
}

static bool one_in(soup *s, uint32_t n)
{
    return any(s, n) == 0;
}

static uint32_t add_vertex(soup *s, sp_vec3 at)
{
    if (s->vertex_count == s->vertex_room) {
        s->vertex_room = 2 * s->vertex_room + 64;
        s->vertices = realloc(s->vertices, s->vertex_room * sizeof *s->vertices);
    }
    s->vertices[s->vertex_count] = at;
    return (uint32_t)s->vertex_count++;
}

static void add_triangle(soup *s, uint32_t a, uint32_t b, uint32_t c)
{
    if (s->triangle_count == s->triangle_room) {
        s->triangle_room = 2 * s->triangle_room + 64;
        s->triangles = realloc(s->triangles, s->triangle_room * sizeof *s->triangles);
    }
    memcpy(s->triangles[s->triangle_count++], (uint32_t[]){a, b, c}, sizeof *s->triangles);
}

static sp_vec3 any_point(soup *s)
{
    double x = between(s, -1, 1), y = between(s, -1, 1);
    return sp_v(x, y, between(s, -1, 1));
}

/* A net over one of the room's surfaces, moved anywhere. */
static void add_net(soup *s)
{
    static sp_vec3 (*const surfaces[])(double, double, double) = {on_cylinder, on_cone,      on_sphere, on_saddle,
                                                                  on_strip,    on_two_tubes, on_washer, on_torus};
    sp_vec3 (*at)(double, double, double) = surfaces[any(s, sizeof surfaces / sizeof *surfaces)];
    uint32_t columns = 1 + any(s, 12) * (uint32_t)s->fineness, rows = 1 + any(s, 8) * (uint32_t)s->fineness;
    uint32_t first = (uint32_t)s->vertex_count;
    double size = between(s, 0.05, 1);
    sp_vec3 move = one_in(s, 3) ? sp_v(0, 0, 0) : any_point(s);
    for (uint32_t r = 0; r <= rows; r++)
        for (uint32_t c = 0; c <= columns; c++)
            add_vertex(s, sp_add(move, at((double)c / columns, (double)r / rows, size)));
    for (uint32_t r = 0; r < rows; r++)
        for (uint32_t c = 0; c < columns; c++) {
            uint32_t a = first + r * (columns + 1) + c, d = a + columns + 1;
            add_triangle(s, a, a + 1, d + 1);
            add_triangle(s, a, d + 1, d);
        }
}

/* A sheet that waves, lies flat or is crumpled. */
static void add_sheet(soup *s)
{
    uint32_t columns = 1 + any(s, 10) * (uint32_t)s->fineness, rows = 1 + any(s, 10) * (uint32_t)s->fineness;
    uint32_t first = (uint32_t)s->vertex_count;
    double wave = one_in(s, 3) ? 0 : between(s, 0, 0.3), noise = one_in(s, 2) ? 0 : between(s, 0, 0.2);
    for (uint32_t r = 0; r <= rows; r++)
        for (uint32_t c = 0; c <= columns; c++) {
            double x = (double)c / columns, y = (double)r / rows;
            double z = wave * sin(7 * x) * cos(5 * y) + noise * between(s, -1, 1);
            add_vertex(s, sp_v(x, y, z));
        }
    bool other = one_in(s, 2);
    for (uint32_t r = 0; r < rows; r++)
        for (uint32_t c = 0; c < columns; c++) {
            uint32_t a = first + r * (columns + 1) + c, d = a + columns + 1;
            add_triangle(s, a, a + 1, other ? d : d + 1);
            add_triangle(s, other ? a + 1 : a, d + 1, d);
        }
}

/* Triangles all around one vertex, less than a turn of them, or several turns. */
static void add_fan(soup *s)
{
    uint32_t count = 2 + any(s, 24), middle = add_vertex(s, any_point(s)), first = (uint32_t)s->vertex_count;
    double turns = one_in(s, 2) ? 1 : between(s, 0.2, 2.5), height = one_in(s, 3) ? 0 : between(s, -1, 1);
    bool closed = one_in(s, 2);
    sp_vec3 at = s->vertices[middle];
    for (uint32_t i = 0; i < count; i++) {
        double angle = 2 * M_PI * turns * i / count;
        add_vertex(s, sp_add(at, sp_v(0.3 * cos(angle), 0.3 * sin(angle), height * (i % 2 ? 1 : 0.5))));
    }
    for (uint32_t i = 0; i + !closed < count; i++)
        add_triangle(s, middle, first + i, first + (i + 1) % count);
}

/* A tetrahedron or a double pyramid over few corners, sometimes tiny. */
static void add_solid(soup *s)
{
    uint32_t around = 2 + any(s, 4), first = (uint32_t)s->vertex_count;
    double size = one_in(s, 3) ? pow(10, between(s, -12, 0)) : 0.2;
    sp_vec3 at = any_point(s);
    uint32_t top = add_vertex(s, sp_add(at, sp_v(0, 0, size)));
    uint32_t foot = add_vertex(s, sp_add(at, sp_v(0, 0, one_in(s, 4) ? size : -size)));
    for (uint32_t i = 0; i < around; i++) {
        double angle = 2 * M_PI * i / around;
        add_vertex(s, sp_add(at, sp_v(size * cos(angle), size * sin(angle), 0)));
    }
    for (uint32_t i = 0; i < around; i++) {
        uint32_t a = first + 2 + i, b = first + 2 + (i + 1) % around;
        add_triangle(s, top, a, b);
        add_triangle(s, foot, b, a);
    }
}

/* Triangles between any of few points: edges of many triangles, faces that cross. */
static void add_tangle(soup *s)
{
    uint32_t points = 3 + any(s, 12), first = (uint32_t)s->vertex_count, count = 1 + any(s, 40) * (uint32_t)s->fineness;
    bool lattice = one_in(s, 2);
    for (uint32_t i = 0; i < points; i++) {
        sp_vec3 p = any_point(s);
        add_vertex(s, lattice ? sp_v(round(2 * p.x), round(2 * p.y), round(2 * p.z)) : p);
    }
    for (uint32_t i = 0; i < count; i++) {
        uint32_t a = first + any(s, points), b = first + any(s, points);
        add_triangle(s, a, b, first + any(s, points));
    }
}

/* Long thin triangles, some without any area. */
static void add_needles(soup *s)
{
    uint32_t count = 1 + any(s, 12);
    for (uint32_t i = 0; i < count; i++) {
        sp_vec3 a = any_point(s), b = any_point(s);
        double off = one_in(s, 4) ? 0 : pow(10, between(s, -18, -2));
        sp_vec3 c = sp_add(sp_along(a, between(s, -0.5, 1.5), sp_sub(b, a)), sp_v(0, 0, off));
        uint32_t first = add_vertex(s, a);
        add_vertex(s, b);
        add_vertex(s, c);
        add_triangle(s, first, first + 1, first + 2);
    }
}

/* All or some of the faces once more, as they are or turned over. */
static void repeat_faces(soup *s)
{
    size_t count = s->triangle_count;
    bool all = one_in(s, 2), over = !one_in(s, 4);
    for (size_t t = 0; t < count; t++) {
        const uint32_t c[3] = {s->triangles[t][0], s->triangles[t][1], s->triangles[t][2]};
        if (all || one_in(s, 3))
            add_triangle(s, c[0], c[over ? 2 : 1], c[over ? 1 : 2]);
    }
}

static void turn_faces(soup *s)
{
    uint32_t share = 2 + any(s, 10);
    for (size_t t = 0; t < s->triangle_count; t++)
        if (one_in(s, share)) {
            uint32_t swap = s->triangles[t][1];
            s->triangles[t][1] = s->triangles[t][2];
            s->triangles[t][2] = swap;
        }
}

/* Puts vertices where others are: the surface touches and folds itself. */
static void merge_vertices(soup *s)
{
    uint32_t count = 1 + any(s, 6);
    for (uint32_t i = 0; i < count; i++)
        s->vertices[any(s, s->vertex_count)] = s->vertices[any(s, s->vertex_count)];
}

/* Folds all that lies beyond a plane back on the rest, or flattens the whole, or rounds all places. */
static void bend_space(soup *s)
{
    uint32_t way = any(s, 4);
    double where = between(s, -0.5, 0.5), grain = pow(2, -(double)any(s, 8)), tremble = pow(10, between(s, -17, -3));
    for (size_t v = 0; v < s->vertex_count; v++) {
        sp_vec3 *p = &s->vertices[v];
        if (way == 0 && p->x > where)
            p->x = 2 * where - p->x;
        if (way == 1)
            p->z *= tremble;
        if (way == 2)
            *p = sp_v(grain * round(p->x / grain), grain * round(p->y / grain), grain * round(p->z / grain));
        if (way == 3)
            *p = sp_along(*p, tremble, any_point(s));
    }
}

static void leave_faces_out(soup *s)
{
    size_t kept = 0;
    uint32_t share = 2 + any(s, 20);
    for (size_t t = 0; t < s->triangle_count; t++)
        if (!one_in(s, share))
            memmove(s->triangles[kept++], s->triangles[t], sizeof *s->triangles);
    s->triangle_count = kept;
}

static sp_mesh *soup_mesh(soup *s)
{
    static void (*const pieces[])(soup *) = {add_net, add_sheet, add_fan, add_solid, add_tangle, add_needles};
    static void (*const changes[])(soup *) = {repeat_faces, turn_faces, merge_vertices, bend_space, leave_faces_out};
    uint32_t pieces_wanted = 1 + any(s, 3), changes_wanted = any(s, 4);
    for (uint32_t i = 0; i < pieces_wanted; i++)
        pieces[s->fineness > 1 ? any(s, 2) : any(s, sizeof pieces / sizeof *pieces)](s);
    for (uint32_t i = 0; i < changes_wanted; i++)
        changes[any(s, sizeof changes / sizeof *changes)](s);
    double scale = one_in(s, 8) ? pow(10, between(s, -6, 6)) : 1;
    for (size_t v = 0; v < s->vertex_count; v++)
        s->vertices[v] = sp_scale(s->vertices[v], scale);
    sp_mesh *mesh = mesh_of(s->vertices, s->vertex_count, (const uint32_t(*)[3])s->triangles, s->triangle_count);
    free(s->vertices);
    free(s->triangles);
    return mesh;
}

static double width_of(const sp_mesh *mesh)
{
    sp_vec3 low = sp_v(INFINITY, INFINITY, INFINITY), high = sp_scale(low, -1);
    for (size_t t = 0; t < mesh->triangle_count; t++)
        for (int k = 0; k < 3; k++) {
            sp_vec3 p = mesh->vertices[mesh->triangles[t][k]];
            low = sp_v(fmin(low.x, p.x), fmin(low.y, p.y), fmin(low.z, p.z));
            high = sp_v(fmax(high.x, p.x), fmax(high.y, p.y), fmax(high.z, p.z));
        }
    return sp_distance(low, high);
}

/* The longest side of a chart's box. */
static double length_of(const sp_charts *charts)
{
    double(*box)[4] = malloc((charts->chart_count + 1) * sizeof *box), longest = 0;
    for (size_t c = 0; c < charts->chart_count; c++)
        memcpy(box[c], (double[]){INFINITY, INFINITY, -INFINITY, -INFINITY}, sizeof *box);
    for (size_t t = 0; t < charts->triangle_count; t++)
        for (int i = 0; i < 6; i++) {
            double *b = box[charts->chart[t]] + i % 2, at = charts->flat[t][i / 2][i % 2];
            b[0] = fmin(b[0], at);
            b[2] = fmax(b[2], at);
            longest = fmax(longest, b[2] - b[0]);
        }
    free(box);
    return longest;
}

/* By how much the worst of a triangle's edges is longer or shorter than it is on the surface. */
static double strain_of(const sp_mesh *mesh, const sp_charts *charts, size_t t)
{
    double worst = 0;
    for (int i = 0; i < 3; i++) {
        const double *p = charts->flat[t][i], *q = charts->flat[t][(i + 1) % 3];
        double length =
            sp_distance(mesh->vertices[mesh->triangles[t][i]], mesh->vertices[mesh->triangles[t][(i + 1) % 3]]);
        worst = fmax(worst, fabs(hypot(q[0] - p[0], q[1] - p[1]) / length - 1));
    }
    return worst;
}

/* Every triangle lies in a chart, and at most 5 % of a chart's area has more than 5 % strain. */
static void expect_charts(const sp_mesh *mesh, const sp_charts *charts)
{
    assert_int_equal(charts->triangle_count, mesh->triangle_count);
    double(*area)[2] = calloc(charts->chart_count + 1, sizeof *area);
    for (size_t t = 0; t < mesh->triangle_count; t++) {
        assert_true(charts->chart[t] < charts->chart_count);
        for (int i = 0; i < 3; i++)
            assert_true(isfinite(charts->flat[t][i][0]) && isfinite(charts->flat[t][i][1]));
        area[charts->chart[t]][0] += sp_triangle_area(mesh, (uint32_t)t);
        area[charts->chart[t]][1] +=
            strain_of(mesh, charts, t) <= 0.05 * (1 + 1e-6) ? 0 : sp_triangle_area(mesh, (uint32_t)t);
    }
    for (size_t c = 0; c < charts->chart_count; c++)
        assert_true(area[c][0] > 0 && area[c][1] <= 0.05 * (1 + 1e-6) * area[c][0]);
    free(area);
}

/* What is reckoned from an atlas, each part of it touched. */
static void expect_atlas(const sp_mesh *mesh, const sp_atlas *atlas)
{
    sp_atlas_figures figures = figures_of(atlas, mesh);
    assert_int_equal(figures.overlaps, 0);
    assert_true(figures.area_error < 1e-9);
    sp_fragments fragments;
    sp_texel_links links;
    sp_error error = {0};
    assert_true(sp_fragments_create(&fragments, atlas, mesh, &error));
    assert_true(sp_texel_links_create(&links, atlas, mesh, &error));
    for (size_t i = 0; i < links.start[atlas->texel_count]; i++)
        assert_true(links.items[i] < atlas->texel_count);
    for (uint32_t texel = 0; texel < atlas->texel_count; texel++)
        for (uint32_t f = fragments.start[texel]; f < fragments.start[texel + 1]; f++) {
            sp_vec3 polygon[SP_FRAGMENT_POINTS];
            assert_true(sp_atlas_fragment_polygon(atlas, mesh, texel, fragments.items[f].triangle, polygon) <=
                        SP_FRAGMENT_POINTS);
        }
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        assert_true(sp_atlas_texel(atlas, t, 0.25, 0.5) < atlas->texel_count);
    sp_texel_links_destroy(&links);
    sp_fragments_destroy(&fragments);
}

/* Patches over the whole, and one nozzle in its midst. */
static void expect_patches(const sp_mesh *mesh, double width, double texel)
{
    sp_surface surface = {.clean = true, .rebound = 1};
    sp_setup setup = sp_setup_default();
    sp_error error = {0};
    setup.mesh = mesh;
    setup.surfaces = &surface;
    setup.fidelity.texel = texel;
    setup.run.threads = 1;
    sp_evaluator *evaluator = sp_evaluator_create(&setup, &error);
    double area = sp_mesh_area(mesh), reach = 0;
    for (size_t v = 0; v < mesh->vertex_count; v++)
        reach = fmax(reach, sp_length(mesh->vertices[v]));
    /* What is a few thousand roundings of its coordinates across is refused, and nothing else. */
    if (!evaluator && !(error.kind == SP_ERROR_INPUT && width < 0x1p-39 * reach))
        fail_msg("%s", error.message);
    if (!evaluator)
        return;
    /* Strips that are thinner than the rounding of their coordinates may go missing. */
    double off = fabs(sp_evaluator_patches(evaluator)->total_area - area);
    assert_true(off <= 1e-9 * area + 1e-14 * reach * width);
    sp_evaluator_destroy(evaluator);
}

/* True where there was a surface at all. */
static bool lay_out(uint64_t number, int fineness)
{
    soup s = {.random = 0x9E3779B97F4A7C15ull * (number + 1) + 1, .fineness = fineness};
    for (int i = 0; i < 8; i++)
        random_number(&s.random);
    sp_mesh *mesh = soup_mesh(&s);
    sp_error error = {0};
    double area = sp_mesh_area(mesh), texel = sqrt(area / between(&s, 4, 1000.0 * fineness));
    double width = width_of(mesh);
    size_t triangles = mesh->triangle_count, coarse = 1 + any(&s, triangles / 2 + 1);
    double extent = one_in(&s, 2) ? INFINITY : width * between(&s, 0.1, 2);
    sp_charts *charts = one_in(&s, 2) ? sp_charts_create(mesh, extent, &error)
                                      : sp_charts_by_levels(mesh, extent, any(&s, 10), coarse, &error);
    if (!charts)
        fail_msg("soup %llu: %s", (unsigned long long)number, error.message);
    expect_charts(mesh, charts);
    if (triangles > 0) {
        texel = fmax(texel, length_of(charts) / 1000); /* needles in great number take long to pack */
        sp_atlas_options options = {.texel = texel, .page_edge = 16384, .packing = any(&s, 2)};
        sp_atlas *atlas = sp_atlas_create(mesh, charts, &options, &error);
        if (!atlas)
            fail_msg("soup %llu: %s", (unsigned long long)number, error.message);
        expect_atlas(mesh, atlas);
        sp_atlas_destroy(atlas);
        if (one_in(&s, 2))
            expect_patches(mesh, width, fmax(texel, width / 1000));
    }
    sp_charts_destroy(charts);
    sp_mesh_destroy(mesh);
    return triangles > 0;
}

static void soups_are_laid_out(void **state)
{
    const range *asked = *state;
    size_t real = 0;
    for (uint64_t i = asked->first; i < asked->first + asked->count; i++) {
        real += lay_out(i, asked->fineness);
        if (i % 1000 == 999)
            print_message("%llu\n", (unsigned long long)i + 1);
    }
    assert_true(asked->count < 100 || 10 * real >= 9 * asked->count);
}

int main(int argc, char **argv)
{
    /* How many, the first one's number, and how fine: 20 makes some for which a coarse mesh is made unasked. */
    range asked = {.count = SOUPS, .fineness = 1};
    if (argc > 1)
        asked.count = strtoull(argv[1], NULL, 10);
    if (argc > 2)
        asked.first = strtoull(argv[2], NULL, 10);
    if (argc > 3)
        asked.fineness = atoi(argv[3]);
    const struct CMUnitTest tests[] = {cmocka_unit_test_prestate(soups_are_laid_out, &asked)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
