/* What the page was made of, and how. */
#include "page.h"

#include <sprayplan/sprayplan.h>

#include <stdlib.h>

static void add_text(sp_text *text, const char *bytes)
{
    char *safe = sp_text_utf8(bytes);
    if (safe)
        sp_markup_escape(text, safe);
    text->failed |= !safe;
    free(safe);
}

void sp_page_inputs(const sp_page *page, sp_text *text)
{
    const sp_result *result = page->result;
    if (result->input_count == 0)
        return;
    sp_text_add(text, "<section id=\"inputs\"><h2>What was read</h2>\n<table class=\"small\"><thead><tr><th "
                      "scope=\"col\">File</th><th scope=\"col\" class=\"text\">SHA-256</th></tr></thead>\n<tbody>\n");
    for (size_t i = 0; i < result->input_count; ++i) {
        sp_text_add(text, "<tr><th scope=\"row\">");
        add_text(text, result->inputs[i].path);
        sp_text_add(text, "</th><td class=\"text digest\">%s</td></tr>\n", result->inputs[i].sha256);
    }
    sp_text_add(text, "</tbody></table></section>\n");
}

void sp_page_foot(const sp_page *page, sp_text *text)
{
    const sp_result *result = page->result;
    sp_text_add(text, "<footer id=\"made\">Made by sprayplan " SP_VERSION);
    if (result->date) {
        sp_text_add(text, ", ");
        add_text(text, result->date);
    }
    if (result->command_line) {
        sp_text_add(text, ", by <code>");
        add_text(text, result->command_line);
        sp_text_add(text, "</code>");
    }
    sp_text_add(text, ".</footer>\n");
}
