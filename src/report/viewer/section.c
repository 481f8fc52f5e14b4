/* The viewer's place in the page. Hidden until its script finds that it can draw. */
#include "model.h"
#include "script.h"

static void add_style(sp_text *text)
{
    sp_text_add(text, "<style>\n");
    sp_text_append(text, sp_viewer_style, (size_t)(sp_viewer_style_end - sp_viewer_style));
    sp_text_add(text, "</style>\n");
}

bool sp_page_viewer(const sp_page *page, sp_text *text, sp_error *error)
{
    bool any = false;
    for (size_t i = 0; i < page->result->design_count; ++i)
        any |= page->result->designs[i].evaluator != NULL;
    if (!any)
        return true;
    add_style(text);
    sp_text_add(text, "<section id=\"viewer\" hidden><h2>Look around</h2></section>\n"
                      "<script type=\"application/json\" id=\"viewer-model\">");
    if (!sp_viewer_model(page, text, error))
        return false;
    sp_text_add(text, "</script>\n");
    return true;
}

void sp_page_viewer_script(sp_text *text)
{
    sp_text_add(text, "<script>\n");
    sp_text_append(text, sp_viewer_script, (size_t)(sp_viewer_script_end - sp_viewer_script));
    sp_text_add(text, "</script>\n");
}
