/* Set covering as a bound on water: rows are texels of area 1, a column's cost is its water, and what the bound says of
 * covering everything is a lower bound on the least cost. Reads instances of the OR-Library's form (Beasley,
 * OR-Library: distributing test problems by electronic mail, 1990): rows, columns, the columns' costs, then for each
 * row how many columns cover it and which. */
#include "stored.h"

#include <stdio.h>

typedef struct {
    size_t rows, columns;
    uint32_t *cost;  /* [columns] */
    uint8_t *covers; /* [columns x rows] */
} set_cover;

static bool read_count(FILE *file, size_t most, size_t *value)
{
    long found;
    if (fscanf(file, "%ld", &found) != 1 || found < 1 || (size_t)found > most)
        return false;
    *value = (size_t)found;
    return true;
}

static void set_cover_free(set_cover *s)
{
    free(s->cost);
    free(s->covers);
    *s = (set_cover){0};
}

/* False where the text is not of that form. */
static bool set_cover_read(FILE *file, set_cover *s)
{
    *s = (set_cover){0};
    size_t value, among, column;
    if (!read_count(file, 10000, &s->rows) || !read_count(file, 10000, &s->columns))
        return false;
    s->cost = malloc(s->columns * sizeof *s->cost);
    s->covers = calloc(s->columns, s->rows);
    bool good = s->cost && s->covers;
    for (size_t c = 0; good && c < s->columns; c++) {
        good = read_count(file, 1000000, &value);
        s->cost[c] = good ? (uint32_t)value : 0;
    }
    for (size_t r = 0; good && r < s->rows; r++) {
        good = read_count(file, s->columns, &among);
        for (size_t i = 0; good && i < among; i++) {
            good = read_count(file, s->columns, &column);
            if (good)
                s->covers[(column - 1) * s->rows + r] = 1;
        }
    }
    if (!good)
        set_cover_free(s);
    return good;
}

/* The least cost by trying all choices of columns for the first row left. */
static uint32_t least_cost(const set_cover *s, uint8_t *wet, uint32_t spent, uint32_t best)
{
    size_t row = 0;
    while (row < s->rows && wet[row])
        row++;
    if (row == s->rows || spent >= best)
        return spent < best ? spent : best;
    for (size_t c = 0; c < s->columns; c++) {
        if (!s->covers[c * s->rows + row])
            continue;
        for (size_t r = 0; r < s->rows; r++)
            wet[r] = (uint8_t)(wet[r] + s->covers[c * s->rows + r]);
        best = least_cost(s, wet, spent + s->cost[c], best);
        for (size_t r = 0; r < s->rows; r++)
            wet[r] = (uint8_t)(wet[r] - s->covers[c * s->rows + r]);
    }
    return best;
}

/* A cost that no cover is below. `most`: some cover's cost. */
static size_t cost_bound(const set_cover *s, size_t most, size_t rounds)
{
    sp_error error = {0};
    uint32_t *weight = malloc(s->columns * sizeof *weight);
    float *area = malloc(s->rows * sizeof *area), *shares = malloc(s->rows * sizeof *shares);
    uint32_t *texels = malloc(s->rows * sizeof *texels);
    sp_cover cover = {.texel_count = s->rows,
                      .area = area,
                      .weight = weight,
                      .nozzles = s->columns < 80 ? s->columns : 80,
                      .water = most,
                      .whole = true,
                      .threads = 1};
    sp_rows rows = {0};
    for (size_t r = 0; r < s->rows; r++)
        area[r] = shares[r] = 1;
    for (size_t c = 0; c < s->columns; c++) {
        size_t tier = 0, count = 0;
        while (tier < cover.tier_count && weight[tier] != s->cost[c])
            tier++;
        cover.tier_count += tier == cover.tier_count;
        weight[tier] = s->cost[c];
        for (uint32_t r = 0; r < s->rows; r++)
            if (s->covers[c * s->rows + r])
                texels[count++] = r;
        assert_true(sp_rows_add(&rows, c, SP_NO_PORT, (uint32_t)tier, texels, shares, count, &error));
    }
    stored all = {&cover, &rows, 400};
    sp_pricer pricer = stored_pricer(&all);
    sp_bound bound;
    assert_true(sp_bound_create(&cover, &pricer, &bound, &error));
    for (size_t round = 0; round < rounds; round++)
        assert_true(sp_bound_lower(&bound, sp_bound_water(&bound, (double)s->rows), &error));
    size_t cost = sp_bound_water(&bound, (double)s->rows);
    sp_bound_free(&bound);
    sp_rows_free(&rows);
    free(weight);
    free(area);
    free(shares);
    free(texels);
    return cost;
}

static void small_instances(void **state)
{
    (void)state;
    uint64_t seed = 20250;
    for (int i = 0; i < 12; i++) {
        FILE *file = tmpfile();
        assert_non_null(file);
        fprintf(file, " 14 11\n");
        for (int c = 0; c < 11; c++)
            fprintf(file, " %d%s", 1 + (int)(9 * instance_random(&seed)), c % 6 == 5 ? "\n" : "");
        for (int r = 0; r < 14; r++) {
            fprintf(file, "\n 3\n");
            for (int k = 0; k < 3; k++)
                fprintf(file, " %d", 1 + (r * 4 + k * 3 + (int)(4 * instance_random(&seed))) % 11);
        }
        rewind(file);
        set_cover s;
        assert_true(set_cover_read(file, &s));
        assert_int_equal(s.rows, 14);
        assert_int_equal(s.columns, 11);
        uint8_t wet[14] = {0};
        uint32_t all = 0;
        for (size_t c = 0; c < s.columns; c++)
            all += s.cost[c];
        size_t optimum = least_cost(&s, wet, 0, all + 1), bound = cost_bound(&s, all, 8);
        assert_in_range(optimum, 1, all);
        assert_true(bound <= optimum);
        assert_true((double)bound >= 0.7 * (double)optimum);
        set_cover_free(&s);
        fclose(file);
    }
}

static void what_is_not_of_the_form(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "", "2", "0 3", "2 2 1 1 1 1", "2 2 1 1 1 3 1 1", "2 2 1 -1 1 1 1 2", "2 2 1 1 3 1 1 1 1 2", "99999999 5"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        FILE *file = tmpfile();
        assert_non_null(file);
        fputs(texts[i], file);
        rewind(file);
        set_cover s;
        assert_false(set_cover_read(file, &s));
        fclose(file);
    }
}

/* The optima are those that Beasley lists. */
static void published_instances(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        size_t optimum;
    } known[] = {{"scp41", 429}, {"scpe1", 5}};
    for (size_t i = 0; i < 2; i++) {
        char path[600];
        snprintf(path, sizeof path, "%s/or-library/%s.txt", DATA_DIR, known[i].name);
        FILE *file = fopen(path, "r");
        if (!file) {
            print_message("%s is not there\n", path);
            skip();
        }
        set_cover s;
        assert_true(set_cover_read(file, &s));
        size_t bound = cost_bound(&s, 2 * known[i].optimum, 20);
        print_message("%s: bound %zu, optimum %zu\n", known[i].name, bound, known[i].optimum);
        assert_true(bound <= known[i].optimum);
        assert_true((double)bound >= 0.6 * (double)known[i].optimum);
        set_cover_free(&s);
        fclose(file);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(small_instances),
        cmocka_unit_test(what_is_not_of_the_form),
        cmocka_unit_test(published_instances),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
