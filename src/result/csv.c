/* Nozzles and places to swab for spreadsheets (RFC 4180). */
#include "growing_text.h"

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

char *sp_nozzles_csv(const sp_layout *layout, const sp_setup *setup, sp_error *error)
{
    const sp_fluid *liquid = &setup->liquid;
    sp_text text = {0};
    sp_text_add(&text,
                "name,type,x_m,y_m,z_m,axis_x,axis_y,axis_z,roll_deg,angle_deg,pressure_bar,flow_l_min,speed_m_s,"
                "order_code,url\n");
    for (size_t i = 0; i < layout->count; ++i) {
        const sp_nozzle *nozzle = &layout->nozzles[i];
        const sp_vec3 position = sp_setup_outside(setup, nozzle->position);
        const double values[] = {position.x,
                                 position.y,
                                 position.z,
                                 nozzle->axis.x,
                                 nozzle->axis.y,
                                 nozzle->axis.z,
                                 nozzle->roll * 180 / M_PI,
                                 sp_nozzle_angle(nozzle) * 180 / M_PI,
                                 nozzle->pressure / 1e5,
                                 sp_nozzle_flow(nozzle, liquid) * 6e4,
                                 sp_nozzle_speed(nozzle, liquid)};
        add_field(&text, nozzle->name);
        sp_text_append(&text, ",", 1);
        add_field(&text, nozzle->type->name);
        for (size_t k = 0; k < sizeof values / sizeof *values; ++k) {
            sp_text_append(&text, ",", 1);
            sp_text_number(&text, values[k]);
        }
        sp_text_append(&text, ",", 1);
        add_field(&text, nozzle->type->order_code);
        sp_text_append(&text, ",", 1);
        add_field(&text, nozzle->type->url);
        sp_text_append(&text, "\n", 1);
    }
    return sp_text_finish(&text, error);
}

/* Nothing where it is not known. */
static void add_known(sp_text *text, double value)
{
    sp_text_append(text, ",", 1);
    if (isfinite(value))
        sp_text_number(text, value);
}

char *sp_swabs_csv(const sp_design *design, sp_error *error)
{
    sp_swab swabs[SP_SWABS];
    size_t count;
    if (!sp_find_swabs(design, swabs, &count, error))
        return NULL;
    sp_text text = {0};
    sp_text_add(&text, "number,part,x_m,y_m,z_m,received_percent,flux_l_min_m2,speed_m_s,incidence_deg,lack\n");
    for (size_t i = 0; i < count; ++i) {
        const sp_swab *swab = &swabs[i];
        const double values[] = {swab->place.x,
                                 swab->place.y,
                                 swab->place.z,
                                 100 * swab->received,
                                 6e4 * swab->flux,
                                 swab->speed,
                                 swab->incidence * 180 / M_PI};
        sp_text_add(&text, "%zu,", i + 1);
        add_field(&text, swab->part);
        for (size_t k = 0; k < sizeof values / sizeof *values; ++k)
            add_known(&text, values[k]);
        sp_text_add(&text, ",%s\n", sp_lack_key(swab->lack) ? sp_lack_key(swab->lack) : "");
    }
    return sp_text_finish(&text, error);
}
