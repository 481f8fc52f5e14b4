/* What to weld, set and order. */
#include "sheet.h"

#include "page.h"

#include <stdlib.h>
#include <string.h>

#define DIRECTION_DECIMALS 4
#define ORIGIN_DECIMALS 4 /* in m, one more than those of whole mm */

sp_fitting_sheet **sp_fitting_sheets_of(const sp_result *result, sp_error *error)
{
    sp_fitting_sheet **sheets = calloc(result->design_count + 1, sizeof(sp_fitting_sheet *));
    bool done = sheets || sp_fail_memory(error);
    for (size_t i = 0; done && i < result->design_count; ++i) {
        const sp_design *design = &result->designs[i];
        if (!design->evaluator)
            continue;
        sheets[i] = sp_fitting_sheet_create(design->layout, sp_evaluator_setup(design->evaluator), design->mounts,
                                            design->mount_count, error);
        done = sheets[i] != NULL;
    }
    if (done)
        return sheets;
    sp_fitting_sheets_destroy(sheets, result->design_count);
    return NULL;
}

void sp_fitting_sheets_destroy(sp_fitting_sheet **sheets, size_t count)
{
    for (size_t i = 0; sheets && i < count; ++i)
        sp_fitting_sheet_destroy(sheets[i]);
    free(sheets);
}

static void add_head(sp_text *text, const char *name)
{
    sp_text_add(text, "<th scope=\"col\">%s</th>", name);
}

static void add_text_head(sp_text *text, const char *name)
{
    sp_text_add(text, "<th scope=\"col\" class=\"text\">%s</th>", name);
}

/* Of strangers' bytes. */
static void add_clean(sp_text *text, const char *value)
{
    char *clean = sp_text_utf8(value);
    text->failed |= !clean;
    sp_markup_escape(text, clean ? clean : "");
    free(clean);
}

/* The same as a cell; a dash for none. */
static void add_text(sp_text *text, const char *tag, const char *value)
{
    sp_text_add(text, "<%s>", tag);
    add_clean(text, value);
    sp_text_add(text, "%s</%.2s>", *value ? "" : "\xe2\x80\x93", tag);
}

static void add_number(sp_text *text, double value, int decimals)
{
    sp_text_add(text, "<td>");
    sp_markup_decimals(text, value, decimals);
    sp_text_add(text, "</td>");
}

/* As many decimals, one at least, as the value was rounded to. */
static void add_azimuth(sp_text *text, double degrees)
{
    int decimals = 1;
    for (double parts = 10; isfinite(degrees) && fabs(degrees * parts - nearbyint(degrees * parts)) > 1e-6; parts *= 10)
        decimals++;
    add_number(text, degrees, decimals);
}

static void add_place(sp_text *text, const sp_fitting_sheet *sheet, const sp_fitting_place *place)
{
    int mm = sheet->decimals.mm;
    if (!sheet->round) {
        add_number(text, place->x_mm, mm);
        add_number(text, place->y_mm, mm);
    }
    add_number(text, place->height_mm, mm);
    if (sheet->round) {
        add_number(text, place->radius_mm, mm);
        add_azimuth(text, place->azimuth_deg);
    }
}

/* Behind the mount's name where it has one. What is kept is there already, as it is for costs and new_fitting. */
static void add_fitting(sp_text *text, const sp_fitting_row *row)
{
    static const char *const words[][2] = {[SP_MOUNT_SURFACE] = {"new weld on ", "kept, welded to "},
                                           [SP_MOUNT_LINE] = {"new, on a line", "kept, on a line"},
                                           [SP_MOUNT_BOX] = {"new, in a box", "kept, in a box"}};
    const sp_mount *mount = row->mount;
    bool port = mount && mount->kind == SP_MOUNT_PORT;
    sp_text_add(text, "<td class=\"text\">%s", port ? "port " : mount ? "" : "as drawn");
    if (mount)
        add_clean(text, mount->name);
    if (mount && !port) {
        sp_text_add(text, "%s%s", mount->name[0] ? ": " : "", words[mount->kind][row->nozzle->keep]);
        add_clean(text, row->part);
    }
    sp_text_add(text, "</td>");
}

static bool any_turns(const sp_fitting_sheet *sheet)
{
    bool any = false;
    for (size_t i = 0; i < sheet->count; ++i)
        any |= isfinite(sheet->rows[i].turn_deg);
    return any;
}

static void add_places_head(sp_text *text, bool round, bool turns)
{
    sp_text_add(text,
                "<thead><tr><th scope=\"col\" rowspan=\"2\">Nozzle</th><th scope=\"col\" rowspan=\"2\" "
                "class=\"text\">Fitting</th><th scope=\"colgroup\" colspan=\"3\">Fitting at</th><th scope=\"col\" "
                "rowspan=\"2\">Reaches in mm</th><th scope=\"colgroup\" colspan=\"3\">Tip at</th><th "
                "scope=\"colgroup\" colspan=\"%d\">Points</th></tr><tr class=\"sub\">",
                turns ? 3 : 2);
    for (int i = 0; i < 2; ++i)
        sp_text_add(text, "%s",
                    round ? "<th scope=\"col\">height mm</th><th scope=\"col\">radius mm</th><th "
                            "scope=\"col\">azimuth&nbsp;&deg;</th>"
                          : "<th scope=\"col\">x&nbsp;mm</th><th scope=\"col\">y&nbsp;mm</th><th "
                            "scope=\"col\">height mm</th>");
    add_head(text, "tilt&nbsp;&deg;");
    add_head(text, "towards&nbsp;&deg;");
    if (turns)
        add_head(text, "turn&nbsp;&deg;");
    sp_text_add(text, "</tr></thead>\n");
}

static void add_places(const sp_page *page, sp_text *text, size_t design, const sp_fitting_sheet *sheet)
{
    bool turns = any_turns(sheet);
    const sp_fitting_decimals *decimals = &sheet->decimals;
    sp_text_add(text, "<div class=\"wide\"><table class=\"numbers small\"><caption>");
    sp_page_name(page, text, design);
    sp_text_add(text, ": where to drill, weld and point</caption>\n");
    add_places_head(text, sheet->round, turns);
    sp_text_add(text, "<tbody>\n");
    for (size_t i = 0; i < sheet->count; ++i) {
        const sp_fitting_row *row = &sheet->rows[i];
        sp_text_add(text, "<tr>");
        add_text(text, "th scope=\"row\"", row->nozzle->name);
        add_fitting(text, row);
        add_place(text, sheet, &row->at);
        add_number(text, isfinite(row->depth_mm) ? row->depth_mm : row->standoff_mm, decimals->mm);
        add_place(text, sheet, &row->tip);
        add_number(text, row->tilt_deg, decimals->deg);
        add_number(text, row->towards_deg, decimals->deg);
        if (turns)
            add_number(text, row->turn_deg, decimals->deg);
        sp_text_add(text, "</tr>\n");
    }
    sp_text_add(text, "</tbody></table></div>\n");
}

/* What the catalogue may say of a type. */
typedef const char *catalogue_entry(const sp_nozzle_type *type);

static const char *order_code(const sp_nozzle_type *type)
{
    return type->order_code;
}
static const char *thread(const sp_nozzle_type *type)
{
    return type->thread;
}
static const char *insert(const sp_nozzle_type *type)
{
    return type->insert;
}

static const struct {
    const char *title;
    catalogue_entry *of;
} sources[] = {{"Order code", order_code}, {"Thread", thread}, {"Insert", insert}};
enum { SOURCES = sizeof sources / sizeof *sources };

static bool is_given(const sp_fitting_sheet *sheet, size_t source)
{
    bool any = false;
    for (size_t i = 0; i < sheet->count; ++i)
        any |= sources[source].of(sheet->rows[i].nozzle->type)[0] != 0;
    return any;
}

static void add_pressure(sp_text *text, const sp_fitting_sheet *sheet, double pressure)
{
    add_number(text, pressure / 1e5, sheet->decimals.bar);
}

static void add_flow(sp_text *text, const sp_fitting_sheet *sheet, double flow)
{
    add_number(text, flow * 6e4, sp_told_decimals(flow * 6e4, sheet->decimals.l_min, 3));
}

static void add_order(sp_text *text, const sp_fitting_sheet *sheet, const sp_fitting_row *row)
{
    const sp_nozzle *nozzle = row->nozzle;
    sp_text_add(text, "<tr>");
    add_text(text, "th scope=\"row\"", nozzle->name);
    add_text(text, "td class=\"text\"", nozzle->type->name);
    for (size_t i = 0; i < SOURCES; ++i)
        if (is_given(sheet, i))
            add_text(text, "td class=\"text\"", sources[i].of(nozzle->type));
    add_number(text, sp_nozzle_cone(nozzle) * 180 / M_PI, sheet->decimals.angle_deg);
    add_pressure(text, sheet, nozzle->pressure);
    add_flow(text, sheet, sp_nozzle_flow(nozzle, &sheet->setup->liquid));
    sp_text_add(text, "<td>%zu</td></tr>\n", row->circuit + 1);
}

static void add_orders(sp_text *text, const sp_fitting_sheet *sheet)
{
    sp_text_add(text, "<div class=\"wide\"><table class=\"numbers small\"><caption>What to order and set</caption>\n"
                      "<thead><tr>");
    add_head(text, "Nozzle");
    add_text_head(text, "Type");
    for (size_t i = 0; i < SOURCES; ++i)
        if (is_given(sheet, i))
            add_text_head(text, sources[i].title);
    add_head(text, "angle&nbsp;&deg;");
    add_head(text, "bar");
    add_head(text, "L/min");
    add_head(text, "Circuit");
    sp_text_add(text, "</tr></thead>\n<tbody>\n");
    for (size_t i = 0; i < sheet->count; ++i)
        add_order(text, sheet, &sheet->rows[i]);
    sp_text_add(text, "</tbody></table></div>\n");
}

static void add_circuits(sp_text *text, const sp_fitting_sheet *sheet)
{
    sp_text_add(text, "<div class=\"wide\"><table class=\"numbers small narrow\"><caption>What each circuit has to "
                      "supply</caption>\n<thead><tr>");
    add_head(text, "Circuit");
    add_head(text, "Nozzles");
    add_head(text, "bar");
    add_head(text, "L/min");
    sp_text_add(text, "</tr></thead>\n<tbody>\n");
    for (size_t i = 0; i < sheet->circuit_count; ++i) {
        const sp_circuit *circuit = &sheet->circuits[i];
        sp_text_add(text, "<tr><th scope=\"row\">%zu</th><td>%zu</td>", i + 1, circuit->nozzles);
        add_pressure(text, sheet, circuit->pressure);
        add_flow(text, sheet, circuit->flow);
        sp_text_add(text, "</tr>\n");
    }
    sp_text_add(text, "</tbody></table></div>\n");
}

static void add_vector(sp_text *text, sp_vec3 v, int decimals)
{
    const double values[] = {v.x, v.y, v.z}, parts = pow(10, decimals);
    for (int i = 0; i < 3; ++i) {
        sp_text_add(text, i ? ", " : "(");
        sp_text_number(text, nearbyint(values[i] * parts) / parts + 0.0);
    }
    sp_text_add(text, ")");
}

/* "x", "-z", or its components. */
static void add_direction(sp_text *text, sp_vec3 v)
{
    const double values[] = {v.x, v.y, v.z};
    for (int i = 0; i < 3; ++i)
        if (fabs(values[i]) == 1) {
            sp_text_add(text, "%s%c", values[i] < 0 ? "&minus;" : "", 'x' + i);
            return;
        }
    add_vector(text, v, DIRECTION_DECIMALS);
}

/* On the screen what is the same of all sheets stands in the first alone. */
static const char *manner(const sp_page *page, size_t design)
{
    return page->main == SP_UNKNOWN || design == page->main ? "" : " again";
}

static void add_datum(sp_text *text, const sp_fitting_sheet *sheet, const char *classes)
{
    const sp_datum *datum = &sheet->setup->datum;
    char *name = sp_text_utf8(datum->name[0] ? datum->name : "the geometry's own axes");
    text->failed |= !name;
    sp_text_add(text, "<p class=\"datum%s\">Measured from ", classes);
    sp_markup_escape(text, name ? name : "");
    free(name);
    sp_text_add(text, ": heights along ");
    add_direction(text, datum->axis);
    sp_text_add(text, " from ");
    add_vector(text, datum->origin, ORIGIN_DECIMALS + sheet->decimals.mm);
    sp_text_add(text, "&nbsp;m, azimuths anticlockwise, seen against that axis, from ");
    add_direction(text, datum->zero);
    sp_text_add(text, ", in the geometry&#39;s coordinates%s.</p>\n",
                sheet->round ? "" : "; x lies along azimuth 0 and y along azimuth 90");
}

static void add_note(sp_text *text, bool turns, const char *classes)
{
    sp_text_add(text,
                "<p class=\"note%s\">A fitting&#39;s place is the port&#39;s mouth, or the point of the wall where to "
                "weld; the nozzle reaches in from there, along the port or square to the wall, to its tip, where the "
                "liquid leaves. It points tilted from straight down, against the datum&#39;s axis, towards that "
                "azimuth. %sA circuit feeds the nozzles of one pressure.</p>",
                classes,
                turns ? "Turned from the level line that points 90&deg; on from there, clockwise seen along "
                        "the spray, lies the width of a fan, or a body&#39;s own x. "
                      : "");
}

static void add_file(const sp_page *page, sp_text *text, size_t design, bool several)
{
    if (design == page->main && strcmp(page->result->command, "compare") != 0) {
        sp_text_add(text, "The same is in nozzles.csv%s.", several ? ", of all layouts in " SP_ALL_NOZZLES : "");
        return;
    }
    sp_text_add(text, "The same is in " SP_ALL_NOZZLES ", as ");
    sp_markup_escape(text, page->figures[design].name);
    sp_text_add(text, ".");
}

static void add_link(const sp_page *page, sp_text *text, size_t design)
{
    sp_text_add(text, "<a href=\"#");
    sp_page_sheet_id(page, text, design);
    sp_text_add(text, "\">");
    sp_page_name(page, text, design);
    sp_text_add(text, "</a>");
}

/* Where else the sheet is, and where those of others are. */
static void add_whereabouts(const sp_page *page, sp_text *text, sp_fitting_sheet *const *sheets, size_t design)
{
    const sp_result *result = page->result;
    size_t listed = 0, several = 0;
    for (size_t i = 0; i < result->design_count; ++i)
        several += sheets[i] != NULL;
    sp_text_add(text, "<p class=\"note\">");
    add_file(page, text, design, several > 1);
    sp_text_add(text, "<span class=\"alone\"> <a href=\"#");
    sp_page_sheet_id(page, text, design);
    sp_text_add(text, "\">Printed from here</a> the sheet comes alone.");
    for (size_t i = 0; i < result->design_count; ++i) {
        if (i == design || !sheets[i])
            continue;
        sp_text_add(text, listed++ ? ", " : " Sheets of the others: ");
        add_link(page, text, i);
    }
    sp_text_add(text, "%s</span></p>", listed ? "." : "");
}

static void add_sheet(const sp_page *page, sp_text *text, sp_fitting_sheet *const *sheets, size_t design, bool turns)
{
    const sp_fitting_sheet *sheet = sheets[design];
    const char *classes = manner(page, design);
    sp_text_add(text, "<section id=\"");
    sp_page_sheet_id(page, text, design);
    /* in print what was found before refinement comes alone or not at all: nobody is to build it by mistake */
    sp_text_add(text, "\" class=\"sheet%s\"><h2>Sheet", design == page->greedy ? " early" : "");
    if (design != page->main) {
        sp_text_add(text, ": ");
        sp_page_narrow_name(page, text, design);
    }
    sp_text_add(text, "</h2>\n");
    add_datum(text, sheet, classes);
    add_places(page, text, design, sheet);
    add_orders(text, sheet);
    add_circuits(text, sheet);
    add_note(text, turns, classes);
    add_whereabouts(page, text, sheets, design);
    sp_text_add(text, "</section>\n");
}

void sp_page_sheet_id(const sp_page *page, sp_text *text, size_t design)
{
    sp_text_add(text, design == page->main ? "sheet" : "sheet-%zu", design + 1);
}

bool sp_page_sheets(const sp_page *page, sp_text *text, sp_error *error)
{
    size_t count = page->result->design_count;
    sp_fitting_sheet **sheets = sp_fitting_sheets_of(page->result, error);
    bool turns = false;
    if (!sheets)
        return false;
    for (size_t i = 0; i < count; ++i)
        turns |= sheets[i] && any_turns(sheets[i]);
    if (page->main != SP_UNKNOWN && sheets[page->main])
        add_sheet(page, text, sheets, page->main, turns);
    for (size_t i = 0; i < count; ++i)
        if (i != page->main && sheets[i])
            add_sheet(page, text, sheets, i, turns);
    sp_fitting_sheets_destroy(sheets, count);
    return true;
}
