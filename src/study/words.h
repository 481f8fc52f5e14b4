/* Settings in words, for tables, legends and files. */
#ifndef STUDY_WORDS_H
#define STUDY_WORDS_H

#include "result/growing_text.h"

#include <sprayplan/study.h>

const char *sp_word_trajectory(const sp_fidelity *fidelity); /* "line", "parabola", "drag" */
const char *sp_word_method(const sp_fidelity *fidelity);     /* "inverse", "forward" */
/* The edge as "10 mm" or "10.3 mm", to three digits. */
void sp_words_texel(sp_text *text, double texel);
/* The number as "1,000,000". */
void sp_words_count(sp_text *text, uint64_t count);
/* Of a run: "inverse, parabola" or "forward, line, 100,000 jets, 2 reflections"; with its texel or without. */
void sp_words_run(sp_text *text, const sp_fidelity *fidelity, bool texel, bool jets);
/* Sentences on what is left out, and on what no setting varies; how many. */
enum { SP_STUDY_NOTES = 4 };
size_t sp_words_notes(const sp_study *study, const char *notes[SP_STUDY_NOTES]);
/* Of a placement's group: "parabola, texel 20 mm, not refined, 5.0 s". */
void sp_words_place(sp_text *text, const sp_study_place *place);

#endif
