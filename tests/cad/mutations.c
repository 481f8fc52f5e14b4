/* Damaged CAD files: cut, bits flipped, references changed, numbers replaced. Each is refused, or read as a mesh that
 * what check prints tells from the sound one's, or as the sound one's. Some here; with SPRAYPLAN_LONG set 1000 STEP,
 * 200 IGES and 200 BREP files, an hour of processor time. */
#include "files.h"

#include "mesh/distance.h"
#include "trace/distance.h"

#include <ctype.h>
#include <stdint.h>
#include <time.h>

enum { MOST_PARTS = 16 };

typedef struct {
    char *text;
    size_t size;
} file;

/* What check prints of a part, in figures as it prints them. */
typedef struct {
    size_t parts, triangles, faults;
    char names[MOST_PARTS][64];
    double area[MOST_PARTS], volume[MOST_PARTS], body[MOST_PARTS];
    sp_vec3 low[MOST_PARTS], high[MOST_PARTS];
} figures;

typedef struct {
    size_t same, seen, silent, refused, crashed, late;
    double longest;
} outcomes;

/* SplitMix64, Steele, Lea and Flood 2014 */
static uint64_t next(uint64_t *state)
{
    uint64_t z = *state += 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}

static file read_all(const char *path)
{
    FILE *from = fopen(path, "rb");
    assert_non_null(from);
    assert_int_equal(fseek(from, 0, SEEK_END), 0);
    file f = {.size = (size_t)ftell(from)};
    f.text = malloc(f.size + 64);
    assert_non_null(f.text);
    rewind(from);
    assert_int_equal(fread(f.text, 1, f.size, from), f.size);
    assert_int_equal(fclose(from), 0);
    return f;
}

static void write_all(const char *path, const char *text, size_t size)
{
    FILE *to = fopen(path, "wb");
    assert_non_null(to);
    assert_int_equal(fwrite(text, 1, size, to), size);
    assert_int_equal(fclose(to), 0);
}

/* The first digit of a whole number, behind '#' or not, that begins anywhere; the end of the text where there is none.
 */
static size_t find_number(const char *text, size_t size, size_t from, bool reference)
{
    for (size_t i = 0; i < size; i++) {
        size_t at = (from + i) % size;
        bool begins =
            at > 0 && isdigit((unsigned char)text[at]) && !isalnum((unsigned char)text[at - 1]) && text[at - 1] != '.';
        if (begins && (text[at - 1] == '#') == reference)
            return at;
    }
    return size;
}

/* Another number of as many digits, in place; what it stands for is up to the file's kind. */
static void replace_number(char *text, size_t size, bool reference, uint64_t *random)
{
    size_t at = find_number(text, size, next(random) % size, reference);
    for (; at < size && isdigit((unsigned char)text[at]); at++)
        text[at] = (char)('0' + next(random) % 10);
}

/* Returns the new size. */
static size_t damage(char *text, size_t size, unsigned kind, uint64_t *random)
{
    switch (kind % 4) {
    case 0:
        return next(random) % size;
    case 1:
        for (uint64_t i = next(random) % 4 + 1; i > 0; i--)
            text[next(random) % size] ^= (char)(1u << next(random) % 8);
        return size;
    default:
        replace_number(text, size, kind % 4 == 2, random);
        return size;
    }
}

static void measure_box(const sp_mesh *mesh, uint32_t part, sp_vec3 *low, sp_vec3 *high)
{
    *low = sp_v(INFINITY, INFINITY, INFINITY);
    *high = sp_scale(*low, -1);
    for (uint32_t i = 0; i < 3 * mesh->triangle_count; i++) {
        sp_vec3 p = mesh->vertices[mesh->triangles[i / 3][i % 3]];
        if (mesh->part[i / 3] != part)
            continue;
        *low = sp_v(fmin(low->x, p.x), fmin(low->y, p.y), fmin(low->z, p.z));
        *high = sp_v(fmax(high->x, p.x), fmax(high->y, p.y), fmax(high->z, p.z));
    }
}

static figures measure(const sp_mesh *mesh, const sp_cad_account *account)
{
    figures f = {.parts = mesh->part_count, .triangles = mesh->triangle_count, .faults = account->faults};
    double *volumes = calloc(mesh->part_count, sizeof *volumes);
    assert_non_null(volumes);
    assert_true(sp_mesh_volumes(mesh, volumes, NULL));
    for (uint32_t i = 0; i < mesh->part_count && i < MOST_PARTS; i++) {
        snprintf(f.names[i], sizeof f.names[i], "%s", mesh->parts[i].name);
        f.area[i] = part_area(mesh, i);
        f.volume[i] = volumes[i];
        f.body[i] = mesh->parts[i].volume;
        measure_box(mesh, i, &f.low[i], &f.high[i]);
    }
    free(volumes);
    return f;
}

static bool differs(double a, double b, double step)
{
    return !(fabs(a - b) < step);
}

/* Whether check prints other figures. */
static bool is_seen(const figures *a, const figures *b)
{
    bool seen = a->parts != b->parts || a->triangles != b->triangles || a->faults != b->faults;
    for (size_t i = 0; i < a->parts && i < MOST_PARTS; i++)
        seen |= strcmp(a->names[i], b->names[i]) != 0 || differs(a->area[i], b->area[i], 1e-4) ||
                differs(a->volume[i], b->volume[i], 1e-8) || differs(a->body[i], b->body[i], 1e-8) ||
                differs(sp_distance(a->low[i], b->low[i]), 0, 1e-5) ||
                differs(sp_distance(a->high[i], b->high[i]), 0, 1e-5);
    return seen;
}

/* How far vertices of one lie off the other. */
static double farthest(const sp_mesh *from, const sp_mesh *to)
{
    sp_error error = {0};
    sp_tracer *tracer = sp_tracer_create(to, SP_ACCELERATOR_BVH, 1, &error);
    double most = 0;
    assert_non_null(tracer);
    for (size_t i = 0; i < from->vertex_count; i++) {
        sp_vec3 p = from->vertices[i];
        sp_vec3 at = sp_triangle_nearest(to, sp_tracer_nearest_triangle(tracer, SP_NONE, p), p);
        most = fmax(most, sp_distance(p, at));
    }
    sp_tracer_destroy(tracer);
    return most;
}

/* The same surface, whether cut likewise or not: a shaft that is turned about its axis stays what it is. */
static bool is_same(const sp_mesh *a, const sp_mesh *b, double chord)
{
    size_t size = a->vertex_count * sizeof *a->vertices;
    if (a->vertex_count == b->vertex_count && memcmp(a->vertices, b->vertices, size) == 0)
        return true;
    return farthest(a, b) < chord && farthest(b, a) < chord;
}

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static void count_refused(const sp_error *error, const char *path, outcomes *found)
{
    assert_true(error->kind == SP_ERROR_INPUT && strcmp(error->file, path) == 0 && error->message[0]);
    if (strstr(error->message, "crashed"))
        found->crashed++;
    else if (strstr(error->message, "processor time") || strstr(error->message, "takes longer"))
        found->late++;
    else
        found->refused++;
}

static void judge(const char *path, const sp_mesh *sound, const figures *before, outcomes *found)
{
    const sp_cad_options options = sp_cad_options_default();
    sp_cad_account account;
    sp_error error = {0};
    double start = now();
    sp_mesh *mesh = sp_cad_load(path, 1, &options, &account, &error);
    found->longest = fmax(found->longest, now() - start);
    if (!mesh) {
        count_refused(&error, path, found);
        return;
    }
    figures after = measure(mesh, &account);
    if (is_seen(before, &after))
        found->seen++;
    else if (is_same(sound, mesh, account.chord))
        found->same++;
    else
        found->silent++;
    sp_mesh_destroy(mesh);
}

/* To look at. */
static void keep(const char *path, size_t number)
{
    char kept[160];
    snprintf(kept, sizeof kept, "silent-%zu-%s", number, path);
    assert_int_equal(rename(path, kept), 0);
    print_message("%s\n", kept);
}

static void mutate(const char *what, const char *name, size_t few, size_t many)
{
    char path[128];
    snprintf(path, sizeof path, "mutated-%s", name);
    make_cad(what, name, "");
    const sp_cad_options options = sp_cad_options_default();
    sp_cad_account account;
    sp_mesh *sound = load_cad(name, 1, &options, &account);
    figures before = measure(sound, &account);
    file whole = read_all(name);
    char *text = malloc(whole.size);
    assert_non_null(text);
    outcomes found = {0};
    size_t count = getenv("SPRAYPLAN_LONG") ? many : few;
    for (size_t i = 0; i < count; i++) {
        uint64_t random = 77 + i;
        memcpy(text, whole.text, whole.size);
        write_all(path, text, damage(text, whole.size, (unsigned)i, &random));
        size_t silent = found.silent;
        judge(path, sound, &before, &found);
        if (found.silent > silent)
            keep(path, i);
    }
    print_message(
        "%zu %s: %zu as the sound one, %zu tell themselves, %zu silent, %zu refused, %zu crashed, %zu took too "
        "long; the longest %.1f s\n",
        count, name, found.same, found.seen, found.silent, found.refused, found.crashed, found.late, found.longest);
    assert_int_equal(found.silent, 0);
    free(text);
    free(whole.text);
    sp_mesh_destroy(sound);
    remove(path);
}

static void damaged_files_are_reported(void **state)
{
    (void)state;
    need_cad();
    mutate("vessel", "mutations.step", 12, 1000);
    mutate("round", "mutations.igs", 4, 200);
    mutate("vessel", "mutations.brep", 4, 200);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(damaged_files_are_reported)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
