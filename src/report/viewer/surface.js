/* Surfaces as the page draws them: rounded (model.c), or from that which layouts are evaluated on (exact.js). */
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
        /* Whole numbers of few bytes each. */
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

    function readTriangles(take, count) {
        const before = take.small(3 * count), triangles = new Uint32Array(3 * count);
        for (let i = 0, next = 0; i < 3 * count; i++) {
            triangles[i] = next - before[i];
            next = Math.max(next, triangles[i] + 1);
        }
        return triangles;
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
    function read(model, take, coder) {
        if (!model.exact)
            return readRounded(model, take);
        const {surface, drawn} = exact.read(coder, model.exact, model.triangles);
        model.surface = surface;
        drawnOf(model, surface, drawn);
    }
    return {reader, read};
})();
