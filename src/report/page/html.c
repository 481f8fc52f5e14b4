/* The report as one self-contained page: nothing fetched, and all but the viewer there without its script. */
#include "report/page.h"
#include "report/viewer/live.h"
#include "result/design.h"

#include <sprayplan/sprayplan.h>

#include <stdlib.h>
#include <string.h>

#define MOST_COLUMNS 6 /* of designs, in a table that is as wide as the page */

#define LIGHT_COLOURS                                                                                                  \
    "--ink:#1b2730;--soft:#55636f;--line:#d6dde3;--pale:#f3f6f8;--accent:#0b6670;--paper:#fff;--alarm:#c42636;"        \
    "--alert:#fcf1f1"
#define LIGHT ":root{" LIGHT_COLOURS ";color-scheme:light dark}\n"
/* Pictures, the chart and the viewer's canvas are of one set of colours, made for white. */
#define DARK                                                                                                           \
    "@media screen and (prefers-color-scheme:dark){:root{--ink:#e3e9ed;--soft:#a3b1bb;--line:#37434c;--pale:#1d262d;"  \
    "--accent:#58c4ce;--paper:#12181c;--alarm:#ff8a94;--alert:#3a2023}"                                                \
    ".view,.chart,.stage{" LIGHT_COLOURS ";background:#fff;color:var(--ink)}}\n"

static const char *const style[] = {
    "<style>\n" LIGHT DARK "*{box-sizing:border-box}\nbody{margin:0;background:var(--paper);color:var(--ink);"
    "font:16px/1.5 system-ui,\"Segoe UI\",Roboto,\"Helvetica Neue\",\"DejaVu Sans\",Arial,sans-serif}\n"
    "main{max-width:1120px;margin:0 auto;padding:0 28px 40px}\nheader{border-top:6px solid var(--accent);padding:26px "
    "0 8px}\n"
    "h1{font-size:27px;line-height:1.25;margin:0;overflow-wrap:anywhere}\n"
    "h2{font-size:20px;margin:42px 0 12px;padding-bottom:5px;border-bottom:1px solid var(--line)}\n"
    "h3{font-size:16px;margin:22px 0 8px;color:var(--soft);font-weight:600}\n"
    ".about{color:var(--soft);margin:4px 0 0}\n.headline{font-size:20px;line-height:1.45;margin:18px 0}\n"
    ".warning{border-left:4px solid var(--alarm);background:var(--alert);padding:10px 14px;margin:12px 0}\n"
    ".note,.unit{color:var(--soft);font-weight:400}\n.note{font-size:14px;max-width:80ch}\n.unit{font-size:.86em}\n",
    ".cards{display:grid;grid-template-columns:repeat(auto-fit,minmax(190px,1fr));gap:14px}\n"
    ".card{background:var(--pale);border-radius:6px;padding:12px 16px}\n.card "
    ".title{font-size:14px;color:var(--soft)}\n"
    ".card .value{font-size:27px;font-weight:600;line-height:1.35}\n.card .unit{font-size:16px}\n.card "
    ".against{font-size:14px;color:var(--soft)}\n"
    ".wide{overflow-x:auto;margin:0 0 "
    "18px}\ntable{border-collapse:collapse;width:100%;font-variant-numeric:tabular-nums}\n"
    "caption{text-align:left;font-weight:600;padding:8px 0}\n"
    "th,td{padding:6px 10px;border-bottom:1px solid var(--line);text-align:right;vertical-align:top}\n"
    "thead th{border-bottom:2px solid var(--ink);font-size:14px;vertical-align:bottom}\n"
    "th[scope=row],th:first-child,.text{text-align:left}\nth[scope=row]{font-weight:500}\n"
    ".sub th:first-child{text-align:right}\nth,td{overflow-wrap:break-word;hyphens:manual}.lack{white-space:nowrap}\n"
    "td.decided{font-weight:600}\n.small{font-size:13.5px}\n"
    /* "Nozzle-12" does not break at its hyphen */
    ".small th[scope=row]{min-width:10ch}\n.small th,.small td{padding:4px 7px}\n.narrow{width:auto;min-width:280px}\n",
    ".views{display:grid;gap:18px;align-items:end}\n.of1{grid-template-columns:minmax(0,640px)}\n"
    ".of2{grid-template-columns:repeat(2,minmax(0,1fr))}\n.of3{grid-template-columns:repeat(3,minmax(0,1fr))}\n"
    "figure{margin:0}\nfigcaption{text-align:center;font-size:14px;font-weight:600;overflow-wrap:anywhere}\n"
    ".view{display:block;width:100%;height:auto;max-height:640px;overflow:visible}\n"
    ".spray{fill:#fff;fill-opacity:.13;stroke:#10202a;stroke-width:2;stroke-linejoin:round}\n"
    ".rim{fill:none;stroke:#10202a;stroke-width:1.2;stroke-opacity:.6}\n"
    ".nozzle{fill:#fff;stroke:#10202a;stroke-width:4}\n"
    ".name{font-size:26px;font-weight:600;fill:#10202a;stroke:#fff;stroke-width:6;stroke-linejoin:round;paint-order:"
    "stroke}\n"
    "path.axis{fill:none;stroke:var(--ink);stroke-width:2.5}.length{font-size:22px;fill:var(--ink)}"
    ".lead{stroke:#10202a;stroke-width:1.5}\n"
    ".shadow{fill:#fff;stroke:#c42636;stroke-width:2.5}\n.number{font-size:20px;font-weight:700;fill:#a51526;"
    "text-anchor:middle}\n"
    ".chart,.bar{display:block;width:100%;max-width:860px;height:auto;font-size:13px}\n.chart text,.bar "
    "text{fill:var(--ink)}\n"
    ".grid{stroke:var(--line)}\n.tick{stroke:var(--ink);fill:none}\n.swatch{stroke:#8b97a1}\n"
    ".front{fill:none;stroke:#0b6670;stroke-width:2}\n.point{fill:#0b6670}\n"
    ".bound{fill:none;stroke:#8a5a00;stroke-width:1.5;stroke-dasharray:6 4}\n"
    /* Terms hold names of any length. */
    "dl{display:grid;grid-template-columns:fit-content(16em) minmax(0,1fr);gap:6px 22px;margin:0}\n"
    "dt{font-weight:600}\ndd{margin:0}\ndt,dd{overflow-wrap:anywhere}\n"
    "footer{margin-top:44px;padding-top:12px;border-top:1px solid var(--line);color:var(--soft);font-size:14px}\n"
    ".digest,code{overflow-wrap:anywhere;font-family:ui-monospace,\"DejaVu Sans Mono\",monospace;font-size:.92em}\n",
    "@media (max-width:640px){.of2,.of3{grid-template-columns:1fr}dl{grid-template-columns:1fr}}\n"
    /* The column that decides stays in sight: the one before refinement goes, and what is measured stands still. */
    "@media screen and (max-width:640px){main{padding:0 12px 30px}body{font-size:15px}.aside{display:none}"
    "th,td{padding:5px 6px}.numbers{font-size:14px}"
    ".wide :not(.sub)>th:first-child{position:sticky;left:0;background:var(--paper);z-index:1}"
    ".decided{position:sticky;right:0;background:var(--paper);box-shadow:-1px 0 var(--line)}}\n",
    /* Drawings are no smaller than their letters can be read: where there is less room they scroll. */
    "@media screen{.chart,.bar{min-width:720px}}\n@media screen{.again{display:none}}\n@page{size:A4;margin:16mm 14mm "
    "18mm;@bottom-right{content:counter(page) \" / "
    "\" counter(pages);"
    "font:9pt system-ui,\"DejaVu Sans\",Arial,sans-serif;color:#55636f}}\n"
    "@media "
    "print{body{font-size:11pt;-webkit-print-color-adjust:exact;print-color-adjust:exact}main{max-width:none;padding:0}"
    "header{padding-top:10px}.wide{overflow:visible}.small{font-size:8.5pt}.small th,.small td{padding:2px 4px}"
    ".small thead th{font-size:8.5pt}.view{max-height:72mm}"
    ".cards{grid-template-columns:repeat(auto-fit,minmax(40mm,1fr))}.card{padding:8px 10px}.card "
    ".value{font-size:14pt}.card .unit{font-size:8.5pt}"
    /* A table that may be longer than a page breaks: held together, it would leave the page before it empty. */
    "figure,.card,.wide:not(:has(tbody>tr:nth-child(25))),tr,dl>div,.chart,.block{break-inside:avoid}thead{display:"
    "table-header-group}"
    "h2,h3,caption{break-after:avoid}a{color:inherit;text-decoration:none}"
    /* Each sheet goes to the workshop by itself. */
    ".sheet:not(:target){break-before:page;break-after:page}.alone,.early:not(:target){display:none}"
    "main:has(.sheet:target)>:not(header,.sheet:target,footer),"
    /* the heading tells of the main layout, and of a comparison all of the head of its first */
    "main:has(.sheet:not(#sheet):target) h1,main:not(:has(#sheet)):has(.sheet:target) header{display:none}"
    ".sheet:target h2,main:has(.sheet:target) footer{margin-top:16px}"
    "}\n</style>\n",
};

void sp_page_plain_name(const sp_page *page, sp_text *text, size_t design)
{
    const char *name = page->figures[design].name;
    if (design == page->manual)
        sp_text_add(text, "Manual");
    else if (design == page->greedy)
        sp_text_add(text, "Greedy, before refinement");
    else if (design == page->main && strcmp(name, "proposed") == 0)
        sp_text_add(text, "Proposed");
    else if (design == page->main && page->alternatives)
        sp_text_add(text, "%s (proposed)", name);
    else
        sp_text_add(text, "%s", name);
}

void sp_page_name(const sp_page *page, sp_text *text, size_t design)
{
    sp_text plain = {0};
    sp_page_plain_name(page, &plain, design);
    text->failed |= plain.failed;
    if (!plain.failed)
        sp_markup_escape(text, plain.text);
    free(plain.text);
}

const char *sp_page_aside(const sp_page *page, size_t design)
{
    return design == page->greedy ? " class=\"aside\"" : "";
}

const char *sp_page_column(const sp_page *page, size_t design)
{
    return design == page->main && page->result->design_count > 1 ? " class=\"decided\"" : sp_page_aside(page, design);
}

void sp_page_narrow_name(const sp_page *page, sp_text *text, size_t design)
{
    sp_text name = {0};
    sp_page_name(page, &name, design);
    text->failed |= name.failed;
    for (const char *at = name.text; !name.failed && *at; ++at)
        sp_text_add(text, *at == '/' ? "%c<wbr>" : "%c", *at);
    free(name.text);
}

size_t sp_page_fold(const sp_page *page, size_t first)
{
    size_t count = page->result->design_count, tables = count <= MOST_COLUMNS ? 1 : (count + 4) / 5;
    size_t end = first + (count + tables - 1) / tables;
    return end < count ? end : count;
}

void sp_page_columns(const sp_page *page, sp_text *text, size_t first, size_t end)
{
    for (size_t i = first; i < end; ++i) {
        sp_text_add(text, "<th scope=\"col\"%s>", sp_page_column(page, i));
        sp_page_narrow_name(page, text, i);
        sp_text_add(text, "</th>");
    }
}

void sp_page_error(sp_text *text, const sp_figures *figures)
{
    if (!isfinite(figures->error_estimate))
        return;
    sp_text_add(text, "&nbsp;\xc2\xb1&nbsp;");
    sp_markup_decimals(text, ceil(1e3 * figures->error_estimate - 1e-9) / 10, 1);
}

void sp_page_coverage(sp_text *text, const sp_figures *figures)
{
    sp_markup_decimals(text, 100 * figures->coverage, 1);
    sp_text_add(text, "&nbsp;%%");
    sp_page_error(text, figures);
}

void sp_page_cut(sp_text *text, const sp_proposal *proposal)
{
    for (size_t i = 0; i < proposal->cut_count; ++i)
        sp_text_add(text, "%s%s", i ? ", " : " (", proposal->cut[i]);
    sp_text_add(text, proposal->cut_count ? ")" : "");
}

const char *sp_page_cleaned(const sp_page *page)
{
    const sp_setup *setup = NULL;
    for (size_t i = 0; i < page->result->design_count && !setup; ++i)
        if (page->result->designs[i].evaluator)
            setup = sp_evaluator_setup(page->result->designs[i].evaluator);
    if (setup && setup->sweep.speed > 0)
        return "goods";
    if (!setup || setup->cavity == SP_CAVITY_NONE)
        return "surface";
    return setup->cavity == SP_CAVITY_POINT ? "vessel" : "machine";
}

const char *sp_page_colour(const sp_page *page, size_t design)
{
    static const char *const others[] = {"#3b5b92", "#b5542e", "#0b6670", "#7a4b8f", "#6b7a87", "#8a6d1d"};
    /* told from one another, from the manual layout's and the proposed one's */
    static const char *const of_alternatives[] = {"#7a4b8f", "#1f6fb5", "#3f7d3a", "#a3336b", "#8a6d1d", "#0b7d86"};
    if (design == page->manual)
        return "#b5542e";
    if (design == page->greedy)
        return "#6b7a87";
    if (design == page->main)
        return "#10202a";
    if (page->alternatives)
        return of_alternatives[design % (sizeof of_alternatives / sizeof *of_alternatives)];
    return others[design % (sizeof others / sizeof *others)];
}

/* Layouts of several runs are held against each other by price where all have theirs, else by water. */
static bool all_have_prices(const sp_page *page)
{
    bool all = true, any = false;
    for (size_t i = 0; i < page->result->design_count; ++i) {
        all = all && isfinite(page->figures[i].mount_cost);
        any = any || page->figures[i].mount_cost > 0;
    }
    return all && any;
}

/* Roles by name, but only in a result of place; in a comparison a file may be called anything. */
static void find_roles(sp_page *page)
{
    const sp_result *result = page->result;
    page->main = result->design_count == 1 ? 0 : SP_UNKNOWN;
    page->manual = page->greedy = SP_UNKNOWN;
    bool compared = strcmp(result->command, "compare") == 0;
    page->costly = compared ? all_have_prices(page) : sp_result_is_costly(result);
    if (compared)
        return;
    page->alternatives = sp_result_has_alternatives(result);
    if (page->alternatives)
        page->main = sp_result_proposed(result);
    for (size_t i = 0; i < result->design_count; ++i) {
        if (strcmp(result->designs[i].name, "proposed") == 0)
            page->main = i;
        if (strcmp(result->designs[i].name, "manual") == 0)
            page->manual = i;
        if (strcmp(result->designs[i].name, "greedy") == 0)
            page->greedy = i;
    }
}

void sp_page_head(sp_text *text, const char *title, const char *scene, bool live)
{
    sp_text_add(
        text,
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
        "content=\"width=device-width, initial-scale=1\">\n<meta http-equiv=\"Content-Security-Policy\" "
        "content=\"default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'%s\">\n"
        "<meta name=\"generator\" content=\"sprayplan " SP_VERSION "\">\n<title>%s: ",
        live ? " 'wasm-unsafe-eval'; worker-src blob:" : "", title);
    sp_markup_escape(text, scene);
    sp_text_add(text, "</title>\n");
    for (size_t i = 0; i < sizeof style / sizeof *style; ++i)
        sp_text_append(text, style[i], strlen(style[i]));
    sp_text_add(text, "</head>\n<body>\n<main>\n");
}

static void add_title(const sp_page *page, sp_text *text, const char *scene)
{
    sp_text_add(text, "<header><h1>%s</h1>\n<p class=\"about\">",
                page->alternatives                ? "Alternatives of spray nozzle layouts"
                : page->result->proposal          ? "Proposed spray nozzle layout"
                : page->result->design_count == 1 ? "Spray nozzle layout"
                                                  : "Spray nozzle layouts compared");
    sp_markup_escape(text, scene);
    if (page->result->design_count > 0 && page->figures[0].triangles != SP_UNKNOWN &&
        sp_figures_share_surface(page->figures, page->result->design_count)) {
        sp_text_add(text, " \xc2\xb7 %zu triangles, ", page->figures[0].triangles);
        sp_markup_significant(text, page->figures[0].clean_area, 4);
        sp_text_add(text, "&nbsp;m\xc2\xb2 to be cleaned");
    }
    sp_text_add(text, "</p></header>\n");
}

static bool add_page(sp_page *page, sp_text *text, const char *scene, sp_error *error)
{
    sp_page_head(text, "Spray nozzle layout", scene, page->live);
    add_title(page, text, scene);
    sp_page_out_of_reach(page, text);
    sp_page_headline(page, text);
    sp_page_differing(page, text);
    sp_page_attainable(page, text);
    sp_page_figures(page, text);
    sp_page_alternatives(page, text);
    sp_page_parts(page, text);
    sp_page_comparison(page, text);
    sp_page_liquid(page, text);
    sp_page_film(page, text);
    sp_page_tracks(page, text);
    sp_page_front_chart(page, text);
    sp_page_nozzle_counts(page, text);
    sp_page_certificate(page, text);
    if (!sp_page_viewer(page, text, error) || !sp_page_pictures(page, text, error))
        return false;
    sp_page_nozzles(page, text);
    if (!sp_page_sheets(page, text, error))
        return false;
    sp_page_contributions(page, text);
    sp_page_shadows(page, text);
    if (!sp_page_swabs(page, text, error))
        return false;
    sp_page_assumptions(page, text);
    sp_page_stages(page, text);
    sp_page_inputs(page, text);
    sp_page_foot(page, text);
    sp_text_add(text, "</main>\n");
    sp_page_viewer_script(page, text);
    sp_text_add(text, "</body>\n</html>\n");
    return true;
}

char *sp_page_html(const sp_result *result, size_t most_drawn, sp_error *error)
{
    sp_page page = {.result = result,
                    .scale = sp_colour_scale_of(result->designs, result->design_count, result->style),
                    .flux = sp_colour_scale_of(result->designs, result->design_count, (sp_picture_style){0}),
                    .most_drawn = most_drawn};
    sp_figures *figures = sp_result_figures(result, error);
    char *scene = sp_text_utf8(result->scene), *html = NULL;
    page.figures = figures;
    if (figures)
        find_roles(&page);
    page.live = !sp_page_not_live(&page);
    sp_text text = {0};
    if (!scene)
        sp_fail_memory(error);
    else if (figures && add_page(&page, &text, scene, error))
        html = sp_text_finish(&text, error);
    if (!html)
        free(text.text);
    sp_figures_destroy(figures, result->design_count);
    free(scene);
    return html;
}

char *sp_report_html(const sp_result *result, sp_error *error)
{
    if (!sp_result_is_whole(result, error))
        return NULL;
    return sp_page_html(result, SP_PAGE_MOST_DRAWN, error);
}
