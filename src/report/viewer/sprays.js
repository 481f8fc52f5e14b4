/* Sprays as sprays.c tells them: rims, and a few jets as lines. */
const sprays = (() => {
    "use strict";
    const FULL = 32767, POINTS = 33, JET = 128, PIECES = 12, FLAT = 1e-3;

    /* Ends of the pieces of a parabola whose control point lies above the middle of its ends. */
    function curve(from, to, above, pieces) {
        const {add, scaled} = geometry, control = add(scaled(add(from, to), 0.5), above);
        const at = (t) => from.map((x, k) => (1 - t) * ((1 - t) * x + 2 * t * control[k]) + t * t * to[k]);
        return Array.from({length: pieces}, (_, i) => [...at(i / pieces), ...at((i + 1) / pieces)]).flat();
    }

    /* Jets whose legs the evaluator told, each from, to, rise and walls met before: as `read` has them. */
    function jetsOf(legs, up) {
        const jets = {direct: [], bounced: []};
        for (let at = 0; at < legs.length; at += 8) {
            const [from, to] = [legs.subarray(at, at + 3), legs.subarray(at + 3, at + 6)].map((place) => [...place]);
            const [rise, walls] = legs.subarray(at + 6), far = Math.hypot(...geometry.add(to, from, -1));
            (walls ? jets.bounced : jets.direct).push(...curve(from, to, geometry.scaled(up, rise),
                                                               rise < FLAT * far ? 1 : PIECES));
        }
        return jets;
    }

    /* Sets the nozzle's sprays, and its jets up to the first wall, `direct`, and beyond it, `bounced`. */
    function read(nozzle, up, take) {
        const {at, span, legs, sprays: count} = nozzle;
        const placesOf = (many, differences) => {
            const axes = [0, 1, 2].map(() => take(Int16Array, many, differences));
            return (i) => axes.map((values, k) => at[k] + (values[i] * span) / FULL);
        };
        const place = placesOf(POINTS * count, true), jets = take(Uint8Array, count), walls = take(Uint8Array, legs);
        const end = placesOf(legs, false), rise = take(Int16Array, legs);
        let leg = 0;
        Object.assign(nozzle, {direct: [], bounced: []});
        nozzle.sprays = Array.from(jets, (told, spray) => {
            const from = place(POINTS * spray);
            for (let jet = 0; jet < told; jet++) {
                let here = from;
                do {
                    const above = geometry.scaled(up, (rise[leg] * span) / FULL), next = end(leg);
                    const flat = Math.hypot(...above) < FLAT * span;
                    (walls[leg] % JET ? nozzle.bounced : nozzle.direct).push(...curve(here, next, above,
                                                                                     flat ? 1 : PIECES));
                    here = next;
                } while (++leg < legs && walls[leg] < JET);
            }
            return {from, rim: Array.from({length: POINTS - 1}, (_, i) => place(POINTS * spray + 1 + i))};
        });
    }
    return {read, jetsOf};
})();
