/* The other way round of unfolded.c, operation by operation: where triangles lie on the pages of the atlas. */
function readUnfolded(coder, walk, places, charts) {
    "use strict";
    const {triangles, chart, gates, far} = walk;
    const FARTHEST = 1e6, partsModel = coder.numbers(), own = coder.numbers(2), off = coder.numbers(2 * 64);
    const parts = Float64Array.from({length: charts}, () => coder.number(partsModel));
    const count = chart.length, vertices = places.length / 3, uv = new Float64Array(6 * count);
    const latest = new Int32Array(vertices).fill(-1), spots = new Float64Array(2 * vertices), spot = [0, 0];

    /* Where corner i lies if the triangle keeps its shape. */
    function turnIn(t, i) {
        const one = (i + 1) % 3, two = (i + 2) % 3, a = 3 * triangles[3 * t + one], b = 3 * triangles[3 * t + two];
        const c = 3 * triangles[3 * t + i], from = 6 * t + 2 * one, to = 6 * t + 2 * two;
        const ex = places[b] - places[a], ey = places[b + 1] - places[a + 1], ez = places[b + 2] - places[a + 2];
        const fx = places[c] - places[a], fy = places[c + 1] - places[a + 1], fz = places[c + 2] - places[a + 2];
        const length2 = ex * ex + ey * ey + ez * ez, along = (ex * fx + ey * fy + ez * fz) / length2;
        const x = ey * fz - ez * fy, y = ez * fx - ex * fz, z = ex * fy - ey * fx;
        const across = Math.sqrt(x * x + y * y + z * z) / length2, gx = uv[to] - uv[from], gy = uv[to + 1] - uv[from + 1];
        spot[0] = uv[from] + along * gx - across * gy;
        spot[1] = uv[from + 1] + along * gy + across * gx;
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
