/* The other way round of exact.c: the surface to the last bit, as layouts are evaluated on it. */
const exact = (() => {
    "use strict";

    /* A float's bits, to be moved from one to one so many farther on. */
    const one = new Float64Array(1), bits = new BigInt64Array(one.buffer);
    function moved(value, apart) {
        if (!apart)
            return value;
        one[0] = value;
        bits[0] += BigInt(apart);
        return one[0];
    }

    function readWords(coder, count) {
        const model = coder.numbers(), values = new Uint32Array(count);
        for (let i = 0; i < count; i++)
            values[i] = (i ? values[i - 1] : 0) + coder.number(model);
        return values;
    }

    function readDoubles(coder, count) {
        const model = coder.numbers(), values = new Float64Array(count);
        for (let i = 0; i < count; i++)
            values[i] = moved(i ? values[i - 1] : 0, coder.number(model));
        return values;
    }

    function readWet(coder, count, surface, {nodes, cuts}) {
        const sidesModel = coder.bytes(), nodesModel = coder.bytes(), cutsModel = coder.numbers(3), CUT = 4;
        Object.assign(surface, {sides: new Uint8Array(count), nodes: new Uint8Array(nodes),
                                cuts: new Float64Array(3 * cuts)});
        let node = 0, cut = 0;
        for (let t = 0; t < count; t++) {
            const sides = surface.sides[t] = coder.byte(sidesModel);
            if ((sides & 3) === sides >> 2)
                continue;
            let own = 0;
            for (let open = 1; open; open--) {
                const found = surface.nodes[node++] = coder.byte(nodesModel);
                if (found === CUT) {
                    open += 2;
                    own++;
                }
            }
            for (const end = cut + 3 * own; cut < end; cut++)
                surface.cuts[cut] = moved(0, coder.number(cutsModel + (cut % 3) * coder.NUMBER));
        }
    }

    /* The surface, and which of its triangles are drawn. */
    function read(coder, about, drawn) {
        const {triangles, vertices, charts} = about, walk = readWalk(coder, triangles, vertices);
        const surface = {triangles: walk.triangles, chart: walk.chart};
        surface.places = readPlaces(coder, walk, about);
        surface.part = readWords(coder, triangles);
        surface.chartPage = readWords(coder, charts);
        surface.chartTexel = readDoubles(coder, charts);
        surface.uv = readUnfolded(coder, walk, surface.places, charts);
        const shown = readWords(coder, drawn);
        readWet(coder, triangles, surface, about);
        return {surface, drawn: shown};
    }
    return {moved, read};
})();
