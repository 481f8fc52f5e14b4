/* The other way round of patch_code.c and of what design.c tells by it. */
function makePatches(model) {
    "use strict";
    const HINTS = 16, SIZES = 4, APART = 4, count = model.patches;

    /* Of each patch those above, left and above left of it on its page, of lower numbers; -1 for none. */
    function findNeighbours() {
        const of = new Int32Array(3 * count).fill(-1), {edge} = model;
        for (const page of model.page)
            for (let i = 0; i < page.length; i++) {
                if (!page[i])
                    continue;
                const own = page[i] - 1, left = i % edge > 0, above = Math.floor(i / edge) % edge > 0;
                const near = [above && page[i - edge], left && page[i - 1], left && above && page[i - edge - 1]];
                near.forEach((there, k) => (of[3 * own + k] = there && there - 1 < own ? there - 1 : -1));
            }
        return of;
    }
    const of = findNeighbours();

    function expected(values, where, patch) {
        const [above, left, corner] = [of[3 * patch], of[3 * patch + 1], of[3 * patch + 2]];
        const has = (there) => there >= 0 && (!where || where[there] > 0);
        const [hasAbove, hasLeft, hasCorner] = [has(above), has(left), has(corner)];
        if (!hasAbove && !hasLeft)
            return hasCorner ? values[corner] : 0;
        if (!hasAbove || !hasLeft || !hasCorner)
            return values[hasAbove ? above : left];
        const one = values[above], two = values[left], least = Math.min(one, two), most = Math.max(one, two);
        return values[corner] >= most ? least : values[corner] <= least ? most : one + two - values[corner];
    }

    const sizes = Uint8Array.from({length: 256}, (_, off) => {
        const size = off < 128 ? off : 256 - off;
        return size < 2 ? size : size < 6 ? 2 : 3;
    });

    let sizedBefore = new Uint8Array(count);
    /* guess(patch, values): what is expected, and the hint times 256. */
    function read(coder, guess) {
        const right = coder.models(HINTS * SIZES * SIZES), off = coder.bytes(HINTS * SIZES);
        const values = new Uint8Array(count), sized = new Uint8Array(count);
        for (let i = 0; i < count; i++) {
            const told = guess(i, values), hint = told >> 8, before = i ? sized[i - 1] : 0;
            const there = of[3 * i] >= 0 ? of[3 * i] : of[3 * i + 1], beside = there >= 0 ? sized[there] : 0;
            let apart = 0;
            if (!coder.bit(right + (hint * SIZES + before) * SIZES + beside)) {
                apart = coder.byte(off + (hint * SIZES + Math.max(beside, before)) * coder.BYTE);
                sized[i] = sizes[apart];
            }
            values[i] = told + apart;
        }
        sizedBefore = sized;
        return values;
    }

    const alone = (coder) => read(coder, (i, values) => expected(values, null, i));
    const reached = (coder, flux) => read(coder, (i, values) =>
        (flux[i] ? (1 + sizedBefore[i]) << 8 | expected(values, flux, i) : 0));

    function readFlux(coder, brought) {
        if (!brought)
            return alone(coder);
        return read(coder, (i) => {
            let most = 0, second = 0;
            for (const {flux} of brought) {
                second = Math.max(second, Math.min(most, flux[i]));
                most = Math.max(most, flux[i]);
            }
            const apart = Math.floor((most - second) / APART);
            return most | (!most ? 0 : !second ? 1 : apart < HINTS - 3 ? 2 + apart : HINTS - 1) << 8;
        });
    }

    /* What design.c tells of a design. */
    function readDesign(design, coder, hasJets) {
        const known = design.nozzles.every((nozzle) => nozzle.known);
        design.nozzles.forEach((nozzle) => (nozzle.flux = nozzle.known ? alone(coder) : null));
        const flux = readFlux(coder, known && design.nozzles), speed = reached(coder, flux);
        const incidence = reached(coder, flux);
        const impact = reached(coder, flux).map((above, i) => above + flux[i]);
        design.values = {flux, speed, incidence, impact};
        if (hasJets)
            design.values.jets = reached(coder, flux);
        design.share = reached(coder, flux);
        design.film = alone(coder);
        design.shadowOf = alone(coder);
    }
    return {readDesign};
}
