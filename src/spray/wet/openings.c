/* Openings, from the lines that leave the liquid for the sky or for what lies outdoors. Around such a line, from where
 * it starts, directions are tried until something is in the way: how far that is to either side, at the distance where
 * the nearest of it stands, is the opening's width. Lines that pass each other closely use the same opening. */
#include "spray/wet/flood_fill.h"

#include <stdlib.h>

#define MOST_MEASURED 512 /* lines, evenly chosen */
#define AROUND 8          /* directions about a line */
#define STEPS 14          /* of bisection, from 45 degrees */
#define SHELTER 4         /* one line in so many may leave from where openings are looked at */
#define RARE 0.01         /* of the most seen through: openings seen through less are not kept */
#define SAME_OPENING 0.03 /* of the geometry's diagonal */

/* Whether a line leaves the liquid; else where it ends in *t. */
static bool leaves(const sp_flood *flood, const bool *liquid, const sp_ray *line, double *t)
{
    sp_hit hit = sp_trace_nearest(flood->tracer, line, sp_v(0, 0, 0));
    uint32_t met = sp_flood_met(flood, line, &hit);
    *t = hit.t;
    return met == SP_SKY || (met < flood->sides && !liquid[met]);
}

/* How far a line may lean over before something is in the way, as a tangent, and at which distance that stands. */
static double lean(const sp_flood *flood, const bool *liquid, sp_ray line, sp_vec3 aside, double *rim)
{
    sp_vec3 straight = line.velocity;
    double low = 0, high = 1, t;
    *rim = INFINITY;
    for (int step = 0; step < STEPS; step++) {
        double middle = 0.5 * (low + high);
        line.velocity = sp_along(straight, middle, aside);
        if (leaves(flood, liquid, &line, &t)) {
            low = middle;
        } else {
            high = middle;
            *rim = t;
        }
    }
    return 0.5 * (low + high);
}

static sp_opening measure(const sp_flood *flood, const bool *liquid, sp_ray line)
{
    sp_vec3 z = line.velocity, x = sp_unit(sp_cross(fabs(z.x) < 0.5 ? sp_v(1, 0, 0) : sp_v(0, 1, 0), z));
    sp_vec3 y = sp_cross(z, x);
    sp_opening found = {.width = INFINITY};
    for (int i = 0; i < AROUND / 2; i++) {
        double turn = M_PI * i / (AROUND / 2), rim[2];
        sp_vec3 aside = sp_along(sp_scale(x, cos(turn)), sin(turn), y);
        double tangent = lean(flood, liquid, line, aside, &rim[0]);
        double opposite = lean(flood, liquid, line, sp_scale(aside, -1), &rim[1]);
        double width = tangent * rim[0] + opposite * rim[1];
        if (width < found.width)
            found = (sp_opening){.place = sp_along(line.origin, 0.5 * (rim[0] + rim[1]), z), .width = width};
    }
    return found;
}

/* Adds a line's opening to those known, or makes it a new one. Of one opening the widest view counts. */
static size_t gather(sp_opening *openings, size_t count, size_t most, sp_opening found, double same)
{
    for (size_t i = 0; i < count; i++) {
        sp_opening *known = &openings[i];
        if (sp_distance(known->place, found.place) > fmax(same, fmax(known->width, found.width)))
            continue;
        found.share += known->share;
        if (found.width > known->width)
            *known = found;
        known->share = found.share;
        return count;
    }
    if (count < most)
        openings[count++] = found;
    return count;
}

static bool is_leaving(const bool *liquid, sp_sight_link sight)
{
    return liquid[sight.from] && (sight.to == SP_SKY || (sight.to != SP_UNTOLD && !liquid[sight.to]));
}

/* Marks sides of which most lines stay. What stands in an opening, or beyond it, sees the outside at large and not the
 * opening. */
static void find_sheltered(const sp_flood *flood, const bool *liquid, uint32_t *lines, bool *sheltered)
{
    uint32_t *leaving = lines + flood->sides;
    for (size_t i = 0; i < flood->sight_count; i++) {
        lines[flood->sights[i].from]++;
        leaving[flood->sights[i].from] += is_leaving(liquid, flood->sights[i]);
    }
    for (size_t side = 0; side < flood->sides; side++)
        sheltered[side] = liquid[side] && SHELTER * leaving[side] <= lines[side] + SHELTER;
}

static size_t measure_leaving(const sp_flood *flood, const bool *liquid, const bool *sheltered, sp_opening *openings,
                              size_t most)
{
    size_t leaving = 0, lines = 0, count = 0, next = 0;
    for (size_t i = 0; i < flood->sight_count; i++) {
        lines += liquid[flood->sights[i].from];
        leaving += is_leaving(liquid, flood->sights[i]) && sheltered[flood->sights[i].from];
    }
    size_t measured = leaving < MOST_MEASURED ? leaving : MOST_MEASURED;
    double same = SAME_OPENING / SP_CONTACT * flood->faces->cuts->contact;
    for (size_t i = 0, passed = 0; i < flood->sight_count && next < measured; i++) {
        sp_sight_link sight = flood->sights[i];
        if (!is_leaving(liquid, sight) || !sheltered[sight.from] || passed++ * measured < next * leaving)
            continue;
        next++;
        sp_opening found = measure(flood, liquid, sp_flood_line(flood, sight.from, sight.line));
        if (!(found.width < INFINITY))
            continue;
        found.share = (double)leaving / (double)measured / (double)lines;
        count = gather(openings, count, most, found, same);
    }
    return count;
}

bool sp_flood_openings(const sp_flood *flood, const bool *liquid, sp_opening *openings, size_t most, size_t *count,
                       sp_error *error)
{
    uint32_t *lines = calloc(2 * flood->sides + 1, sizeof *lines);
    bool *sheltered = malloc(flood->sides + 1);
    bool done = lines && sheltered;
    if (done) {
        find_sheltered(flood, liquid, lines, sheltered);
        *count = measure_leaving(flood, liquid, sheltered, openings, most);
        for (size_t i = 0; i < *count; i++) /* the most seen through first */
            for (size_t k = i; k > 0 && openings[k].share > openings[k - 1].share; k--) {
                sp_opening swap = openings[k];
                openings[k] = openings[k - 1];
                openings[k - 1] = swap;
            }
    }
    while (done && *count > 0 && openings[*count - 1].share < RARE * openings[0].share)
        --*count;
    free(lines);
    free(sheltered);
    return done || sp_fail_memory(error);
}
