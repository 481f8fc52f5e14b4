/* The other way round of triangle_order.c: which vertices triangles have, which charts they are of, and over which edges they are
 * told. */
function readWalk(coder, count, vertices) {
    "use strict";
    const STEPS = 32, GUESSES = 6, FULL = 7, NONE = -1, AROUND = (FULL + 1) * (FULL + 1);
    const reached = coder.models(3 * AROUND), known = coder.models(3 * AROUND), guess = coder.models(GUESSES);
    const turn = coder.models(2 * 9 * 4), vertexModel = coder.numbers(), chartModel = coder.numbers();
    const corners = new Uint32Array(3 * count), chart = new Uint32Array(count), gates = new Int32Array(count).fill(NONE);
    const far = new Uint8Array(count), first = new Int32Array(vertices).fill(NONE), next = new Int32Array(3 * count);
    const met = new Uint8Array(3 * count), around = new Uint8Array(vertices), queue = new Uint32Array(3 * count);
    let queued = 0, taken = 0, told = 0, fresh = 0;
    const after = (corner) => (corner % 3 === 2 ? corner - 2 : corner + 1);

    function meet(corner) {
        const from = corners[corner], to = corners[after(corner)];
        for (let other = first[to], steps = 0; other !== NONE && steps < STEPS; steps++, other = next[other])
            if (!met[other] && corners[after(other)] === from) {
                met[other] = met[corner] = 1;
                return;
            }
    }

    function putIn() {
        const start = 3 * told++;
        for (let corner = start; corner < start + 3; corner++)
            if (!met[corner])
                meet(corner);
        for (let corner = start; corner < start + 3; corner++) {
            const vertex = corners[corner];
            next[corner] = first[vertex];
            first[vertex] = corner;
            if (around[vertex] < FULL)
                around[vertex]++;
        }
        for (let corner = start; corner < start + 3; corner++)
            if (!met[corner])
                queue[queued++] = corner;
    }

    const guesses = [];
    const add = (vertex) => guesses.length < GUESSES && !guesses.includes(vertex) && guesses.push(vertex);
    function findGuesses(gate) {
        const from = corners[gate], to = corners[after(gate)], own = Math.floor(gate / 3);
        guesses.length = 0;
        for (let corner = first[to], steps = 0; corner !== NONE && steps < STEPS; steps++, corner = next[corner])
            if (!met[corner] && corners[after(corner)] !== from)
                add(corners[after(corner)]);
        for (let corner = first[from], steps = 0; corner !== NONE && steps < STEPS; steps++, corner = next[corner]) {
            const before = after(after(corner));
            if (!met[before] && corners[before] !== to && Math.floor(before / 3) !== own)
                add(corners[before]);
        }
    }

    function readVertex() {
        const vertex = fresh - coder.number(vertexModel);
        if (vertex === fresh)
            fresh++;
        return vertex;
    }

    function readFar(place) {
        if (!coder.bit(known + place))
            return fresh++;
        for (let i = 0; i < guesses.length; i++)
            if (coder.bit(guess + i))
                return guesses[i];
        return readVertex();
    }

    function pass(gate) {
        const from = corners[gate], to = corners[after(gate)], triangle = Math.floor(gate / 3);
        findGuesses(gate);
        const place = Math.min(guesses.length, 2) * AROUND + around[from] * (FULL + 1) + around[to];
        if (!coder.bit(reached + place))
            return;
        const last = readFar(place);
        const turned = turn + 4 * ((last + 1 === fresh ? 9 : 0) + 3 * far[triangle] + (gate % 3));
        const own = coder.bit(turned + 1) ? 2 : coder.bit(turned + 2);
        far[told] = (own + 2) % 3;
        corners[3 * told + own] = to;
        corners[3 * told + ((own + 1) % 3)] = from;
        corners[3 * told + far[told]] = last;
        chart[told] = chart[triangle];
        gates[told] = gate;
        met[gate] = met[3 * told + own] = 1;
        putIn();
    }

    while (told < count) {
        chart[told] = (told ? chart[told - 1] : 0) + coder.number(chartModel);
        for (let k = 0; k < 3; k++)
            corners[3 * told + k] = readVertex();
        putIn();
        while (taken < queued) {
            const gate = queue[taken++];
            if (!met[gate])
                pass(gate);
        }
    }
    return {triangles: corners, chart, gates, far};
}
