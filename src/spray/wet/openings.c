/* Openings, from the lines that leave the liquid for the sky or for what lies outdoors. Around such a line, from where
 * it starts, directions are tried until something is in the way: its rim. How far apart two opposite sides of it are
 * as they are seen from there is the opening's width, the middle between them its place. Lines that pass each other
 * closely use the same opening.
 */
#include "spray/wet/flood_fill.h"

#include <stdlib.h>

#define MOST_MEASURED 512 /* lines, evenly chosen */
#define AROUND 8          /* directions about a line */
#define FLAT 0.25         /* of an opening's width, that its rim may lie off a plane */
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

/* Leans a line over until something is in the way. *rim is where that stands; false where nothing is within 45 degrees.
 */
static bool lean(const sp_flood *flood, const bool *liquid, sp_ray line, sp_vec3 aside, sp_vec3 *rim)
{
    sp_vec3 straight = line.velocity;
    double low = 0, high = 1, t;
    bool met = false;
    for (int step = 0; step < STEPS; step++) {
        double middle = 0.5 * (low + high);
        line.velocity = sp_along(straight, middle, aside);
        if (leaves(flood, liquid, &line, &t)) {
            low = middle;
        } else {
            high = middle;
            *rim = sp_ray_point(&line, sp_v(0, 0, 0), t);
            met = true;
        }
    }
    return met;
}

/* What is in the way around a line; points i and i + AROUND / 2 are on opposite sides. */
typedef struct {
    sp_vec3 point[AROUND];
    bool there[AROUND];
    int count;
} rim;

static rim find_rim(const sp_flood *flood, const bool *liquid, sp_ray line)
{
    sp_vec3 normal = line.velocity, x = sp_unit(sp_cross(fabs(normal.x) < 0.5 ? sp_v(1, 0, 0) : sp_v(0, 1, 0), normal));
    sp_vec3 y = sp_cross(normal, x);
    rim found = {.count = 0};
    for (int i = 0; i < AROUND; i++) {
        double turn = 2 * M_PI * i / AROUND;
        found.there[i] = lean(flood, liquid, line, sp_along(sp_scale(x, cos(turn)), sin(turn), y), &found.point[i]);
        found.count += found.there[i];
    }
    return found;
}

/* Whether all of a rim is there and within `off` (m) of one plane (Newell's method). What stands before an opening is
 * no rim of it. */
static bool is_whole(const rim *rim, double off)
{
    sp_vec3 twice = sp_v(0, 0, 0), first = rim->point[0];
    double least = INFINITY, most = -INFINITY;
    for (int i = 0; i < AROUND; i++)
        twice = sp_add(twice, sp_cross(sp_sub(rim->point[i], first), sp_sub(rim->point[(i + 1) % AROUND], first)));
    for (int i = 0; i < AROUND; i++) {
        double height = sp_dot(twice, sp_sub(rim->point[i], first));
        least = fmin(least, height);
        most = fmax(most, height);
    }
    return rim->count == AROUND && most - least <= off * sp_length(twice);
}

/* An opening as it is seen along one line, or the best of several. */
typedef struct {
    sp_opening opening;
    bool whole; /* its rim is seen all around: else it may be narrower */
} seen_opening;

/* How wide it is square to the line, which is no more than it is: a tube, too, is as wide as it is seen to be. INFINITY
 * where nothing is in the way on two opposite sides. */
static seen_opening measure(const sp_flood *flood, const bool *liquid, sp_ray line)
{
    rim rim = find_rim(flood, liquid, line);
    seen_opening found = {.opening.width = INFINITY};
    for (int i = 0; i < AROUND / 2; i++) {
        sp_vec3 from = rim.point[i], to = rim.point[i + AROUND / 2];
        double width = sp_length(sp_cross(sp_sub(to, from), line.velocity));
        if (rim.there[i] && rim.there[i + AROUND / 2] && width < found.opening.width)
            found.opening = (sp_opening){.place = sp_scale(sp_add(from, to), 0.5), .width = width};
    }
    found.whole = is_whole(&rim, FLAT * found.opening.width);
    return found;
}

/* The first of the openings that is the same as another, but for itself; `count` where there is none. */
static size_t same_as(const seen_opening *openings, size_t count, const seen_opening *other, double same)
{
    size_t i = 0;
    while (i < count &&
           (&openings[i] == other || sp_distance(openings[i].opening.place, other->opening.place) >
                                         fmax(same, fmax(openings[i].opening.width, other->opening.width))))
        i++;
    return i;
}

/* Two views of one opening: what is seen whole counts, and the widest view of it. */
static void join(seen_opening *known, const seen_opening *other)
{
    double share = known->opening.share + other->opening.share;
    if (other->whole > known->whole || (other->whole == known->whole && other->opening.width > known->opening.width))
        *known = *other;
    known->opening.share = share;
}

/* Adds a line's opening to those known, or makes it a new one. */
static size_t gather(seen_opening *openings, size_t count, size_t most, const seen_opening *found, double same)
{
    size_t i = same_as(openings, count, found, same);
    if (i < count)
        join(&openings[i], found);
    else if (count < most)
        openings[count++] = *found;
    return count;
}

/* What has grown since may hold others that were first taken for openings of their own. */
static size_t join_all(seen_opening *openings, size_t count, double same)
{
    for (size_t i = 0; i < count;) {
        size_t other = same_as(openings, count, &openings[i], same);
        if (other == count) {
            i++;
            continue;
        }
        join(&openings[other], &openings[i]);
        openings[i] = openings[--count];
        i = 0;
    }
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

static size_t measure_leaving(const sp_flood *flood, const bool *liquid, const bool *sheltered, seen_opening *openings,
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
        seen_opening found = measure(flood, liquid, sp_flood_line(flood, sight.from, sight.line));
        if (!(found.opening.width < INFINITY))
            continue;
        found.opening.share = (double)leaving / (double)measured / (double)lines;
        count = gather(openings, count, most, &found, same);
    }
    return join_all(openings, count, same);
}

static int by_share(const void *left, const void *right)
{
    const seen_opening *a = left, *b = right;
    int order = (a->opening.share < b->opening.share) - (a->opening.share > b->opening.share);
    return order ? order : (a->opening.width < b->opening.width) - (a->opening.width > b->opening.width);
}

bool sp_flood_openings(const sp_flood *flood, const bool *liquid, sp_opening *openings, size_t most, size_t *count,
                       sp_error *error)
{
    uint32_t *lines = calloc(2 * flood->sides + 1, sizeof *lines);
    bool *sheltered = malloc(flood->sides + 1);
    seen_opening *seen = malloc((most + 1) * sizeof *seen);
    bool done = lines && sheltered && seen;
    if (done) {
        find_sheltered(flood, liquid, lines, sheltered);
        *count = measure_leaving(flood, liquid, sheltered, seen, most);
        qsort(seen, *count, sizeof *seen, by_share); /* the most seen through first */
        while (*count > 0 && seen[*count - 1].opening.share < RARE * seen[0].opening.share)
            --*count;
        for (size_t i = 0; i < *count; i++)
            openings[i] = seen[i].opening;
    }
    free(lines);
    free(sheltered);
    free(seen);
    return done || sp_fail_memory(error);
}
