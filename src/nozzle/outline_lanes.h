/* What cone.c and fan.c say of shares, of many patches at a time. */
#ifndef NOZZLE_OUTLINE_LANES_H
#define NOZZLE_OUTLINE_LANES_H

#include "lanes.h"

#define BLUR ((float)SP_SPRAY_BLUR)

INLINE lanes smooth_step(lanes t)
{
    t = greater(lesser(t, all(1)), all(0));
    lanes inner = add(multiply(t, add(scale(t, 6), all(-15))), all(10));
    return multiply(multiply(multiply(t, t), t), inner);
}

/* Of patches one over whose blur's square is `sharp2`. */
INLINE lanes spot_share(float edge2, lanes chord2, lanes sharp2)
{
    return multiply(scale(sharp2, edge2), smooth_step(subtract(all(1), scale(multiply(chord2, sharp2), 0.5f))));
}

INLINE lanes disc_share(const sp_rim *rim, lanes chord2, lanes sharp)
{
    if (rim->edge2 <= 0 || rim->edge2 >= 4)
        return all(rim->edge2 > 0);
    lanes apart = scale(subtract(all(rim->edge2), chord2), rim->steep);
    lanes share = smooth_step(add(all(0.5f), multiply(apart, sharp)));
    lanes sharp2 = scale(multiply(sharp, sharp), 1 / (BLUR * BLUR));
    mask spots = below(scale(sharp2, rim->edge2), all(1)), holes = below(scale(sharp2, 4 - rim->edge2), all(1));
    if (rim->edge2 < 2 && bits_of(spots))
        return choose(spots, spot_share(rim->edge2, chord2, sharp2), share);
    if (rim->edge2 >= 2 && bits_of(holes)) {
        lanes hole = spot_share(4 - rim->edge2, subtract(all(4), chord2), sharp2);
        return choose(holes, subtract(all(1), hole), share);
    }
    return share;
}

/* Squared chords: a sum of small squares, where the cosine would lose the digits that tell narrow cones. */
INLINE lanes chords(const float axis[3], lanes x, lanes y, lanes z)
{
    lanes a = subtract(x, all(axis[0])), b = subtract(y, all(axis[1])), c = subtract(z, all(axis[2]));
    return add(add(multiply(a, a), multiply(b, b)), multiply(c, c));
}

/* What is held, and the shares. */
typedef struct {
    lanes share;
    mask held;
} shares;

IN_MANY_LOOPS shares cone_shares(const sp_outline *outline, lanes x, lanes y, lanes z, lanes sharp)
{
    lanes chord2 = chords(outline->z, x, y, z);
    bool hollow = outline->inner.edge2 > 0;
    shares s = {.held = at_least(all(outline->outer.edge2 >= 4 ? 5 : outline->outer.edge2), chord2)};
    if (hollow)
        s.held = both(s.held, at_least(chord2, all(outline->inner.edge2)));
    s.share = disc_share(&outline->outer, chord2, sharp);
    if (hollow)
        s.share = greater(subtract(s.share, disc_share(&outline->inner, chord2, sharp)), all(0));
    return s;
}

IN_MANY_LOOPS shares fan_shares(const sp_outline *outline, lanes x, lanes y, lanes z, lanes sharp)
{
    lanes up = dot(x, y, z, outline->y), end[2] = {dot(x, y, z, outline->end[0]), dot(x, y, z, outline->end[1])};
    shares s = {.held = at_least(all(outline->height), magnitude(up)), .share = all(1)};
    if (!outline->all_round) {
        mask in[2] = {at_least(end[0], all(0)), at_least(end[1], all(0))};
        s.held = both(s.held, outline->wide ? either(in[0], in[1]) : both(in[0], in[1]));
    }
    if (outline->height <= 1) {
        lanes rise = scale(sharp, outline->rise);
        lanes above = smooth_step(add(all(0.5f), multiply(subtract(all(outline->height), up), rise)));
        lanes under = smooth_step(add(all(0.5f), multiply(add(all(outline->height), up), rise)));
        s.share = greater(subtract(add(above, under), all(1)), all(0));
    }
    if (!outline->all_round) {
        lanes rise = scale(sharp, 1 / BLUR);
        lanes ends = add(smooth_step(add(all(0.5f), multiply(end[0], rise))),
                         smooth_step(add(all(0.5f), multiply(end[1], rise))));
        s.share = multiply(s.share, outline->wide ? lesser(ends, all(1)) : greater(subtract(ends, all(1)), all(0)));
    }
    return s;
}

/* All of a patch that any aim may give any share of. */
IN_MANY_LOOPS lanes generous_shares(const sp_outline *outline, bool flat, lanes x, lanes y, lanes z, lanes sharp)
{
    lanes breadth = divide(all(1), sharp), spread = scale(breadth, (float)SP_OUTLINE_CORNER); /* corners of fans */
    if (!flat) {
        mask slim = at_least(all(outline->narrowest), scale(breadth, (float)SP_OUTLINE_SPOT));
        spread = choose(slim, scale(breadth, (float)SP_OUTLINE_BLUR), scale(breadth, (float)SP_OUTLINE_FRINGE));
        lanes chord = root(chords(outline->z, x, y, z));
        mask in = at_least(add(spread, all(outline->outer.edge2 >= 4 ? 5 : sqrtf(outline->outer.edge2))), chord);
        if (outline->inner.edge2 > 0)
            in = both(in,
                      at_least(add(chord, scale(breadth, (float)SP_OUTLINE_FRINGE)), all(sqrtf(outline->inner.edge2))));
        return keep(all(1), in);
    }
    mask in = at_least(add(all(outline->height), spread), magnitude(dot(x, y, z, outline->y)));
    if (!outline->all_round) {
        lanes short_of = subtract(all(0), spread);
        mask end[2] = {at_least(dot(x, y, z, outline->end[0]), short_of),
                       at_least(dot(x, y, z, outline->end[1]), short_of)};
        in = both(in, outline->wide ? either(end[0], end[1]) : both(end[0], end[1]));
    }
    return keep(all(1), in);
}

/* As sp_spray_share; `flat`: the outline's, told apart from it so that loops can be made for each. */
INLINE shares outline_shares(const sp_outline *outline, bool flat, lanes x, lanes y, lanes z, lanes sharp)
{
    return flat ? fan_shares(outline, x, y, z, sharp) : cone_shares(outline, x, y, z, sharp);
}

#endif
