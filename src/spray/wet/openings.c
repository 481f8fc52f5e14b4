/* Openings, from the lines that leave the liquid for the sky or for what lies outdoors. Around such a line, from where
 * it starts, directions are tried until something is in the way: its rim. How far apart two opposite sides of it are
 * as they are seen from there is the opening's width, the middle between them its place. Those whose rim is seen whole
 * are taken first, the best seen before others: lines that pass the same plane in the same clear stretch of it use the
 * same opening, however far they pass from its place.
 */
#include "spray/wet/opening_size.h"
#include "spray/wet/opening_rim.h"

#include <stdlib.h>

#define MOST_MEASURED 512 /* lines, evenly chosen */
#define SQUARE 0.996      /* cosine of 5 degrees: a rim that lies so nearly square to an axis is taken to be */
#define SLENDER 5         /* how many times its width a rim may reach: the plane through a longer one is not known */
#define STRETCH 16        /* points of a plane that must be clear between two places for them to be one opening */
#define SHELTER 4         /* one line in so many may leave from where openings are looked at */
#define RARE 0.01         /* of the most seen through: openings seen through less are not kept */
#define SAME_OPENING 0.03 /* of the geometry's diagonal */
#define LAP 1.05          /* of a cap over the rim that it lies on */
#define AWAY 1e-3         /* of its radius: so far outside of the rim a cap lies, and not within the wall's contact */
#define MOST_TRIED 2048   /* lines that stay, evenly chosen */
#define IN_THE_WAY 0.01   /* of them, that a cap may meet: a belt goes on through its opening */
#define SHUT 0.95         /* of the lines that leave by an opening, that its cap must meet */

/* An opening as it is seen along one line. */
typedef struct {
    sp_opening opening;
    sp_ray line;
    double shown; /* m² of its rim's area, as it is seen along the line; 0: not whole */
    bool reached; /* the rim was followed all round: it reaches as far as its radius and no farther */
} seen_opening;

/* The axis that a direction nearly has, or itself. What stands in a rim turns the plane through it. */
static sp_vec3 squared(sp_vec3 normal)
{
    sp_vec3 axis = sp_v(fabs(normal.x) > SQUARE, fabs(normal.y) > SQUARE, fabs(normal.z) > SQUARE);
    return sp_length(axis) > 0 ? axis : normal;
}

/* Where a rim lies, and how wide it is and how far it reaches, unless it is a slit. */
static void add_rim(seen_opening *seen, const sp_opening_rim *rim)
{
    sp_vec3 twice = sp_rim_normal(rim->point, SP_RIM_POINTS), normal = squared(sp_unit(twice)),
            outward = seen->line.velocity;
    sp_opening whole = {.place = sp_rim_middle(rim->point, SP_RIM_POINTS),
                        .width = sp_rim_width(rim->point, SP_RIM_POINTS, normal)};
    whole.normal = sp_dot(normal, outward) > 0 ? normal : sp_sub(sp_v(0, 0, 0), normal); /* without -0 */
    for (int i = 0; i < SP_RIM_POINTS; i++)
        whole.radius = fmax(whole.radius, sp_distance(rim->point[i], whole.place));
    if (whole.radius > SLENDER * whole.width)
        return;
    seen->opening = whole;
    seen->shown = 0.5 * fabs(sp_dot(twice, outward));
}

/* Where the rim is not seen whole, an opening is as wide as it is square to the line, which is no more than it is: a
 * tube, too, is as wide as it is seen to be. INFINITY where nothing is in the way on two opposite sides. */
static seen_opening measure(const sp_flood *flood, const bool *liquid, sp_ray line)
{
    sp_opening_rim rim = sp_opening_rim_find(flood, liquid, line);
    seen_opening found = {.opening.width = INFINITY, .line = line};
    for (int i = 0; i < SP_RIM_POINTS / 2; i++) {
        sp_vec3 from = rim.point[i], to = rim.point[i + SP_RIM_POINTS / 2];
        double width = sp_length(sp_cross(sp_sub(to, from), line.velocity));
        if (rim.there[i] && rim.there[i + SP_RIM_POINTS / 2] && width < found.opening.width)
            found.opening = (sp_opening){.place = sp_scale(sp_add(from, to), 0.5), .width = width};
    }
    if (sp_opening_rim_is_flat(&rim, SP_OPENING_FLAT * found.opening.width, line.velocity))
        add_rim(&found, &rim);
    return found;
}

/* Where a line passes an opening's plane. */
static sp_vec3 passing(const sp_opening *opening, const sp_ray *line)
{
    double along = sp_dot(line->velocity, opening->normal);
    return sp_along(line->origin, sp_dot(sp_sub(opening->place, line->origin), opening->normal) / along,
                    line->velocity);
}

/* Whether a line leaves through a known opening; *through is then where it passes its plane. From the opening's place
 * to there the plane is clear, and so is the way along it on the liquid's side: beside a wall lie other openings. */
static bool leaves_through(const sp_flood *flood, const seen_opening *seen, const sp_ray *line, sp_vec3 *through)
{
    const sp_opening *known = &seen->opening;
    if (!(sp_dot(line->velocity, known->normal) > 0) ||
        !(sp_dot(sp_sub(known->place, line->origin), known->normal) > 0))
        return false;
    *through = passing(known, line);
    if (seen->reached && sp_distance(*through, known->place) > known->radius)
        return false;
    sp_vec3 inward = sp_scale(known->normal, -SP_OPENING_FLAT * known->width), way = sp_sub(*through, known->place);
    bool clear = sp_opening_is_clear(flood, sp_add(known->place, inward), sp_add(*through, inward));
    for (int i = 1; i <= STRETCH && clear; i++) {
        sp_vec3 point = sp_along(known->place, (double)i / STRETCH, way);
        clear = sp_opening_is_clear(flood, sp_add(point, inward), sp_sub(point, inward));
    }
    return clear;
}

/* The first of the known openings that a line leaves through, or `count`. A known one reaches as far as lines pass its
 * plane where they see a rim themselves. */
static size_t find_passed(const sp_flood *flood, seen_opening *known, size_t count, const seen_opening *found)
{
    for (size_t i = 0; i < count; i++) {
        sp_opening *opening = &known[i].opening;
        sp_vec3 through;
        if (!leaves_through(flood, &known[i], &found->line, &through))
            continue;
        if (sp_distance(through, found->opening.place) <= found->opening.width)
            opening->radius = fmax(opening->radius, sp_distance(through, opening->place));
        return i;
    }
    return count;
}

/* The first of the known openings that is near, or `count`. Of two whose rims are seen whole it is known that they are
 * two, but for what lies within one. */
static size_t find_near(const seen_opening *known, size_t count, const seen_opening *found, double same)
{
    size_t i = 0;
    for (; i < count; i++) {
        double width = known[i].opening.width;
        double near = known[i].shown > 0 && found->shown > 0 ? 0.5 * width : fmax(same, width);
        if (sp_distance(known[i].opening.place, found->opening.place) <= near)
            break;
    }
    return i;
}

/* Adds a line's opening to those known, or makes it a new one. */
static size_t gather(const sp_flood *flood, seen_opening *known, size_t count, const seen_opening *found, double same)
{
    size_t at = find_passed(flood, known, count, found);
    if (at == count)
        at = find_near(known, count, found, same);
    if (at < count) {
        known[at].opening.share += found->opening.share;
        return count;
    }
    known[count] = *found;
    known[count].reached =
        found->shown > 0 && sp_opening_size_find(flood, passing(&found->opening, &found->line), &known[count].opening);
    return count + 1;
}

static bool is_leaving(const bool *liquid, sp_sight_link sight)
{
    return liquid[sight.from] && (sight.to == SP_SKY || (sight.to != SP_AMBIGUOUS && !liquid[sight.to]));
}

static bool is_staying(const sp_flood *flood, const bool *liquid, sp_sight_link sight)
{
    return liquid[sight.from] && sight.to < flood->sides && liquid[sight.to];
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

/* Those that are best seen first: the whole ones, and then the widest. */
static int by_rim(const void *left, const void *right)
{
    const seen_opening *a = left, *b = right;
    int order = (a->shown < b->shown) - (a->shown > b->shown);
    return order ? order : (a->opening.width < b->opening.width) - (a->opening.width > b->opening.width);
}

/* The openings of lines that leave, at most MOST_MEASURED of them, one each. */
static size_t measure_leaving(const sp_flood *flood, const bool *liquid, const bool *sheltered, seen_opening *seen)
{
    size_t leaving = 0, lines = 0, count = 0, next = 0;
    for (size_t i = 0; i < flood->sight_count; i++) {
        lines += liquid[flood->sights[i].from];
        leaving += is_leaving(liquid, flood->sights[i]) && sheltered[flood->sights[i].from];
    }
    size_t measured = leaving < MOST_MEASURED ? leaving : MOST_MEASURED;
    for (size_t i = 0, passed = 0; i < flood->sight_count && next < measured; i++) {
        sp_sight_link sight = flood->sights[i];
        if (!is_leaving(liquid, sight) || !sheltered[sight.from] || passed++ * measured < next * leaving)
            continue;
        next++;
        seen_opening found = measure(flood, liquid, sp_flood_line(flood, sight.from, sight.line));
        found.opening.share = (double)leaving / (double)measured / (double)lines;
        if (found.opening.width < INFINITY)
            seen[count++] = found;
    }
    return count;
}

/* Joins what is the same. */
static size_t join(const sp_flood *flood, seen_opening *seen, size_t count, seen_opening *known)
{
    double same = SAME_OPENING / SP_CONTACT * flood->faces->cuts->contact;
    qsort(seen, count, sizeof *seen, by_rim);
    size_t known_count = 0;
    for (size_t i = 0; i < count; i++)
        known_count = gather(flood, known, known_count, &seen[i], same);
    return known_count;
}

static int by_share(const void *left, const void *right)
{
    const seen_opening *a = left, *b = right;
    int order = (a->opening.share < b->opening.share) - (a->opening.share > b->opening.share);
    return order ? order : (a->opening.width < b->opening.width) - (a->opening.width > b->opening.width);
}

static void lay_cap(sp_opening *opening)
{
    opening->place = sp_along(opening->place, AWAY * opening->radius, opening->normal);
    opening->radius *= LAP;
}

static bool is_capped(const sp_opening *opening, const sp_ray *line, double t)
{
    sp_cap cap = {.point = opening->place, .normal = opening->normal, .radius = opening->radius};
    return opening->radius > 0 && sp_cap_blocks(&cap, line, t);
}

/* How many of the lines that stay meet each cap: *tried of them are tried. */
static void count_staying(const sp_flood *flood, const bool *liquid, const sp_opening *openings, size_t count,
                          size_t *met, size_t *tried)
{
    size_t staying = 0;
    for (size_t i = 0; i < flood->sight_count; i++)
        staying += is_staying(flood, liquid, flood->sights[i]);
    size_t most = staying < MOST_TRIED ? staying : MOST_TRIED;
    *tried = 0;
    for (size_t i = 0, passed = 0; i < flood->sight_count && *tried < most; i++) {
        if (!is_staying(flood, liquid, flood->sights[i]) || passed++ * most < *tried * staying)
            continue;
        ++*tried;
        sp_ray line = sp_flood_line(flood, flood->sights[i].from, flood->sights[i].line);
        sp_hit hit = sp_trace_nearest(flood->tracer, &line, sp_v(0, 0, 0));
        for (size_t j = 0; j < count; j++)
            met[j] += is_capped(&openings[j], &line, hit.t);
    }
}

/* Takes back caps that would part what stays, or let pass what leaves: their plane is not the opening's. Of the lines
 * that were measured each has the same share. */
static void try_caps(const sp_flood *flood, const bool *liquid, const seen_opening *seen, size_t seen_count,
                     sp_opening *openings, size_t count)
{
    size_t met[SP_OPENINGS] = {0}, tried;
    count_staying(flood, liquid, openings, count, met, &tried);
    for (size_t j = 0; j < count; j++) {
        double shut = 0;
        for (size_t i = 0; i < seen_count; i++)
            shut += is_capped(&openings[j], &seen[i].line, INFINITY) ? seen[i].opening.share : 0;
        if ((double)met[j] > IN_THE_WAY * (double)tried || shut < SHUT * openings[j].share) {
            openings[j].normal = sp_v(0, 0, 0);
            openings[j].radius = 0;
        }
    }
}

/* Keeps the openings that are most seen through, each with its cap, and counts the others. */
static void keep(seen_opening *known, size_t known_count, sp_flooded *found)
{
    qsort(known, known_count, sizeof *known, by_share);
    for (size_t i = 0; i < known_count && known[i].opening.share >= RARE * known[0].opening.share; i++) {
        if (found->opening_count == SP_OPENINGS) {
            found->more_openings++;
            continue;
        }
        lay_cap(&known[i].opening);
        found->openings[found->opening_count++] = known[i].opening;
    }
}

bool sp_flood_openings(const sp_flood *flood, sp_flooded *found, sp_error *error)
{
    uint32_t *lines = calloc(2 * flood->sides + 1, sizeof *lines);
    bool *sheltered = malloc(flood->sides + 1);
    seen_opening *seen = malloc(MOST_MEASURED * sizeof *seen), *known = malloc(MOST_MEASURED * sizeof *known);
    bool done = lines && sheltered && seen && known;
    if (done) {
        find_sheltered(flood, found->liquid, lines, sheltered);
        size_t seen_count = measure_leaving(flood, found->liquid, sheltered, seen);
        keep(known, join(flood, seen, seen_count, known), found);
        try_caps(flood, found->liquid, seen, seen_count, found->openings, found->opening_count);
    }
    free(lines);
    free(sheltered);
    free(seen);
    free(known);
    return done || sp_fail_memory(error);
}
