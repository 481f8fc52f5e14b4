/* cost: what a nozzle at a mount costs, in water that it must save, or in money that buys as much water. */
#include "scene/state.h"

#include <stdio.h>
#include <string.h>

static const double most_cost = 1e6 / 6e4 * (1 + 1e-12); /* m³/s: far beyond any plant */

enum { NUMBER = 40 };

/* "900 EUR": a number and the three letters of a currency (ISO 4217), which end the text or stand before " per ". */
static bool parse_money(const sp_reader *reader, const char *text, double *amount, char currency[SP_CURRENCY],
                        const char **rest)
{
    char number[NUMBER], why[80];
    size_t size = strspn(text, "0123456789.+-eE");
    while (size > 0 && strchr("eE", text[size - 1])) /* of EUR */
        size--;
    const char *letters = text + size + strspn(text + size, " ");
    if (!size || size >= NUMBER || strspn(letters, "ABCDEFGHIJKLMNOPQRSTUVWXYZ") != 3 ||
        (letters[3] && letters[3] != ' '))
        return false;
    snprintf(number, sizeof number, "%.*s", (int)size, text);
    snprintf(currency, SP_CURRENCY, "%.3s", letters);
    *rest = letters + 3;
    return sp_units_read(reader->units, number, &sp_ratio_unit, amount, why, sizeof why);
}

bool sp_scene_read_water_cost(sp_scene *scene, const sp_reader *reader, const sp_yaml *place)
{
    static const char *const expected = "money per water above 0 such as 30 EUR per L/min";
    static const char per[] = " per ";
    const sp_yaml *node = sp_yaml_get(place, "water_cost");
    sp_water_cost cost = {0};
    const char *rest;
    char why[80];
    double factor = 0;
    if (!node)
        return true;
    if (node->kind != SP_YAML_SCALAR || !parse_money(reader, node->text, &cost.money, cost.currency, &rest) ||
        strncmp(rest, per, sizeof per - 1) != 0 ||
        !sp_units_factor(reader->units, rest + sizeof per - 1, &sp_flow_unit, &factor, why, sizeof why))
        return sp_read_fail(reader, node, "water_cost", "%s", expected);
    cost.money /= factor;
    if (!(cost.money > 0 && cost.money < INFINITY))
        return sp_read_fail(reader, node, "water_cost", "%s", expected);
    scene->water_cost = cost;
    return true;
}

/* Money as the water that it buys. */
static bool read_money(const sp_scene *scene, const sp_reader *reader, const sp_yaml *node, double amount,
                       const char *currency, double *cost)
{
    const sp_water_cost *water = &scene->water_cost;
    if (!(water->money > 0))
        return sp_read_message(reader, node, "cost",
                               "found money, '%s', expected place's `water_cost` with it, such as 30 %s per L/min, or "
                               "water such as 3 L/min",
                               node->text, currency);
    if (strcmp(currency, water->currency) != 0)
        return sp_read_fail(reader, node, "cost", "an amount of %s, as in `water_cost`", water->currency);
    *cost = amount / water->money;
    return true;
}

bool sp_scene_read_cost(const sp_scene *scene, const sp_reader *reader, const sp_yaml *mount, double *cost)
{
    static const char *const expected =
        "water such as 3 L/min, up to 1e6 L/min, or beside place's `water_cost` money such as 900 EUR";
    const sp_yaml *node = sp_yaml_get(mount, "cost");
    char currency[SP_CURRENCY], why[80];
    const char *rest;
    double amount;
    if (!node)
        return true;
    if (node->kind != SP_YAML_SCALAR)
        return sp_read_fail(reader, node, "cost", "%s", expected);
    if (parse_money(reader, node->text, &amount, currency, &rest) && !*rest) {
        if (!read_money(scene, reader, node, amount, currency, cost))
            return false;
    } else if (!sp_units_read(reader->units, node->text, &sp_flow_unit, cost, why, sizeof why)) {
        return sp_read_fail(reader, node, "cost", "%s", expected);
    }
    return (*cost >= 0 && *cost <= most_cost) || sp_read_fail(reader, node, "cost", "%s", expected);
}

sp_water_cost sp_scene_water_cost(const sp_scene *scene)
{
    return scene ? scene->water_cost : (sp_water_cost){0};
}
