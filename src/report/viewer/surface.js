/* Surfaces as the page holds them: rounded for drawing (model.c), or to the last bit (exact.c, unfolded.c), of which
 * this is the other way round, operation by operation. */
const surfaces = (() => {
    "use strict";

    /* Arrays one after the other, each from a multiple of four bytes on; most as differences to the value before. */
    function reader(buffer) {
        let at = 0;
        const take = (Kind, count, differences) => {
            const values = new Kind(buffer, at, count);
            at += Math.ceil(values.byteLength / 4) * 4;
            for (let i = 1; differences && i < count; i++)
                values[i] += values[i - 1];
            return values;
        };
        /* Lowest bytes first, then the next ones. */
        take.split = (count) => {
            const bytes = take(Uint8Array, 4 * count), values = new Uint32Array(count);
            for (let i = 0; i < count; i++) {
                const told = bytes[i] | bytes[count + i] << 8 | bytes[2 * count + i] << 16 | bytes[3 * count + i] << 24;
                values[i] = (told >>> 1 ^ -(told & 1)) + (i ? values[i - 1] : 0);
            }
            return values;
        };
        /* Whole numbers of few bytes each. */
        take.numbers = (count) => {
            const lengths = take(Uint8Array, count), [all] = take(Uint32Array, 1), bytes = take(Uint8Array, all);
            const values = new BigUint64Array(count), room = new Uint8Array(values.buffer);
            for (let i = 0, from = 0; i < count; from += lengths[i++])
                for (let k = 0; k < lengths[i]; k++)
                    room[8 * i + k] = bytes[from + k];
            for (let i = 0; i < count; i++)
                if (values[i])
                    values[i] = values[i] & 1n ? ~(values[i] >> 1n) : values[i] >> 1n;
            return new BigInt64Array(values.buffer);
        };
        /* The same of numbers below 2^52, as such. */
        take.small = (count) => {
            const lengths = take(Uint8Array, count), [all] = take(Uint32Array, 1), bytes = take(Uint8Array, all);
            const values = new Float64Array(count);
            for (let i = 0, from = 0; i < count; from += lengths[i++]) {
                let told = 0;
                for (let k = lengths[i]; k > 0; k--)
                    told = 256 * told + bytes[from + k - 1];
                values[i] = told % 2 ? -(told + 1) / 2 : told / 2;
            }
            return values;
        };
        return take;
    }

    /* A float's bits, to be moved from one to one so many farther on. */
    const one = new Float64Array(1), bits = new BigInt64Array(one.buffer);
    function moved(value, apart) {
        if (apart === 0n)
            return value;
        one[0] = value;
        bits[0] += apart;
        return one[0];
    }

    function doubles(take, count) {
        const apart = take.numbers(count), values = new Float64Array(count);
        for (let i = 0; i < count; i++)
            values[i] = moved(i ? values[i - 1] : 0, apart[i]);
        return values;
    }

    const MOST_DIGITS = 60, STEPS = 32;

    /* Corners of the triangles that are known, by the vertex that they are at. */
    function around(triangles, vertices) {
        const first = new Int32Array(vertices).fill(-1), next = new Int32Array(triangles.length);
        const add = (corner) => {
            next[corner] = first[triangles[corner]];
            first[triangles[corner]] = corner;
        };
        /* The third corner of the latest triangle on the edge from a to b, -1 for none. */
        const beyond = (a, b) => {
            for (let corner = first[a], steps = 0; corner >= 0 && steps < STEPS; corner = next[corner], steps++) {
                const start = corner - (corner % 3), one = triangles[start + ((corner + 1) % 3)];
                const two = triangles[start + ((corner + 2) % 3)];
                if (one === b || two === b)
                    return one === b ? two : one;
            }
            return -1;
        };
        return {add, beyond};
    }

    function readTriangles(take, count) {
        const before = take.small(3 * count), triangles = new Uint32Array(3 * count);
        for (let i = 0, next = 0; i < 3 * count; i++) {
            triangles[i] = next - before[i];
            next = Math.max(next, triangles[i] + 1);
        }
        return triangles;
    }

    /* As faces.c tells them: each by a neighbour so many triangles back and the edges on which they meet, or by itself. */
    function readFaces(take, count) {
        if (!take(Uint32Array, 1)[0])
            return take.split(3 * count);
        const lags = take(Uint8Array, count), turned = lags.reduce((sum, lag) => sum + (lag > 0), 0);
        const turns = take(Uint8Array, turned), before = take.small(3 * count - 2 * turned);
        const triangles = new Uint32Array(3 * count);
        let told = 0, turn = 0, fresh = 0;
        const tell = (corner) => {
            triangles[corner] = fresh - before[told++];
            fresh = Math.max(fresh, triangles[corner] + 1);
        };
        for (let i = 0; i < count; i++) {
            if (!lags[i]) {
                [0, 1, 2].forEach((k) => tell(3 * i + k));
                continue;
            }
            const other = 3 * (i - lags[i]), its = Math.floor(turns[turn] / 3), own = turns[turn++] % 3;
            triangles[3 * i + own] = triangles[other + ((its + 1) % 3)];
            triangles[3 * i + ((own + 1) % 3)] = triangles[other + its];
            tell(3 * i + ((own + 2) % 3));
        }
        return triangles;
    }

    /* As places.c tells them. */
    function readNumbers(take, triangles, {vertices, base, digits}) {
        const more = take(Int8Array, 3 * vertices), off = take.small(3 * vertices);
        const numbers = new Float64Array(3 * vertices), known = new Uint8Array(vertices);
        const {add, beyond} = around(triangles, vertices);
        let count = 0, last = -1;
        const stepOf = (power) => {
            let step = 1;
            for (; power > 0; power--)
                step *= base;
            return step;
        };
        const start = stepOf(digits);
        function zerosOf(number) {
            let zeros = 0;
            for (let limit = start; Math.abs(number) >= limit && zeros < MOST_DIGITS; limit *= base)
                zeros++;
            return zeros;
        }
        function tell(vertex, a, b) {
            const [hasA, hasB] = [a, b].map((one) => one >= 0 && known[one]), other = hasA && hasB ? beyond(a, b) : -1;
            const near = hasA ? a : hasB ? b : last;
            for (let k = 0; k < 3; k++, count++) {
                const expected = other >= 0 ? numbers[3 * a + k] + numbers[3 * b + k] - numbers[3 * other + k]
                    : near >= 0 ? numbers[3 * near + k] : 0;
                const step = stepOf(zerosOf(expected) + more[count]);
                numbers[3 * vertex + k] = (Math.floor(expected / step + 0.5) + off[count]) * step;
            }
            known[vertex] = 1;
            last = vertex;
        }
        for (let i = 0; i < triangles.length; i += 3) {
            for (let k = 0; k < 3; k++)
                if (!known[triangles[i + k]])
                    tell(triangles[i + k], triangles[i + ((k + 1) % 3)], triangles[i + ((k + 2) % 3)]);
            for (let k = 0; k < 3; k++)
                add(i + k);
        }
        for (let i = 0; i < vertices; i++)
            if (!known[i])
                tell(i, -1, -1);
        return numbers;
    }

    function readVertices(take, triangles, about) {
        const places = readNumbers(take, triangles, about), apart = take.numbers(places.length);
        for (let i = 0; i < places.length; i++)
            places[i] = moved(places[i] / about.parts * about.unit, apart[i]);
        return places;
    }

    const PARTS = 16, SWEEPS = 64, FARTHEST = 1e6;

    /* Into spot: where the corner opposite to the edge from a to b, at from and to, lies if the triangle keeps its
     * shape. */
    function turnIn(places, a, b, c, from, to, spot) {
        const ex = places[3 * b] - places[3 * a], ey = places[3 * b + 1] - places[3 * a + 1];
        const ez = places[3 * b + 2] - places[3 * a + 2], fx = places[3 * c] - places[3 * a];
        const fy = places[3 * c + 1] - places[3 * a + 1], fz = places[3 * c + 2] - places[3 * a + 2];
        const length2 = ex * ex + ey * ey + ez * ez, along = (ex * fx + ey * fy + ez * fz) / length2;
        const x = ey * fz - ez * fy, y = ez * fx - ex * fz, z = ex * fy - ey * fx;
        const across = Math.sqrt(x * x + y * y + z * z) / length2, gx = to[0] - from[0], gy = to[1] - from[1];
        spot[0] = from[0] + along * gx - across * gy;
        spot[1] = from[1] + along * gy + across * gx;
        if (!(Math.abs(spot[0]) < FARTHEST && Math.abs(spot[1]) < FARTHEST))
            spot.set(from);
    }

    /* The latest places of vertices in charts, by number: -1 where there is none. */
    function latest(vertices, most) {
        const first = new Int32Array(vertices).fill(-1), next = new Int32Array(most), charts = new Int32Array(most);
        const spots = new Float64Array(2 * most);
        let count = 0;
        const find = (chart, vertex) => {
            let i = first[vertex];
            while (i >= 0 && charts[i] !== chart)
                i = next[i];
            return i;
        };
        const remember = (chart, vertex, spot) => {
            let i = find(chart, vertex);
            if (i < 0) {
                i = count++;
                charts[i] = chart;
                next[i] = first[vertex];
                first[vertex] = i;
            }
            spots.set(spot, 2 * i);
        };
        return {find, remember, spot: (i) => spots.subarray(2 * i, 2 * i + 2)};
    }

    /* The corners in their charts, triangle by triangle as they are told. */
    function unfolder(take, surface, charts) {
        const {triangles, chart, places} = surface, count = chart.length;
        const rounded = take(Uint8Array, charts), apart = take.numbers(6 * count);
        const uv = new Float64Array(6 * count), told = new Uint8Array(count), spot = new Float64Array(2);
        const known = latest(places.length / 3, 3 * count);
        let next = 0;
        const find = (t, i) => known.find(chart[t], triangles[3 * t + i]);
        /* Into spot, which holds the corner told before. */
        function expect(t, i) {
            const own = find(t, i), a = (i + 1) % 3, b = (i + 2) % 3;
            if (own >= 0) {
                spot.set(known.spot(own));
                return;
            }
            const from = find(t, a), to = find(t, b);
            if (from >= 0 && to >= 0)
                turnIn(places, triangles[3 * t + a], triangles[3 * t + b], triangles[3 * t + i], known.spot(from),
                       known.spot(to), spot);
        }
        function tell(t) {
            spot.fill(0);
            told[t] = 1;
            for (let i = 0; i < 3; i++) {
                expect(t, i);
                for (let k = 0; k < 2; k++) {
                    const off = apart[next++];
                    spot[k] = rounded[chart[t]] ? (Math.floor(spot[k] * PARTS) + Number(off)) / PARTS
                                                : moved(spot[k], off);
                }
                known.remember(chart[t], triangles[3 * t + i], spot);
                uv.set(spot, 6 * t + 2 * i);
            }
        }
        const corners = (t) => (find(t, 0) >= 0) + (find(t, 1) >= 0) + (find(t, 2) >= 0);
        return {uv, told, tell, corners};
    }

    /* Those of which two corners are known first, as unfolded.c tells them. */
    function readUnfolded(take, surface, charts) {
        const {uv, told, tell, corners} = unfolder(take, surface, charts), count = told.length;
        for (let sweeps = 0, first = 0;; sweeps++) {
            let any = false;
            for (let i = 0; i < count; i++) {
                const t = sweeps % 2 ? count - 1 - i : i;
                if (told[t] || corners(t) < (sweeps < SWEEPS ? 2 : 0))
                    continue;
                any = true;
                tell(t);
            }
            while (first < count && told[first])
                first++;
            if (first === count)
                return uv;
            if (!any)
                tell(first);
        }
    }

    /* What layouts are evaluated on. */
    function readExact(take, about) {
        const {triangles, charts, nodes, cuts} = about, surface = {triangles: readFaces(take, triangles)};
        surface.places = readVertices(take, surface.triangles, about);
        surface.part = take(Uint32Array, triangles, true);
        surface.chart = take(Uint32Array, triangles, true);
        surface.chartPage = take(Uint32Array, charts, true);
        surface.chartTexel = doubles(take, charts);
        surface.uv = readUnfolded(take, surface, charts);
        return {surface, rest: () => {
            surface.sides = take(Uint8Array, triangles);
            surface.nodes = take(Uint8Array, nodes);
            surface.cuts = doubles(take, 3 * cuts);
        }};
    }

    /* Drawn corners that are one share a vertex: at each vertex of the mesh the latest first. */
    function drawnOf(model, surface, drawn) {
        const first = new Int32Array(surface.places.length / 3).fill(-1), most = 3 * drawn.length;
        const next = new Int32Array(most), at = new Uint32Array(most), u = new Uint16Array(most);
        const v = new Uint16Array(most), corners = new Uint32Array(most);
        const part = (value, low, high) => (high > low ? Math.round(65535 * (value - low) / (high - low)) : 0);
        let count = 0;
        function vertexAt(vertex, x, y) {
            let found = first[vertex];
            while (found >= 0 && (u[found] !== x || v[found] !== y))
                found = next[found];
            if (found >= 0)
                return found;
            next[count] = first[vertex];
            [at[count], u[count], v[count]] = [vertex, x, y];
            first[vertex] = count;
            return count++;
        }
        for (const range of model.draws)
            for (let i = range.first; i < range.first + range.count; i++)
                for (let k = 0; k < 3; k++) {
                    const corner = 3 * drawn[i] + (range.layer ? 2 - k : k);
                    corners[3 * i + k] = vertexAt(surface.triangles[corner],
                        part(surface.uv[2 * corner], 0, model.edge), part(surface.uv[2 * corner + 1], 0, model.edge));
                }
        const packed = new Uint16Array(6 * count), places = new Float32Array(3 * count);
        for (let i = 0; i < count; i++) {
            for (let k = 0; k < 3; k++) {
                places[3 * i + k] = surface.places[3 * at[i] + k];
                packed[6 * i + k] = part(surface.places[3 * at[i] + k], model.low[k], model.high[k]);
            }
            packed[6 * i + 3] = u[i];
            packed[6 * i + 4] = v[i];
        }
        model.corners = corners;
        model.vertex = {packed, places, u, v};
    }

    function readRounded(model, take) {
        const axes = Array.from({length: 5}, () => take(Uint16Array, model.vertices, true));
        const packed = new Uint16Array(6 * model.vertices), places = new Float32Array(3 * model.vertices);
        for (let i = 0; i < model.vertices; i++)
            for (let k = 0; k < 5; k++) {
                packed[6 * i + k] = axes[k][i];
                if (k < 3)
                    places[3 * i + k] = model.low[k] + (axes[k][i] / 65535) * (model.high[k] - model.low[k]);
            }
        model.vertex = {packed, places, u: axes[3], v: axes[4]};
        model.corners = readTriangles(take, model.triangles);
    }

    /* Sets the model's vertex and corners, and where layouts can be evaluated on it its surface. */
    function read(model, take) {
        if (!model.exact)
            return readRounded(model, take);
        const {surface, rest} = readExact(take, model.exact);
        const drawn = take(Uint32Array, model.triangles, true);
        rest();
        model.surface = surface;
        drawnOf(model, surface, drawn);
    }
    return {reader, read};
})();
