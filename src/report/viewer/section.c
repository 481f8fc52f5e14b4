/* The viewer's place in the page. Hidden until its script draws there, or says that it cannot. */
#include "live.h"
#include "model.h"
#include "script.h"

#include <string.h>

static void add_style(sp_text *text)
{
    sp_text_add(text, "<style>\n");
    sp_text_append(text, sp_viewer_style, (size_t)(sp_viewer_style_end - sp_viewer_style));
    sp_text_add(text, "</style>\n");
}

static void add_drawn(const sp_viewer_drawn *drawn, sp_text *text)
{
    if (drawn->triangles < drawn->all)
        sp_text_add(
            text,
            "<p class=\"note\" id=\"drawn\">The geometry is too large to be drawn whole: below are %zu triangles "
            "of the %zu that face the liquid, up to %.2g mm off. Figures, also those of a point that is asked, are of "
            "the whole.</p>\n",
            drawn->triangles, drawn->all, 1e3 * drawn->cell);
}

bool sp_page_viewer(const sp_page *page, sp_text *text, sp_error *error)
{
    bool any = false;
    for (size_t i = 0; i < page->result->design_count && page->result->picture_share >= 0; ++i)
        any |= page->result->designs[i].evaluator != NULL;
    if (!any)
        return true;
    sp_viewer_drawn drawn;
    add_style(text);
    sp_text_add(text, "<script type=\"application/json\" id=\"viewer-model\">");
    if (!sp_viewer_model(page, text, &drawn, error))
        return false;
    sp_text_add(text, "</script>\n<section id=\"viewer\" hidden><h2>Look around</h2>\n");
    add_drawn(&drawn, text);
    sp_text_add(text, "</section>\n");
    const char *why = sp_page_not_live(page);
    if (why && *why)
        sp_text_add(text,
                    "<p class=\"note\" id=\"not-live\">This page shows the layouts and evaluates no others: %s.</p>\n",
                    why);
    return !page->live || sp_page_live(page, text, error);
}

/* Past a comment that has its lines to itself, or no further than `script`. */
static const char *skip_comment(const char *script)
{
    const char *close = strncmp(script, "/*", 2) == 0 ? strstr(script, "*/\n") : NULL, *first = strstr(script, "*/");
    return close && close == first ? close + 3 : script;
}

/* Without comments and what lines are set in by: a quarter of it. */
void sp_page_script(sp_text *text, const char *script, const char *end)
{
    while (script < end) {
        script += strspn(script, " ");
        const char *code = skip_comment(script);
        if (code > script) {
            script = code;
            continue;
        }
        size_t line = strcspn(script, "\n");
        sp_text_append(text, script, line + (script + line < end));
        script += line + 1;
    }
}

void sp_page_viewer_script(const sp_page *page, sp_text *text)
{
    sp_text_add(text, "<script>\n");
    sp_page_script(text, sp_viewer_script, sp_viewer_script_end);
    if (page->live)
        sp_page_script(text, sp_live_loader, sp_live_loader_end);
    sp_text_add(text, "</script>\n");
}
