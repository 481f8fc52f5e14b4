/* A type's flow as a catalogue prints it: at one pressure, or at several. */
#include "scene/state.h"

#include <stdlib.h>

#define POINTS_MOST 64
#define OFF_MOST 0.1 /* of a point's flow, that the power of the pressure may miss it by */

static bool is_list(const sp_yaml *node)
{
    return node && node->kind == SP_YAML_LIST;
}

/* A list of rising quantities; how many are the caller's to know. */
static bool read_rising(const sp_fields *in, const char *key, double values[POINTS_MOST])
{
    const sp_key *each = sp_key_of(in->block, key);
    const sp_yaml *list = sp_yaml_get(in->map, key);
    size_t count = 0;
    for (const sp_yaml *node = list->first; node; node = node->next, count++) {
        if (!sp_read_quantity_at(in->reader, node, each, &values[count]))
            return false;
        if (count && !(values[count] > values[count - 1]))
            return sp_read_fail(in->reader, node, key, "more than the one before it");
    }
    return true;
}

/* n and K of Q = K dp^n by least squares of the logarithms; K as the flow at the first pressure. */
static void fit(const double *flow, const double *at, size_t count, sp_nozzle_type *type)
{
    double mean_flow = 0, mean_at = 0, both = 0, square = 0;
    for (size_t i = 0; i < count; i++) {
        mean_flow += log(flow[i]) / (double)count;
        mean_at += log(at[i]) / (double)count;
    }
    for (size_t i = 0; i < count; i++) {
        both += (log(at[i]) - mean_at) * (log(flow[i]) - mean_flow);
        square += (log(at[i]) - mean_at) * (log(at[i]) - mean_at);
    }
    type->exponent = both / square;
    type->at = at[0];
    type->flow = exp(mean_flow + type->exponent * (log(at[0]) - mean_at));
}

static bool check_fit(const sp_reader *reader, const sp_yaml *flows, const double *flow, const double *at,
                      const sp_nozzle_type *type)
{
    size_t i = 0;
    if (!(type->exponent <= 1))
        return sp_read_message(reader, flows, "flow", "found to grow with the power %.3g of `at`, expected 1 at most",
                               type->exponent);
    for (const sp_yaml *node = flows->first; node; node = node->next, i++) {
        double off = type->flow * pow(at[i] / type->at, type->exponent) / flow[i] - 1;
        if (fabs(off) > OFF_MOST)
            return sp_read_message(reader, node, "flow",
                                   "found '%.60s', expected no more than %.0f %% off the power %.3g of `at` that fits "
                                   "all points best, which makes it %.3g times as much",
                                   node->text, 100 * OFF_MOST, type->exponent, 1 + off);
    }
    return true;
}

/* Several points tell the exponent, too. */
static bool read_points(const sp_fields *in, sp_nozzle_type *type)
{
    const sp_reader *reader = in->reader;
    const sp_yaml *map = in->map, *flows = sp_yaml_get(map, "flow"), *pressures = sp_yaml_get(map, "at");
    double flow[POINTS_MOST], at[POINTS_MOST];
    const sp_yaml *exponent = sp_yaml_get(map, "exponent");
    if (!is_list(flows) || !is_list(pressures) || flows->count != pressures->count || flows->count < 2 ||
        flows->count > POINTS_MOST)
        return sp_read_message(reader, is_list(flows) ? flows : pressures, is_list(flows) ? "flow" : "at",
                               "found a list, expected one of 2 to %d flows and one of as many pressures", POINTS_MOST);
    if (exponent)
        return sp_read_message(reader, exponent, "exponent",
                               "found beside several flows, from which it follows; "
                               "expected it beside a single flow only");
    if (!read_rising(in, "flow", flow) || !read_rising(in, "at", at))
        return false;
    fit(flow, at, flows->count, type);
    return check_fit(reader, flows, flow, at, type);
}

bool sp_scene_read_flow(const sp_reader *reader, const sp_yaml *map, sp_nozzle_type *type)
{
    const sp_fields in = {reader, &sp_block_type, map};
    const sp_yaml *flow = sp_yaml_get(map, "flow"), *at = sp_yaml_get(map, "at");
    type->exponent = 0.5;
    if (is_list(flow) || is_list(at))
        return read_points(&in, type);
    return sp_read_quantity(&in, "flow", &type->flow) && sp_read_quantity(&in, "at", &type->at) &&
           sp_read_quantity(&in, "exponent", &type->exponent);
}
