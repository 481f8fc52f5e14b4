/* How liquid leaves the nozzles: evenly, turning, or as it was measured. */
#include "page.h"

#include "nozzle/layers.h"
#include "nozzle/rotation.h"

#include <stdlib.h>
#include <string.h>

/* Whether any nozzle of the designs on an evaluator does. */
static bool rotates(const sp_result *result, const sp_evaluator *evaluator)
{
    for (size_t i = 0; i < result->design_count; ++i)
        for (size_t k = 0; result->designs[i].evaluator == evaluator && k < result->designs[i].layout->count; ++k)
            if (sp_type_rotates(result->designs[i].layout->nozzles[k].type))
                return true;
    return false;
}

bool sp_page_type_repeats(const sp_result *result, const sp_evaluator *evaluator, size_t design, size_t nozzle)
{
    const sp_nozzle_type *type = result->designs[design].layout->nozzles[nozzle].type;
    for (size_t i = 0; i <= design; ++i) {
        const sp_layout *layout = result->designs[i].layout;
        size_t end = result->designs[i].evaluator != evaluator ? 0 : i < design ? layout->count : nozzle;
        for (size_t k = 0; k < end; ++k)
            if (layout->nozzles[k].type == type)
                return true;
    }
    return false;
}

static void add_image(sp_text *text, const sp_nozzle_type *type)
{
    char *name = sp_text_utf8(type->name), *image = sp_text_utf8(type->image);
    sp_text_add(text, "; of type ");
    sp_markup_escape(text, name ? name : "");
    sp_text_add(text, " as it was measured, by the image ");
    sp_markup_escape(text, image ? image : "");
    if (sp_type_has_layers(type))
        sp_text_add(text, ", which says how fast besides (in %zu speeds from %.2g to %.2g times the exit speed)",
                    type->member_count, type->members[0].speed, type->members[type->member_count - 1].speed);
    text->failed |= !name || !image;
    free(name);
    free(image);
}

/* Of a cluster each image once that members one after another have; its own where that has speeds. */
static void add_images(sp_text *text, const sp_nozzle_type *type)
{
    if (sp_type_is_measured(type) || sp_type_has_layers(type)) {
        add_image(text, type);
        return;
    }
    for (size_t i = 0; i < type->member_count; ++i) {
        const sp_nozzle_type *own = &type->members[i].type;
        if (sp_type_is_measured(own) && (i == 0 || strcmp(own->image, type->members[i - 1].type.image) != 0))
            add_image(text, own);
    }
}

void sp_page_spread(sp_text *text, const sp_result *result, const sp_evaluator *evaluator)
{
    sp_text_add(text, "liquid spread evenly over the spray angle");
    if (rotates(result, evaluator))
        sp_text_add(text, "; of those that rotate the mean over time, which is what every flux and film here is: while "
                          "the jet passes there is more, and then none");
    for (size_t i = 0; i < result->design_count; ++i)
        for (size_t k = 0; result->designs[i].evaluator == evaluator && k < result->designs[i].layout->count; ++k)
            if (!sp_page_type_repeats(result, evaluator, i, k))
                add_images(text, result->designs[i].layout->nozzles[k].type);
}
