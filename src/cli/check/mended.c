/* What was mended, for people and as JSON. */
#include "flaws.h"
#include "repair.h"

static const char *part_name(const sp_setup *setup, const cli_mended *file, size_t part)
{
    return setup->mesh->parts[file->first_part + part].name;
}

/* Whether the part had surface, and has none. */
static bool is_lost(const cli_mended *file, size_t part)
{
    return file->part_area[part] > 0 && !(file->part_area[file->part_count + part] > 0);
}

/* m², of the parts that are to be cleaned. */
static double clean_area(const sp_setup *setup, const cli_mended *file, bool after)
{
    double area = 0;
    for (size_t i = 0; i < file->part_count; i++)
        if (setup->surfaces[file->first_part + i].clean)
            area += file->part_area[(after ? file->part_count : 0) + i];
    return area;
}

static size_t fillings_of(const sp_repair_account *account)
{
    return account->filled < SP_PLACES ? account->filled : SP_PLACES;
}

static void print_count(size_t count, const char *what, bool *any)
{
    if (!count)
        return;
    printf("%s %zu %s", *any ? "," : "", count, what);
    *any = true;
}

static void print_parts(const sp_setup *setup, const cli_mended *file)
{
    const sp_repair_account *a = &file->account;
    for (size_t i = 0; i < a->yield_count; i++)
        printf("copies: %.6g m2 of part \"%s\" taken out in favour of part \"%s\"%s\n", a->yields[i].area,
               part_name(setup, file, a->yields[i].part), part_name(setup, file, a->yields[i].to),
               setup->surfaces[file->first_part + a->yields[i].part].clean &&
                       !setup->surfaces[file->first_part + a->yields[i].to].clean
                   ? ", an obstacle"
                   : "");
    if (a->other_yields)
        printf("copies: %zu triangles more taken out in favour of other parts\n", a->other_yields);
    for (size_t i = 0; i < file->part_count; i++)
        if (is_lost(file, i))
            printf("part \"%s\" is gone: nothing is left of it\n", part_name(setup, file, i));
    if (clean_area(setup, file, false) < clean_area(setup, file, true) ||
        clean_area(setup, file, false) > clean_area(setup, file, true))
        printf("parts to be cleaned: area %.6g -> %.6g m2\n", clean_area(setup, file, false),
               clean_area(setup, file, true));
}

static void print_fillings(const sp_repair_account *a)
{
    enum { MOST = 3 };
    for (size_t i = 0; i < fillings_of(a) && i < MOST; i++) {
        sp_vec3 p = a->fillings[i].place;
        if (i == 0)
            printf("put in: %.6g m2 (an opening of that shape is shut as well), the largest: ", a->filled_area);
        printf("%s%.4g m2 at [%.5g, %.5g, %.5g]", i ? ", " : "", a->fillings[i].area, p.x, p.y, p.z);
    }
    if (a->filled)
        printf("\n");
}

void cli_repair_print(const cli_repair *repair, const sp_setup *setup)
{
    for (size_t i = 0; i < repair->count; i++) {
        const cli_mended *file = &repair->files[i];
        const sp_repair_account *a = &file->account;
        bool any = false;
        printf("\n%s:", file->path);
        print_count(a->joined, "corners at cracks joined", &any);
        print_count(a->split, "triangles split at others' corners", &any);
        print_count(a->turned, "triangles turned over", &any);
        print_count(a->filled, "missing triangles put in", &any);
        print_count(a->copies, "copies taken out", &any);
        print_count(a->dropped, "triangles without area dropped", &any);
        printf("%s; area %.6g -> %.6g m2, closed shells %zu of %zu -> %zu of %zu\n", any ? "" : " nothing to mend",
               a->before.area, a->after.area, a->before.closed_shells, a->before.shells, a->after.closed_shells,
               a->after.shells);
        print_fillings(a);
        print_parts(setup, file);
        cli_flaws_print_change(&a->before, &a->after);
        printf("in m and in its place: instead of geometry %zu, without unit, scale, rotate, translate, chord, angle\n",
               i);
    }
}

static json_t *fillings_json(const sp_repair_account *a)
{
    json_t *list = json_array();
    for (size_t i = 0; i < fillings_of(a); i++) {
        sp_vec3 p = a->fillings[i].place;
        json_array_append_new(list,
                              json_pack("{s:[fff], s:f}", "place_m", p.x, p.y, p.z, "area_m2", a->fillings[i].area));
    }
    return list;
}

static json_t *yields_json(const sp_setup *setup, const cli_mended *file)
{
    json_t *list = json_array();
    for (size_t i = 0; i < file->account.yield_count; i++) {
        const sp_yield *y = &file->account.yields[i];
        json_array_append_new(list, json_pack("{s:s, s:s, s:I, s:f}", "part", part_name(setup, file, y->part), "to",
                                              part_name(setup, file, y->to), "triangles", (json_int_t)y->triangles,
                                              "area_m2", y->area));
    }
    return list;
}

static json_t *lost_json(const sp_setup *setup, const cli_mended *file)
{
    json_t *list = json_array();
    for (size_t i = 0; i < file->part_count; i++)
        if (is_lost(file, i))
            json_array_append_new(list, json_string(part_name(setup, file, i)));
    return list;
}

static json_t *file_json(const sp_setup *setup, const cli_mended *file)
{
    const sp_repair_account *a = &file->account;
    json_t *object = json_pack("{s:I, s:s, s:I, s:I, s:I, s:I, s:I, s:I, s:[ff], s:[II], s:[II], s:o, s:o}", "geometry",
                               (json_int_t)file->geometry, "file", file->path, "joined_corners", (json_int_t)a->joined,
                               "split_triangles", (json_int_t)a->split, "turned_triangles", (json_int_t)a->turned,
                               "filled_triangles", (json_int_t)a->filled, "copies", (json_int_t)a->copies,
                               "dropped_triangles", (json_int_t)a->dropped, "area_m2", a->before.area, a->after.area,
                               "shells", (json_int_t)a->before.shells, (json_int_t)a->after.shells, "closed_shells",
                               (json_int_t)a->before.closed_shells, (json_int_t)a->after.closed_shells, "flaws_before",
                               cli_flaws_json(&a->before), "flaws_after", cli_flaws_json(&a->after));
    json_object_set_new(object, "clean_parts_area_m2",
                        json_pack("[ff]", clean_area(setup, file, false), clean_area(setup, file, true)));
    json_object_set_new(object, "filled_area_m2", json_real(a->filled_area));
    json_object_set_new(object, "largest_filled", fillings_json(a));
    json_object_set_new(object, "copies_of_other_parts", yields_json(setup, file));
    json_object_set_new(object, "lost_parts", lost_json(setup, file));
    return object;
}

json_t *cli_repair_json(const cli_repair *repair, const sp_setup *setup)
{
    json_t *list = repair->count ? json_array() : json_null();
    for (size_t i = 0; i < repair->count; i++)
        json_array_append_new(list, file_json(setup, &repair->files[i]));
    return list;
}
