/* What was made of a geometry, in words. */
#include <sprayplan/evaluator.h>
#include <sprayplan/result.h>

#include <stdarg.h>
#include <stdio.h>

typedef struct {
    sp_geometry_clause *clauses;
    size_t count;
} clause_list;

#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
static void
add(clause_list *list, bool doubtful, const char *format, ...)
{
    sp_geometry_clause *clause = &list->clauses[list->count++];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(clause->text, sizeof clause->text, format, arguments);
    va_end(arguments);
    clause->doubtful = doubtful;
}

static const char *plural(size_t count)
{
    return count == 1 ? "" : "s";
}

static void add_cad(clause_list *list, const sp_cad_account *cad)
{
    if (!cad->triangles)
        return;
    add(list, false, "CAD surfaces are cut into triangles no farther than %.3g mm from them, %.3g\xc2\xb0 a step",
        1e3 * cad->chord, cad->angle * 180 / M_PI);
    if (cad->mended)
        add(list, true, "%zu triangle%s without area among these %s mended", cad->mended, plural(cad->mended),
            cad->mended == 1 ? "is" : "are");
    if (cad->sewn)
        add(list, true, "%zu CAD face%s of no solid %s sewn to others within %.2g mm", cad->sewn, plural(cad->sewn),
            cad->sewn == 1 ? "is" : "are", 1e3 * cad->sewing);
    if (cad->faults)
        add(list, true, "%zu fault%s in CAD files may cost surface or size, the first: %s", cad->faults,
            plural(cad->faults), cad->fault);
}

static void add_shells(clause_list *list, const sp_geometry_account *account)
{
    if (account->closed)
        add(list, false, "%zu closed shell%s %s taken for bodies and rooms", account->closed, plural(account->closed),
            account->closed == 1 ? "is" : "are");
    size_t turned = account->turned.count;
    if (turned)
        add(list, true, "%zu closed shell%s drawn inside out %s turned round", turned, plural(turned),
            turned == 1 ? "is" : "are");
    if (account->open)
        add(list, false, "%zu open shell%s of %.4g m\xc2\xb2 %s: both sides count where liquid reaches them",
            account->open, plural(account->open), account->open_area, account->open == 1 ? "is a sheet" : "are sheets");
}

static void add_sides(clause_list *list, const sp_geometry_account *account)
{
    if (account->sides.inside > 0 || account->sides.touching > 0)
        add(list, false, "%.4g m\xc2\xb2 lie in other bodies and %.4g m\xc2\xb2 on other surfaces, and are left out",
            account->sides.inside, account->sides.touching);
    if (account->sides.both > 0)
        add(list, true, "%.4g m\xc2\xb2 of closed shells are wet on both sides and count twice", account->sides.both);
    if (account->outdoors > 0)
        add(list, true, "%.4g m\xc2\xb2 under the sky, seen through openings alone, are left out", account->outdoors);
}

/* Where film is asked for: it runs over them. */
static void add_cracks(clause_list *list, const sp_evaluator *evaluator)
{
    double width;
    const sp_flaw *cracks = sp_evaluator_cracks(evaluator, &width);
    size_t count = cracks ? cracks->count : 0;
    if (!count)
        return;
    sp_vec3 at = sp_setup_outside(sp_evaluator_setup(evaluator), cracks->place[0]);
    add(list, true,
        "%zu corner%s on open edges %s within %.2g mm of others and %s not joined to them, first at [%.4g m, %.4g m, "
        "%.4g m]: film crosses cracks thinner than itself, but some may be lost there; `check --repair` mends them",
        count, plural(count), count == 1 ? "lies" : "lie", 1e3 * width, count == 1 ? "is" : "are", at.x, at.y, at.z);
}

size_t sp_geometry_clauses(const sp_evaluator *evaluator, sp_geometry_clause clauses[SP_GEOMETRY_CLAUSES])
{
    clause_list list = {clauses, 0};
    sp_geometry_account account = sp_evaluator_account(evaluator);
    add_cad(&list, &sp_evaluator_setup(evaluator)->cad);
    if (account.left_out)
        add(&list, true, "%zu triangle%s without area %s left out", account.left_out, plural(account.left_out),
            account.left_out == 1 ? "is" : "are");
    add_shells(&list, &account);
    add_cracks(&list, evaluator);
    add_sides(&list, &account);
    return list.count;
}
