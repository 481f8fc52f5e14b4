/* Runs live.wasm (src/live) beside the page: told once what there is, it evaluates layouts as they are asked for. The
 * numbers of arrays, settings and results are those of live.h. */
"use strict";
(() => {
    const ARRAYS = ["settings", "places", "triangles", "part", "clean", "names", "chart", "uv", "chartPage",
                    "chartTexel", "sides", "nodes", "cuts", "types", "members"];
    const NOZZLES = 15, FIGURES = 0, SHARE = 5, SHADOW_LIST = 6, SHADOW_OF = 7, BOXES = 8, LEGS = 9, SHADOW_NUMBERS = 6,
          LEG_NUMBERS = 8;
    let wasm, live, count = 0, quantities = [];

    const bytesAt = (at, bytes) => new Uint8Array(wasm.memory.buffer, at, bytes);
    const doublesAt = (at, many) => new Float64Array(wasm.memory.buffer, at, many);
    function text(at) {
        const all = new Uint8Array(wasm.memory.buffer, at);
        return new TextDecoder().decode(all.slice(0, all.indexOf(0)));
    }
    const why = () => text(wasm.sp_live_error(live));

    function handOver(which, array) {
        const bytes = new Uint8Array(array.buffer, array.byteOffset, array.byteLength);
        const at = wasm.sp_live_hand_over(live, which, bytes.length);
        if (!at)
            throw new Error("out of memory");
        bytesAt(at, bytes.length).set(bytes);
    }

    async function open({module, arrays, shown}) {
        const none = () => 0;
        const made = await WebAssembly.instantiate(module, {wasi_snapshot_preview1: new Proxy({}, {get: () => none})});
        wasm = made.instance.exports;
        wasm._initialize();
        live = wasm.sp_live_create();
        ARRAYS.forEach((name, which) => handOver(which, arrays[name]));
        quantities = shown;
        if (!wasm.sp_live_open(live))
            throw new Error(why());
        return {};
    }

    /* As quantities.c. */
    function bytesOf(values, {low, high, log, toUnit, atMost, asked}, flux) {
        const bytes = new Uint8Array(values.length), span = log ? Math.log(high / low) : high - low;
        const meets = (value) => (atMost ? value <= asked : value >= asked);
        const valueOf = (byte) => (log ? low * Math.exp((span * (byte - 1)) / 254) : low + (span * (byte - 1)) / 254);
        for (let i = 0; i < values.length; i++) {
            if (!(flux[i] > 0))
                continue;
            const told = values[i] * toUnit, place = (log ? Math.log(told / low) : told - low) / span;
            let byte = 1 + Math.round(254 * Math.min(Math.max(place, 0), 1));
            if (asked > 0 && meets(valueOf(byte)) !== meets(told))
                byte += meets(told) === atMost ? -1 : 1;
            bytes[i] = Math.min(Math.max(byte, 1), 255);
        }
        return bytes;
    }

    function sharesOf(values) {
        return Uint8Array.from(values, (share) => {
            const byte = Math.round(255 * Math.min(Math.max(share, 0), 1));
            return share >= 0.5 ? Math.max(byte, 128) : Math.min(byte, 127);
        });
    }

    const patchesOf = (what) => doublesAt(wasm.sp_live_tell(live, what), count);

    function evaluate({nozzles, stride}) {
        const start = performance.now();
        handOver(NOZZLES, Float64Array.from(nozzles.flat()));
        if (!wasm.sp_live_evaluate(live, stride))
            throw new Error(why());
        const figures = doublesAt(wasm.sp_live_tell(live, FIGURES), 6).slice();
        count = figures[3];
        const flux = patchesOf(1);
        const values = quantities.map((quantity, k) => bytesOf(patchesOf(1 + k), quantity, flux));
        const share = sharesOf(patchesOf(SHARE));
        return {figures: {coverage: figures[0], covered: figures[1], flow: figures[2], traced: figures[5]}, values,
                share, stride, ms: performance.now() - start};
    }

    /* What may wait: shadows, what each nozzle does alone, whether it can stand, a few of its jets. */
    function finish({nozzles}) {
        if (!wasm.sp_live_find_shadows(live))
            throw new Error(why());
        const found = doublesAt(wasm.sp_live_tell(live, FIGURES), 6)[4];
        const list = doublesAt(wasm.sp_live_tell(live, SHADOW_LIST), found * SHADOW_NUMBERS);
        const shadows = Array.from({length: found}, (_, i) => {
            const [area, x, y, z, part, lack] = list.subarray(i * SHADOW_NUMBERS);
            return {area, at: [x, y, z], part, lack};
        });
        const numbers = new Uint32Array(wasm.memory.buffer, wasm.sp_live_tell(live, SHADOW_OF), count);
        const shadowOf = Uint8Array.from(numbers);
        const alone = nozzles.map((_, i) => {
            const at = wasm.sp_live_alone(live, i), flux = at && doublesAt(at, count);
            return at ? bytesOf(flux, quantities[0], flux) : new Uint8Array(count);
        });
        const stands = nozzles.map((_, i) => (wasm.sp_live_admits(live, i) ? "" : why()));
        const jets = nozzles.map((_, i) => {
            const legs = wasm.sp_live_fly(live, i);
            return doublesAt(wasm.sp_live_tell(live, LEGS), LEG_NUMBERS * legs).slice();
        });
        return {shadows, shadowOf, alone, stands, jets};
    }

    /* What the nozzle in hand may reach, so that it can be turned at once. */
    function prepare({chosen}) {
        if (!wasm.sp_live_prepare(live, chosen))
            throw new Error(why());
        return {};
    }

    /* The foot on any of these parts that is nearest. */
    function foot({parts, point}) {
        let nearest = null, least = Infinity;
        for (const part of parts) {
            const at = wasm.sp_live_foot(live, part, ...point);
            if (!at)
                continue;
            const found = [...doublesAt(at, 6)], far = Math.hypot(...[0, 1, 2].map((k) => found[k] - point[k]));
            if (far < least)
                [nearest, least] = [found, far];
        }
        return {place: nearest && nearest.slice(0, 3), normal: nearest && nearest.slice(3), far: least};
    }

    /* Those of the accelerator's leaves. */
    function boxes() {
        const found = wasm.sp_live_boxes(live);
        return doublesAt(wasm.sp_live_tell(live, BOXES), 6 * found).slice();
    }

    const acts = {open, evaluate, finish, prepare, foot, boxes};
    addEventListener("message", async ({data}) => {
        try {
            postMessage({id: data.id, answer: await acts[data.act](data)});
        } catch (error) {
            postMessage({id: data.id, error: String(error.message || error)});
        }
    });
})();
