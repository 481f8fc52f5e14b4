/* Nozzles and places to swab for spreadsheets (RFC 4180). */
#include "growing_text.h"
#include "scene/locale.h"
#include "scene/read.h"

#include <sprayplan/result.h>

#include <string.h>

/* Names come from strangers' files. What spreadsheets would compute as a formula gets an apostrophe in front, as OWASP
 * advises (CSV injection); what any of them would divide is quoted. */
static void add_field(sp_text *text, const char *value)
{
    const char *mark = *value && strchr("=+-@\t\r\n", *value) ? "'" : "";
    if (!strpbrk(value, ",;\"\t\r\n")) {
        sp_text_add(text, "%s%s", mark, value);
        return;
    }
    sp_text_add(text, "\"%s", mark);
    for (const char *at = value; *at; ++at)
        sp_text_append(text, *at == '"' ? "\"\"" : at, *at == '"' ? 2 : 1);
    sp_text_append(text, "\"", 1);
}

/* Nothing where it is not known. */
static void add_number(sp_text *text, double value, double unit)
{
    char number[SP_UNITS_NUMBER];
    sp_text_append(text, ",", 1);
    if (!isfinite(value))
        return;
    sp_units_number(value, unit, number);
    sp_text_append(text, number, strlen(number));
}

/* What the units of columns are in SI, as scenes are read: a number is to be the same in both. */
typedef struct {
    double deg, bar, l_min, l_min_m2, percent;
} column_units;

static bool find_units(column_units *found, sp_error *error)
{
    sp_units *units = sp_units_create(error);
    char why[200];
    bool good = units && sp_units_factor(units, "deg", &sp_angle_unit, &found->deg, why, sizeof why) &&
                sp_units_factor(units, "bar", &sp_pressure_unit, &found->bar, why, sizeof why) &&
                sp_units_factor(units, "L/min", &sp_flow_unit, &found->l_min, why, sizeof why) &&
                sp_units_factor(units, "L/min/m2", &sp_flux_unit, &found->l_min_m2, why, sizeof why) &&
                sp_units_factor(units, "%", &sp_share_unit, &found->percent, why, sizeof why);
    if (units && !good)
        sp_fail(error, SP_ERROR_FILE, NULL, 0, 0, "the units database of udunits2 is not sound: %s", why);
    sp_units_destroy(units);
    return good;
}

const char *sp_mounting_key(const sp_mount *mount)
{
    static const char *const keys[] = {
        [SP_MOUNT_PORT] = "port", [SP_MOUNT_SURFACE] = "weld", [SP_MOUNT_LINE] = "line", [SP_MOUNT_BOX] = "box"};
    return mount ? keys[mount->kind] : "";
}

static void add_place(sp_text *text, const sp_fitting_place *place)
{
    const double values[] = {place->x_mm, place->y_mm, place->height_mm, place->radius_mm, place->azimuth_deg};
    for (size_t i = 0; i < sizeof values / sizeof *values; ++i)
        add_number(text, values[i], 1);
}

static void add_exact(sp_text *text, const sp_nozzle *nozzle, const sp_setup *setup, const column_units *units)
{
    const sp_fluid *liquid = &setup->liquid;
    const sp_vec3 position = sp_setup_outside(setup, nozzle->position);
    const struct {
        double value, unit;
    } numbers[] = {{position.x, 1},
                   {position.y, 1},
                   {position.z, 1},
                   {nozzle->axis.x, 1},
                   {nozzle->axis.y, 1},
                   {nozzle->axis.z, 1},
                   {nozzle->roll, units->deg},
                   {sp_nozzle_cone(nozzle), units->deg},
                   {nozzle->pressure, units->bar},
                   {sp_nozzle_flow(nozzle, liquid), units->l_min},
                   {sp_nozzle_speed(nozzle, liquid), 1}};
    for (size_t k = 0; k < sizeof numbers / sizeof *numbers; ++k)
        add_number(text, numbers[k].value, numbers[k].unit);
}

static void add_texts(sp_text *text, const char *const *texts, size_t count)
{
    for (size_t i = 0; i < count; ++i) {
        sp_text_append(text, ",", 1);
        add_field(text, texts[i]);
    }
}

static void add_sheet_row(sp_text *text, const sp_fitting_sheet *sheet, const sp_fitting_row *row,
                          const column_units *units)
{
    const sp_nozzle_type *type = row->nozzle->type;
    const char *const texts[] = {type->order_code, type->url, type->thread, type->insert, sp_mounting_key(row->mount),
                                 row->fitting};
    add_field(text, row->nozzle->name);
    sp_text_append(text, ",", 1);
    add_field(text, type->name);
    add_exact(text, row->nozzle, sheet->setup, units);
    add_texts(text, texts, sizeof texts / sizeof *texts);
    add_number(text, row->depth_mm, 1);
    add_number(text, row->standoff_mm, 1);
    add_place(text, &row->at);
    add_place(text, &row->tip);
    add_number(text, row->tilt_deg, 1);
    add_number(text, row->towards_deg, 1);
    add_number(text, row->turn_deg, 1);
    add_number(text, (double)(row->circuit + 1), 1);
    add_number(text, sheet->circuits[row->circuit].flow, units->l_min);
    sp_text_append(text, "\n", 1);
}

/* The layout's name goes in front of each row, but of one without a name. */
static void add_sheet(sp_text *text, const sp_fitting_sheet *sheet, const char *layout, const column_units *units)
{
    for (size_t i = 0; i < sheet->count; ++i) {
        if (layout) {
            add_field(text, layout);
            sp_text_append(text, ",", 1);
        }
        add_sheet_row(text, sheet, &sheet->rows[i], units);
    }
}

/* `layouts` NULL: of one sheet, without a column for them. */
static char *sheets_csv(const sp_fitting_sheet *const *sheets, const char *const *layouts, size_t count,
                        sp_error *error)
{
    column_units units;
    sp_locale locale;
    sp_text text = {0};
    if (!find_units(&units, error) || !sp_locale_enter(&locale, error))
        return NULL;
    sp_text_add(&text, "%s", layouts ? "layout," : "");
    sp_text_add(&text,
                "name,type,x_m,y_m,z_m,axis_x,axis_y,axis_z,roll_deg,angle_deg,pressure_bar,flow_l_min,speed_m_s,"
                "order_code,url,thread,insert,mounting,fitting,depth_mm,standoff_mm,fitting_x_mm,fitting_y_mm,"
                "fitting_height_mm,fitting_radius_mm,fitting_azimuth_deg,tip_x_mm,tip_y_mm,tip_height_mm,"
                "tip_radius_mm,tip_azimuth_deg,tilt_deg,towards_deg,turn_deg,circuit,circuit_l_min\n");
    for (size_t i = 0; i < count; ++i)
        add_sheet(&text, sheets[i], layouts ? layouts[i] : NULL, &units);
    sp_locale_leave(&locale);
    return sp_text_finish(&text, error);
}

char *sp_nozzles_csv(const sp_fitting_sheet *sheet, sp_error *error)
{
    return sheet ? sheets_csv(&sheet, NULL, 1, error) : NULL;
}

char *sp_all_nozzles_csv(const sp_fitting_sheet *const *sheets, const char *const *layouts, size_t count,
                         sp_error *error)
{
    if (!sheets || !layouts)
        return NULL;
    for (size_t i = 0; i < count; ++i)
        if (!sheets[i])
            return NULL;
    return sheets_csv(sheets, layouts, count, error);
}

char *sp_swabs_csv(const sp_design *design, sp_error *error)
{
    sp_swab swabs[SP_SWABS];
    size_t count;
    if (!sp_find_swabs(design, swabs, &count, error))
        return NULL;
    column_units units;
    sp_locale locale;
    if (!find_units(&units, error) || !sp_locale_enter(&locale, error))
        return NULL;
    sp_text text = {0};
    sp_text_add(&text, "number,part,x_m,y_m,z_m,received_percent,flux_l_min_m2,speed_m_s,incidence_deg,lack\n");
    for (size_t i = 0; i < count; ++i) {
        const sp_swab *swab = &swabs[i];
        const struct {
            double value, unit;
        } numbers[] = {{swab->place.x, 1},           {swab->place.y, 1},
                       {swab->place.z, 1},           {swab->received, units.percent},
                       {swab->flux, units.l_min_m2}, {swab->speed, 1},
                       {swab->incidence, units.deg}};
        sp_text_add(&text, "%zu,", i + 1);
        add_field(&text, swab->part);
        for (size_t k = 0; k < sizeof numbers / sizeof *numbers; ++k)
            add_number(&text, numbers[k].value, numbers[k].unit);
        sp_text_add(&text, ",%s\n", sp_lack_key(swab->lack) ? sp_lack_key(swab->lack) : "");
    }
    sp_locale_leave(&locale);
    return sp_text_finish(&text, error);
}
