/* What of the scene's own nozzles goes against the ports that they stand in, which `place` keeps to and a layout of
 * today may not. The bore aside, which is asked of every layout (sp_mounts_admit). */
#include "cli.h"

#include <math.h>
#include <stdarg.h>

#define LEAN_SLACK 0.01 /* rad, by which an axis may be written too slanted */
#define SAME_AXIS 1e-6  /* by which the cosine of two axes may lack 1 for them to be one */
#define OFF_A_STEP 0.1  /* of a step, by which a setting may be written wrong, and no more than LEAN_SLACK */
#define OFF_DEPTH 1e-3  /* m; or than that of a depth */

typedef struct {
    const sp_setup *setup;
    const sp_layout *layout;
    sp_place_options place;
    cli_warning_handler *warn;
    void *user;
} inspection;

__attribute__((format(printf, 2, 3))) static void say(const inspection *own, const char *format, ...)
{
    char text[320];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    own->warn(own->user, text);
}

static bool holds(const inspection *own, const sp_mount *mount, sp_vec3 point)
{
    return sp_mount_at(own->setup, mount, 1, point) == 0;
}

/* The first port that a point lies in, as the sheet has it; NULL where it lies in none. */
static const sp_mount *port_at(const inspection *own, sp_vec3 point)
{
    for (size_t i = 0; i < own->place.mount_count; i++)
        if (own->place.mounts[i].kind == SP_MOUNT_PORT && holds(own, &own->place.mounts[i], point))
            return &own->place.mounts[i];
    return NULL;
}

static void check_type(const inspection *own, const sp_mount *port, const sp_nozzle *nozzle)
{
    sp_mount wide = *port;
    wide.bore = 0;
    if (sp_mount_takes(&wide, nozzle->type))
        return;
    char names[160] = "";
    for (size_t i = 0, used = 0; i < port->type_count && used < sizeof names; i++)
        used += (size_t)snprintf(names + used, sizeof names - used, "%s%s", i ? ", " : "", port->types[i]->name);
    say(own, "nozzle \"%s\": in port %s, of type '%s', expected one of the port's types: %s", nozzle->name, port->name,
        nozzle->type->name, names);
}

static double tilt_in(const sp_mount *port, const sp_nozzle *nozzle)
{
    return atan2(sp_length(sp_cross(port->axis, nozzle->axis)), sp_dot(port->axis, nozzle->axis));
}

static void check_tilt(const inspection *own, const sp_mount *port, const sp_nozzle *nozzle)
{
    double tilt = tilt_in(port, nozzle);
    if (tilt > port->tilt + LEAN_SLACK)
        say(own, "nozzle \"%s\": in port %s, tilted by %.1f deg from its axis, expected no more than %.1f deg",
            nozzle->name, port->name, tilt * 180 / M_PI, port->tilt * 180 / M_PI);
}

/* What of a lance is set, in SI, and how it is written: in a unit of which `per` make one of SI. */
typedef struct {
    sp_step step;
    double from, value, low, high, slack;
    const char *words, *unit;
    double per;
} setting;

/* A setting between those that the step leaves. */
static void check_step(const inspection *own, const sp_mount *port, const sp_nozzle *nozzle, setting s)
{
    double size = sp_step_size(s.step), nearest = sp_step_nearest(s.step, s.from, s.value, s.low, s.high);
    if (size > 0 && fabs(s.value - nearest) > fmin(s.slack, OFF_A_STEP * size))
        say(own, "nozzle \"%s\": in port %s, %s %.5g %s, expected a step of %.5g %s: it can be mounted at %.5g %s",
            nozzle->name, port->name, s.words, s.per * s.value, s.unit, s.per * size, s.unit, s.per * nearest, s.unit);
}

/* Of a tilt beyond the port's that is reported alone. */
static void check_steps(const inspection *own, const sp_mount *port, const sp_nozzle *nozzle)
{
    double depth = sp_dot(sp_sub(nozzle->position, port->position), port->axis), tilt = tilt_in(port, nozzle);
    check_step(own, port, nozzle,
               (setting){port->depth_step, port->depth_from, depth, port->depth_from, port->depth_to, OFF_DEPTH,
                         "at a depth of", "mm", 1e3});
    if (tilt <= port->tilt + LEAN_SLACK)
        check_step(own, port, nozzle,
                   (setting){port->tilt_step, 0, tilt, 0, port->tilt, LEAN_SLACK, "tilted by", "deg", 180 / M_PI});
}

static void check_occupancy(const inspection *own, const sp_mount *port, size_t index)
{
    const sp_nozzle *nozzles = own->layout->nozzles;
    size_t first = 0;
    while (first < index && port_at(own, nozzles[first].position) != port)
        first++;
    if (first < index)
        say(own, "nozzle \"%s\": in port %s, as \"%s\" is, expected one nozzle in a port", nozzles[index].name,
            port->name, nozzles[first].name);
}

/* How deep in a port a point lies that is on its axis, beyond its depths or not, m; INFINITY where it is not. */
static double depth_in(const inspection *own, const sp_mount *mount, sp_vec3 point)
{
    double depth = sp_dot(sp_sub(point, mount->position), mount->axis);
    sp_mount reaching = *mount;
    reaching.depth_from = 0;
    reaching.depth_to = fmax(0, depth);
    return mount->kind == SP_MOUNT_PORT && holds(own, &reaching, point) ? depth : INFINITY;
}

/* One that no mount holds and that stands on a port's axis, of several that of the nearest mouth. */
static void check_depth(const inspection *own, const sp_nozzle *nozzle)
{
    const sp_mount *port = NULL;
    double least = INFINITY;
    for (size_t i = 0; i < own->place.mount_count; i++) {
        double depth = depth_in(own, &own->place.mounts[i], nozzle->position);
        if (depth < least) {
            port = &own->place.mounts[i];
            least = depth;
        }
    }
    if (port)
        say(own,
            "nozzle \"%s\": on the axis of port %s, %.4g mm deep, expected %.4g mm to %.4g mm; it is not taken to be "
            "in the port",
            nozzle->name, port->name, 1e3 * least, 1e3 * port->depth_from, 1e3 * port->depth_to);
}

static void check_nozzle(const inspection *own, size_t index)
{
    const sp_nozzle *nozzle = &own->layout->nozzles[index];
    const sp_mount *port = port_at(own, nozzle->position);
    if (port) {
        check_type(own, port, nozzle);
        check_tilt(own, port, nozzle);
        check_steps(own, port, nozzle);
        check_occupancy(own, port, index);
    } else if (sp_mount_at(own->setup, own->place.mounts, own->place.mount_count, nozzle->position) == SIZE_MAX) {
        check_depth(own, nozzle);
    }
}

static void check_mouth(const inspection *own, size_t index)
{
    const sp_mount *port = &own->place.mounts[index];
    for (size_t i = 0; i < index && port->kind == SP_MOUNT_PORT; i++) {
        sp_mount mouth = own->place.mounts[i];
        mouth.depth_from = mouth.depth_to = 0;
        if (mouth.kind == SP_MOUNT_PORT && holds(own, &mouth, port->position) &&
            sp_dot(mouth.axis, port->axis) > 1 - SAME_AXIS) {
            say(own,
                "mounts: port %s has the mouth and the axis of port %s, so that a layout may have a nozzle in each",
                port->name, mouth.name);
            return;
        }
    }
}

void cli_warn_of_port_breaches(const cli_scene *opened, cli_warning_handler *warn, void *user)
{
    const inspection own = {.setup = sp_scene_setup(opened->scene),
                            .layout = sp_scene_layout(opened->scene),
                            .place = sp_scene_place_options(opened->scene),
                            .warn = warn,
                            .user = user};
    for (size_t i = 0; i < own.layout->count; i++)
        check_nozzle(&own, i);
    for (size_t i = 0; i < own.place.mount_count; i++)
        check_mouth(&own, i);
}
