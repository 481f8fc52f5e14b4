/* How result.json is put together: json.c the whole, json_layout.c and json_proposal.c its parts. */
#ifndef RESULT_JSON_PUT_H
#define RESULT_JSON_PUT_H

#include <sprayplan/result.h>

#include <jansson.h>
#include <math.h>
#include <stdbool.h>

/* What puts something returns false where memory runs out. A figure that is not known is left out, which is no failure.
 */
static inline bool sp_put(json_t *object, const char *key, json_t *value)
{
    return json_object_set_new(object, key, value) == 0;
}

static inline bool sp_put_real(json_t *object, const char *key, double value)
{
    return !isfinite(value) || sp_put(object, key, json_real(value));
}

static inline bool sp_put_count(json_t *object, const char *key, size_t value)
{
    return value == SP_UNKNOWN || sp_put(object, key, json_integer((json_int_t)value));
}

static inline bool sp_put_text(json_t *object, const char *key, const char *value)
{
    return !value[0] || sp_put(object, key, json_string(value));
}

static inline bool sp_put_vector(json_t *object, const char *key, sp_vec3 value)
{
    if (!isfinite(value.x) || !isfinite(value.y) || !isfinite(value.z))
        return true;
    return sp_put(object, key, json_pack("[fff]", value.x, value.y, value.z));
}

/* json_layout.c. What all layouts have in common is put beside them, else into each. */
bool sp_same_geometry(const sp_figures *a, const sp_figures *b);
bool sp_same_fidelity(const sp_figures *a, const sp_figures *b);
bool sp_put_geometry(json_t *object, const sp_figures *figures, const sp_evaluator *evaluator);
bool sp_put_fidelity(json_t *object, const sp_figures *figures, size_t count, const sp_evaluator *evaluator);
bool sp_put_criterion(json_t *object, const sp_figures *figures);
/* What layouts differ in, and each therefore tells of itself. */
typedef struct {
    bool surface, geometry, criterion, fidelity;
} sp_layout_own;
bool sp_put_layout(json_t *layouts, const sp_figures *figures, const sp_evaluator *evaluator, sp_layout_own own);

/* json_proposal.c. What was found and proved, besides the layout. `clean_area`: m², of which shares are written;
 * `fittings`: with how many nozzles of each point of the front want one. */
bool sp_put_proposal(json_t *object, const sp_proposal *proposal, double clean_area, bool fittings);

#endif
