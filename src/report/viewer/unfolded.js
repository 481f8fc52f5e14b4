/* The other way round of unfolded.c, operation by operation: where triangles lie on the pages of the atlas. */
function readUnfolded(coder, walk, places, charts) {
    "use strict";
    const {triangles, chart, gates, far} = walk;
    const FARTHEST = 1e6, partsModel = coder.numbers(), own = coder.numbers(2), off = coder.numbers(2 * 64);
    const parts = Float64Array.from({length: charts}, () => coder.number(partsModel));
    const count = chart.length, vertices = places.length / 3, uv = new Float64Array(6 * count);
    const latest = new Int32Array(vertices).fill(-1), spots = new Float64Array(2 * vertices), spot = [0, 0];

    /* How far a vertex lies along an edge, and off it, both in parts of the edge. */
    const measured = [0, 0];
    function measure(from, to, vertex) {
        const ex = places[3 * to] - places[3 * from], ey = places[3 * to + 1] - places[3 * from + 1];
        const ez = places[3 * to + 2] - places[3 * from + 2], fx = places[3 * vertex] - places[3 * from];
        const fy = places[3 * vertex + 1] - places[3 * from + 1], fz = places[3 * vertex + 2] - places[3 * from + 2];
        const length2 = ex * ex + ey * ey + ez * ez;
        const x = ey * fz - ez * fy, y = ez * fx - ex * fz, z = ex * fy - ey * fx;
        measured[0] = (ex * fx + ey * fy + ez * fz) / length2;
        measured[1] = Math.sqrt(x * x + y * y + z * z) / length2;
    }

    /* Where corner i lies if its triangle is turned into the page at the edge to its neighbour and strained as that. */
    function turnIn(t, i) {
        const one = (i + 1) % 3, two = (i + 2) % 3, from = 6 * t + 2 * one, to = 6 * t + 2 * two;
        const third = gates[t] - (gates[t] % 3) + (((gates[t] % 3) + 2) % 3);
        measure(triangles[3 * t + one], triangles[3 * t + two], triangles[3 * t + i]);
        const [along, off] = measured;
        measure(triangles[3 * t + one], triangles[3 * t + two], triangles[third]);
        for (let k = 0; k < 2; k++) {
            const g = uv[to + k] - uv[from + k];
            const across = (uv[from + k] + measured[0] * g - uv[2 * third + k]) / measured[1];
            spot[k] = uv[from + k] + along * g + off * across;
        }
        if (!(Math.abs(spot[0]) < FARTHEST && Math.abs(spot[1]) < FARTHEST))
            [spot[0], spot[1]] = [uv[from], uv[from + 1]];
    }

    function tell(t, i) {
        const vertex = triangles[3 * t + i], seen = latest[vertex] === chart[t], at = 6 * t + 2 * i;
        if (seen)
            [spot[0], spot[1]] = [spots[2 * vertex], spots[2 * vertex + 1]];
        else if (gates[t] >= 0)
            turnIn(t, i);
        else
            [spot[0], spot[1]] = i ? [uv[at - 2], uv[at - 1]] : [0, 0];
        const whole = parts[chart[t]];
        for (let k = 0, before = 0; k < 2; k++) {
            const apart = coder.number((seen ? own + k * coder.NUMBER : off + (64 * k + before) * coder.NUMBER));
            before = coder.length;
            uv[at + k] = spots[2 * vertex + k] = whole > 0 ? (Math.floor(spot[k] * whole) + apart) / whole
                : exact.moved(spot[k], apart);
        }
        latest[vertex] = chart[t];
    }

    for (let t = 0; t < count; t++) {
        if (gates[t] < 0) {
            [0, 1, 2].forEach((k) => tell(t, k));
            continue;
        }
        const gate = gates[t], start = gate - (gate % 3), end = 2 * (start + (((gate % 3) + 1) % 3));
        for (let k = 0; k < 2; k++) {
            uv[6 * t + 2 * ((far[t] + 1) % 3) + k] = uv[end + k];
            uv[6 * t + 2 * ((far[t] + 2) % 3) + k] = uv[2 * gate + k];
        }
        tell(t, far[t]);
    }
    return uv;
}
