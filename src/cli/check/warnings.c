/* What looks wrong in a scene. */
#include "findings.h"

#include <stdarg.h>

#define NOTHING 1e-6 /* of a part's area: round-off */
#define FAR_OFF 0.01 /* of a body's volume, for that of its triangles */

__attribute__((format(printf, 2, 3))) static void warn(cli_findings *found, const char *format, ...)
{
    if (found->warning_count == CLI_WARNINGS)
        return;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(found->warnings[found->warning_count++], sizeof *found->warnings, format, arguments);
    va_end(arguments);
}

static void warn_of_mesh(cli_findings *found)
{
    const sp_mesh_diagnosis *mesh = &found->mesh;
    if (cli_findings_setup(found)->cavity == SP_CAVITY_NONE && mesh->closed_shells)
        warn(found,
             "cavity: found none, and %zu bodies are closed: both sides of their walls take liquid and count "
             "once; name a point of the space where the liquid flies",
             mesh->closed_shells);
    if (cli_findings_setup(found)->mesh->tangled)
        warn(
            found,
            "geometry: %zu polygons cross their own outline, or nearly so: cut as fans from their first corners, which "
            "may cover what they do not",
            cli_findings_setup(found)->mesh->tangled);
    if (mesh->degenerate.count)
        warn(found, "geometry: %zu degenerate triangles are left out", mesh->degenerate.count);
    if (mesh->non_manifold_edges.count)
        warn(found, "geometry: %zu edges belong to three or more triangles", mesh->non_manifold_edges.count);
    if (mesh->flipped_edges.count)
        warn(found, "geometry: at %zu edges neighbours disagree which side is the front", mesh->flipped_edges.count);
    if (mesh->duplicate_triangles.count)
        warn(found, "geometry: %zu triangles are there twice", mesh->duplicate_triangles.count);
    if (mesh->cracks.count)
        warn(found, "geometry: %zu corners on open edges lie within %.2g m of others and are not joined to them",
             mesh->cracks.count, mesh->crack);
    if (mesh->crossings.count)
        warn(found, "geometry: %zu pairs of triangles of one shell run through each other", mesh->crossings.count);
    if (mesh->bits.count)
        warn(found, "geometry: %zu loose bits have next to no area", mesh->bits.count);
}

/* A file whose unit is not what the scene says is a thousand times too large or too small, or 25 times. */
static void warn_of_size(cli_findings *found)
{
    for (size_t i = 0; i < found->size_count; i++) {
        char text[sizeof *found->warnings];
        if (found->sizes[i].plausible)
            continue;
        cli_size_ask(&found->sizes[i], i, text, sizeof text);
        warn(found, "%s", text);
    }
}

static void warn_of_texel(cli_findings *found)
{
    char text[CLI_LONG_TEXEL];
    if (cli_warn_of_long_texel(sp_scene_setup(found->opened->scene), text))
        warn(found, "%s", text);
}

static void warn_of_criterion(cli_findings *found)
{
    char text[CLI_LARGE_THRESHOLD];
    if (cli_warn_of_large_threshold(sp_scene_setup(found->opened->scene), text))
        warn(found, "%s", text);
}

/* What a CAD file says that cannot be, and bodies that their triangles do not give. */
static void warn_of_cad(cli_findings *found)
{
    const sp_mesh *mesh = cli_findings_setup(found)->mesh;
    uint32_t last = mesh->part_count ? mesh->parts[mesh->part_count - 1].geometry : 0;
    for (uint32_t i = 0; i <= last; i++) {
        const sp_cad_account *cad = sp_scene_cad(found->opened->scene, i);
        if (cad && cad->faults)
            warn(found, "geometry: file %lu has %zu faults that may cost it surface or size, the first: %s",
                 (unsigned long)i, cad->faults, cad->fault);
    }
    for (size_t i = 0; i < mesh->part_count; i++) {
        double body = mesh->parts[i].volume, own = found->part_volume[i];
        if (fabs(body) > 0 && !(fabs(own) > 0))
            warn(found, "part \"%s\": a solid in its file, but its triangles are not closed", mesh->parts[i].name);
        else if (fabs(own - body) > FAR_OFF * fabs(body) && fabs(body) > 0)
            warn(found, "part \"%s\": its triangles enclose %.6g m3, its body %.6g m3; a shorter `chord` may help",
                 mesh->parts[i].name, own, body);
    }
}

static void warn_of_cavity(cli_findings *found)
{
    const sp_setup *setup = cli_findings_setup(found);
    sp_vec3 p = cli_findings_outside(found, setup->cavity_point), low = found->mesh.minimum, high = found->mesh.maximum;
    if (setup->cavity == SP_CAVITY_POINT &&
        (p.x < low.x || p.y < low.y || p.z < low.z || p.x > high.x || p.y > high.y || p.z > high.z))
        warn(found, "cavity: the point lies outside the geometry's box: what is counted is what faces it from there");
}

static void warn_of_sides(cli_findings *found)
{
    const sp_mesh *mesh = cli_findings_setup(found)->mesh;
    for (size_t i = 0; i < mesh->part_count; i++)
        if (found->part_sides[i].both > NOTHING * found->part_area[i])
            warn(found,
                 "part \"%s\": %.4g m2 of closed shells are wet on both sides; a shell may run through itself or be "
                 "there twice",
                 mesh->parts[i].name, found->part_sides[i].both);
}

/* Where the flood got out: harmless through an outlet under which nothing stands, and not where it reaches surface. */
static void warn_of_openings(cli_findings *found)
{
    double outdoors = sp_evaluator_outdoors(found->opened->evaluator);
    if (!(outdoors > 0))
        return;
    warn(
        found,
        "cavity: %.4g m2 of surface under the sky are seen through openings, and left out; see openings, and shut with "
        "a lid or `caps:` what is shut in use",
        outdoors);
}

static void warn_of_caps(cli_findings *found)
{
    const sp_setup *setup = cli_findings_setup(found);
    for (size_t i = 0; i < setup->cap_count; i++) {
        sp_cap_use use = sp_evaluator_cap_use(found->opened->evaluator, i);
        char point[CLI_POINT];
        cli_point_text(cli_findings_outside(found, setup->caps[i].point), cli_findings_step(found), " m", point);
        if (use != SP_CAP_SHUTS)
            warn(found, "caps: the one at [%s] shuts nothing: %s", point,
                 use == SP_CAP_DRY ? "no liquid comes to it" : "liquid passes round its rim");
    }
}

static void warn_of_hollows(cli_findings *found)
{
    size_t count;
    const sp_hollow *hollows = sp_evaluator_hollows(found->opened->evaluator, &count);
    for (size_t i = 0; i < count && !hollows[i].drains; i++) {
        char place[CLI_POINT];
        cli_point_text(cli_findings_outside(found, hollows[i].place), cli_findings_step(found), " m", place);
        warn(found, "film: what runs down to [%s] stands there: is a drain missing?", place);
    }
}

/* Whether a nozzle before nozzle i sprays as it does. */
static bool is_doubled(const sp_layout *layout, size_t i)
{
    size_t earlier = 0;
    while (earlier < i && !sp_nozzles_spray_alike(&layout->nozzles[earlier], &layout->nozzles[i]))
        earlier++;
    return earlier < i;
}

/* Of the port that holds both the breach is reported. */
static bool share_port(const cli_findings *found, const sp_nozzle *a, const sp_nozzle *b)
{
    const sp_setup *setup = sp_scene_setup(found->opened->scene);
    const sp_place_options place = sp_scene_place_options(found->opened->scene);
    size_t mount = sp_mount_at(setup, place.mounts, place.mount_count, a->position);
    return mount != SIZE_MAX && place.mounts[mount].kind == SP_MOUNT_PORT &&
           sp_mount_at(setup, &place.mounts[mount], 1, b->position) == 0;
}

static void warn_of_overlap(cli_findings *found, const sp_layout *layout, size_t i)
{
    char text[SP_OVERLAP_TEXT];
    size_t other = sp_layout_overlap(layout, i, text);
    if (other != SIZE_MAX && !share_port(found, &layout->nozzles[other], &layout->nozzles[i]))
        warn(found, "nozzles: %s", text);
}

static bool warn_of_nozzles(cli_findings *found, sp_error *failure)
{
    const sp_layout *layout = sp_scene_layout(found->opened->scene);
    for (size_t i = 0; i < layout->count; i++) {
        sp_error error = {0};
        if (!cli_admits(found->opened, &layout->nozzles[i], &error))
            warn(found, "%s", error.message);
        if (is_doubled(layout, i))
            warn(found, "nozzle \"%s\": one before it is of the same type, in the same place and aimed alike",
                 layout->nozzles[i].name);
        else
            warn_of_overlap(found, layout, i);
        if (error.kind == SP_ERROR_MEMORY)
            return sp_fail_memory(failure);
    }
    return true;
}

static void warn_of_mount(void *user, const char *text)
{
    warn(user, "%s", text);
}

bool cli_findings_warn(cli_findings *found, sp_error *error)
{
    warn_of_mesh(found);
    warn_of_size(found);
    warn_of_texel(found);
    warn_of_criterion(found);
    warn_of_cad(found);
    warn_of_cavity(found);
    warn_of_sides(found);
    warn_of_openings(found);
    warn_of_caps(found);
    warn_of_hollows(found);
    if (!warn_of_nozzles(found, error))
        return false;
    cli_warn_of_port_breaches(found->opened, warn_of_mount, found);
    cli_warn_of_kept_limits(found->opened, warn_of_mount, found);
    return !sp_scene_has_place(found->opened->scene) ||
           cli_warn_of_idle_mounts(found->opened, warn_of_mount, found, error);
}
