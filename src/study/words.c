#include "words.h"

#include "report/markup.h"

#include <inttypes.h>

const char *sp_word_trajectory(const sp_fidelity *fidelity)
{
    return fidelity->trajectory == SP_TRAJECTORY_LINE ? "line" : "parabola"; /* study takes no others */
}

const char *sp_word_method(const sp_fidelity *fidelity)
{
    return fidelity->method == SP_METHOD_INVERSE ? "inverse" : "forward";
}

void sp_words_texel(sp_text *text, double texel)
{
    sp_text_add(text, "%.3g mm", 1e3 * texel);
}

void sp_words_count(sp_text *text, uint64_t count)
{
    if (count >= 1000) {
        sp_words_count(text, count / 1000);
        sp_text_add(text, ",%03" PRIu64, count % 1000);
    } else
        sp_text_add(text, "%" PRIu64, count);
}

void sp_words_run(sp_text *text, const sp_fidelity *fidelity, bool texel, bool jets)
{
    sp_text_add(text, "%s, %s", sp_word_method(fidelity), sp_word_trajectory(fidelity));
    if (texel) {
        sp_text_add(text, ", ");
        sp_words_texel(text, fidelity->texel);
    }
    if (fidelity->method == SP_METHOD_INVERSE)
        return;
    if (jets) {
        sp_text_add(text, ", ");
        sp_words_count(text, fidelity->jets);
        sp_text_add(text, " jets");
    }
    if (fidelity->reflections > 0)
        sp_text_add(text, ", %d reflection%s", fidelity->reflections, fidelity->reflections > 1 ? "s" : "");
}

void sp_words_place(sp_text *text, const sp_study_place *place)
{
    sp_text_add(text, "%s, texel ", sp_word_trajectory(&place->fidelity));
    sp_words_texel(text, place->fidelity.texel);
    if (!place->refine)
        sp_text_add(text, ", not refined");
    if (place->limited) {
        sp_text_add(text, ", ");
        sp_markup_significant(text, place->limit, 2);
        sp_text_add(text, " s");
    }
}
