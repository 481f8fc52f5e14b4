#include "words.h"

#include "report/markup.h"

#include <inttypes.h>

const char *sp_word_trajectory(const sp_fidelity *fidelity)
{
    return fidelity->trajectory == SP_TRAJECTORY_LINE   ? "line"
           : fidelity->trajectory == SP_TRAJECTORY_DRAG ? "drag"
                                                        : "parabola"; /* nothing is left to auto */
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

size_t sp_words_notes(const sp_study *study, const char *notes[SP_STUDY_NOTES])
{
    bool drag = study->reference.trajectory == SP_TRAJECTORY_DRAG, film = study->reference_film_cell > 0;
    size_t count = 0;
    notes[count++] =
        drag ? "Lines and parabolas leave out the drag that the scene sets; the size of drops is not varied."
             : "Air drag is left out, as by the scene: trajectory: drag takes it in.";
    notes[count++] = film ? "Film is routed from the first impacts by the inverse evaluator, on 30,000 cells at most: "
                            "jets, reflections and finer texels leave it as it is."
                          : "Film on walls is left out, as by the scene: criterion: {film: ...} takes it in.";
    if (study->passing)
        notes[count++] = "Goods are looked at in positions a texel apart at most, which vary with the texel alone; "
                         "jets are spread over the pass.";
    if (study->place_count && study->reference.reflections > 0)
        notes[count++] = "Placements are searched for and judged by first impacts, without what walls throw back.";
    return count;
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
