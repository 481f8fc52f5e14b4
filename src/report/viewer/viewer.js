/* The report's viewer: the surface in colours that may be turned, cut and asked, every design under one camera. Needs
 * WebGL 2; without it the section stays hidden and the page is what it is on paper. The data is written by model.c. */
const viewer = (async () => {
    "use strict";
    const section = document.getElementById("viewer");
    const gl = document.createElement("canvas").getContext("webgl2", {antialias: true, preserveDrawingBuffer: true});
    if (!section || !gl || !window.DecompressionStream)
        return null;

    /* ---- the data ---- */

    const about = JSON.parse(document.getElementById("viewer-model").textContent);

    /* Two letters of 91 are 13 bits, the least first; what they hold is deflated. */
    const letters = "!#$%&'()*+,-./0123456789:;=>?@ABCDEFGHIJKLMNOPQRSTUVWXYZ[]^_`abcdefghijklmnopqrstuvwxyz{|}~";
    const digits = new Uint8Array(128);
    [...letters].forEach((letter, value) => (digits[letter.charCodeAt(0)] = value));
    async function inflated(text) {
        const from = text.indexOf(" ") + 1, bytes = new Uint8Array(Number(text.slice(0, from)));
        for (let i = from, held = 0, bits = 0, at = 0; i < text.length; i += 2) {
            held |= (digits[text.charCodeAt(i)] + 91 * digits[text.charCodeAt(i + 1)]) << bits;
            for (bits += 13; bits >= 8; bits -= 8, held >>>= 8)
                bytes[at++] = held;
        }
        const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
        return new Response(stream).arrayBuffer();
    }

    /* For each layer a picture of the pages, a patch's number + 1 in every pixel that it has, 0 elsewhere. */
    function readPages(model, take) {
        const rows = take(Uint32Array, model.runs, true);
        const starts = take(Uint16Array, model.runs, false);
        const counts = take(Uint16Array, model.runs, false);
        return Array.from({length: model.layers}, () => {
            const patches = take(Uint32Array, model.pixels, true);
            const page = new Uint32Array(model.pages * model.edge * model.edge);
            for (let run = 0, pixel = 0; run < model.runs; run++)
                for (let k = 0; k < counts[run]; k++)
                    page[rows[run] * model.edge + starts[run] + k] = patches[pixel++];
            return page;
        });
    }

    /* Of each patch the one above it on its page, or else left of it, -1 for none: design.c. */
    function patchesBeside(model) {
        const beside = new Int32Array(model.patches).fill(-1), {edge} = model;
        for (const page of model.page)
            for (let i = 0; i < page.length; i++)
                if (page[i]) {
                    const above = Math.floor(i / edge) % edge && page[i - edge], left = i % edge && page[i - 1];
                    beside[page[i] - 1] = (above || left || 0) - 1;
                }
        return beside;
    }

    function readDesign(design, model, take) {
        const bytes = () => {
            const values = take(Uint8Array, model.patches, false);
            for (let i = 0; i < values.length; i++)
                values[i] += model.beside[i] < 0 ? 0 : values[model.beside[i]];
            return values;
        };
        design.values = Object.fromEntries(about.quantities.map((quantity) => [quantity.key, bytes()]));
        design.share = bytes();
        design.film = bytes();
        design.shadowOf = bytes();
        design.nozzles.forEach((nozzle) => (nozzle.flux = nozzle.known ? bytes() : null));
        design.model = model;
    }

    async function readModel(model) {
        const take = surfaces.reader(await inflated(model.data));
        delete model.data;
        surfaces.read(model, take);
        model.page = readPages(model, take);
        model.beside = patchesBeside(model);
        model.designs.forEach((design) => readDesign(design, model, take));
    }

    await Promise.all(about.models.map(readModel));
    const designs = about.models.flatMap((model) => model.designs).sort((a, b) => a.index - b.index);
    const flux = about.quantities.find((quantity) => quantity.key === "flux");
    const palette = Uint8Array.from(about.palette.match(/../g), (digits) => parseInt(digits, 16));

    /* ---- what is shown ---- */

    const coverage = {key: "covered", name: "Covered"};
    const difference = {key: "difference", name: "Difference"};
    const state = {
        quantity: flux,
        scales: Object.fromEntries(about.quantities.map(({key, log}) => [key, log ? "log" : "linear"])),
        shown: designs.filter((design) => design.first),
        hidden: new Set(),
        cut: {axis: about.models[0].cut ? 1 : -1, place: 0, turned: false},
        nozzle: null,
        shadow: null,
        camera: null,
    };

    /* The value that a byte stands for, NaN for none; the ends of the scale mean that or beyond. */
    function valueOf(quantity, byte) {
        if (byte === 0)
            return NaN;
        const t = (byte - 1) / 254;
        return quantity.log ? quantity.low * (quantity.high / quantity.low) ** t
                            : quantity.low + t * (quantity.high - quantity.low);
    }

    /* Where on the colour bar, 0 to 1. */
    function shade(quantity, value) {
        const [low, high] = quantity.shown;
        const scale = state.scales[quantity.key];
        if (scale === "stepped")
            return value < (quantity.step || low) ? 0.15 : 0.85;
        const t = scale === "log" && low > 0 ? Math.log(value / low) / Math.log(high / low)
                                             : (value - low) / (high - low);
        return Math.min(Math.max(t, 0), 1);
    }

    function setColour(colours, i, red, green, blue, kind) {
        colours.set([red, green, blue, kind], 4 * i);
    }
    const PLAIN = 255, UNCOVERED = 0, MARKED = 128; /* kinds, as the fragment shader tells them */

    function setShade(colours, i, t, kind) {
        const k = Math.round(255 * t);
        setColour(colours, i, palette[3 * k], palette[3 * k + 1], palette[3 * k + 2], kind);
    }

    const coloured = () => (state.nozzle ? flux : state.quantity);
    const HALF = 128; /* of a byte of share: covered */
    const base = () => state.shown.find((design) => design.manual) || state.shown[0];

    function colourDifference(colours, design, from) {
        for (let i = 0; i < design.share.length; i++) {
            const before = from.share[i] >= HALF, now = design.share[i] >= HALF;
            if (now && !before)
                setColour(colours, i, 0, 140, 120, PLAIN);
            else if (before && !now)
                setColour(colours, i, 224, 120, 20, PLAIN);
            else
                setColour(colours, i, 205, 212, 220, now ? PLAIN : UNCOVERED);
        }
    }

    function colourQuantity(colours, design, quantity, bytes, keepsHatch) {
        for (let i = 0; i < bytes.length; i++) {
            const covered = design.share[i] >= HALF;
            if (keepsHatch && !covered)
                setColour(colours, i, 0, 0, 0, UNCOVERED);
            else if (design.film[i] && quantity === flux)
                setColour(colours, i, ...about.film, PLAIN);
            else if (bytes[i] === 0)
                setColour(colours, i, 222, 226, 230, PLAIN);
            else
                setShade(colours, i, shade(quantity, valueOf(quantity, bytes[i])), PLAIN);
        }
    }

    /* A colour for each patch of a design, RGBA, of a texture WIDE pixels wide. */
    const WIDE = 2048;
    function coloursOf(design) {
        const colours = new Uint8Array(4 * WIDE * Math.max(1, Math.ceil(design.share.length / WIDE)));
        const quantity = state.quantity;
        if (state.nozzle && state.nozzle.design === design)
            colourQuantity(colours, design, flux, design.nozzles[state.nozzle.index].flux, false);
        else if (quantity === difference && design.model === base().model && design !== base())
            colourDifference(colours, design, base());
        else if (quantity === coverage || quantity === difference)
            design.share.forEach((share, i) => setColour(colours, i, 70, 130, 180, share >= HALF ? PLAIN : UNCOVERED));
        else
            colourQuantity(colours, design, quantity, design.values[quantity.key], true);
        if (state.shadow && state.shadow.design === design)
            design.shadowOf.forEach((number, i) => {
                if (number === state.shadow.index + 1)
                    colours[4 * i + 3] = MARKED;
            });
        return colours;
    }

    /* ---- vectors and matrices (column by column) ---- */

    const {add, scaled, dot, cross, unit} = geometry;

    const up = about.up;
    const right = [1, 0, 0];
    const front = cross(right, up);
    const low = [0, 1, 2].map((k) => Math.min(...about.models.map((model) => model.low[k])));
    const high = [0, 1, 2].map((k) => Math.max(...about.models.map((model) => model.high[k])));
    const middle = scaled(add(low, high), 0.5);
    const size = Math.hypot(...add(high, low, -1)) || 1;
    const REACH = 0.3; /* tangent of half the opening angle, as in the page's pictures */

    /* Looks at all of it from there, from no farther than it takes. */
    function fit(azimuth, elevation) {
        state.camera = {azimuth, elevation, target: middle.slice(), distance: 0};
        const {back, across, above} = frame(), aspect = place(0).width / place(0).height || 1;
        const wide = REACH * Math.max(aspect, 1), tall = wide / aspect;
        for (let corner = 0; corner < 8; corner++) {
            const to = add([0, 1, 2].map((k) => (corner >> k & 1 ? high : low)[k]), middle, -1);
            const apart = Math.max(Math.abs(dot(to, across)) / wide, Math.abs(dot(to, above)) / tall);
            state.camera.distance = Math.max(state.camera.distance, 1.04 * apart + dot(to, back));
        }
    }

    /* The eye and the picture's axes. */
    function frame() {
        const {azimuth, elevation, target, distance} = state.camera;
        const level = add(scaled(front, Math.cos(azimuth)), right, Math.sin(azimuth));
        const back = add(scaled(level, Math.cos(elevation)), up, Math.sin(elevation));
        const across = unit(cross(up, level));
        return {eye: add(target, back, distance), back, across, above: cross(back, across)};
    }

    function projection(view, aspect) {
        const near = Math.max(state.camera.distance - size, 1e-3 * size), far = state.camera.distance + 2 * size;
        const {eye, back, across, above} = view;
        const sx = 1 / (REACH * Math.max(aspect, 1)), sy = sx * aspect;
        const a = (far + near) / (near - far), b = (2 * far * near) / (near - far);
        const row = (v, s) => [s * v[0], s * v[1], s * v[2], -s * dot(v, eye)];
        const rows = [row(across, sx), row(above, sy), row(back, a), row(back, -1)];
        rows[2][3] += b;
        return new Float32Array([0, 1, 2, 3].flatMap((column) => rows.map((values) => values[column])));
    }

    /* What is cut off lies where dot(plane, point) > plane[3]. */
    function cutPlane() {
        const {axis, place, turned} = state.cut;
        const plane = [0, 0, 0, 1e30];
        if (axis < 0)
            return plane;
        const sign = turned ? -1 : 1;
        const toEye = axis === 1 ? -1 : 1; /* looked at from the front, the near half goes first */
        plane[axis] = sign * toEye;
        plane[3] = plane[axis] * (middle[axis] + (place * (high[axis] - low[axis])) / 2);
        return plane;
    }

    /* ---- drawing ---- */

    const TILE = 4096; /* pixels of a texture: larger pages are several */
    const surfaceShaders = [`#version 300 es
        in vec3 place; in vec2 spot;
        uniform mat4 view; uniform vec3 low, extent; uniform float edge;
        out vec3 at; out vec2 pixel;
        void main() { at = low + place * extent; pixel = spot * edge; gl_Position = view * vec4(at, 1.); }`,
    `#version 300 es
        precision highp float; precision highp int; precision highp usampler2DArray;
        in vec3 at; in vec2 pixel;
        uniform usampler2DArray patches; uniform sampler2D colours;
        uniform int page, tiles; uniform float edge; uniform vec4 cut; uniform vec3 eye;
        out vec4 colour;
        void main() {
            if (dot(cut.xyz, at) > cut.w) discard;
            vec3 normal = normalize(cross(dFdx(at), dFdy(at)));
            float light = .62 + .38 * abs(dot(normal, normalize(eye - at)));
            vec3 paint = vec3(${about.grey.map((x) => (x / 255).toFixed(4)).join()});
            ivec2 spot = clamp(ivec2(pixel), ivec2(0), ivec2(int(edge) - 1));
            ivec2 tile = spot / ${TILE};
            int sheet = (page * tiles + tile.y) * tiles + tile.x;
            uint patchNumber = page < 0 ? 0u : texelFetch(patches, ivec3(spot - tile * ${TILE}, sheet), 0).r;
            if (patchNumber > 0u) {
                int i = int(patchNumber - 1u);
                vec4 found = texelFetch(colours, ivec2(i % ${WIDE}, i / ${WIDE}), 0);
                bool stripe = mod(gl_FragCoord.x + gl_FragCoord.y, 9.) < 2.6;
                paint = found.rgb;
                if (found.a < .25) paint = stripe ? vec3(.769, .149, .212) : vec3(.98, .973, .961);
                else if (found.a < .75) paint = stripe ? vec3(.06, .06, .1) : vec3(1., .84, .1);
            }
            colour = vec4(paint * light, 1.);
        }`];
    const lineShaders = [`#version 300 es
        in vec3 place; uniform mat4 view; out vec3 at;
        void main() { at = place; gl_Position = view * vec4(place, 1.); }`,
    `#version 300 es
        precision highp float; in vec3 at; uniform vec3 tint; out vec4 colour;
        void main() { colour = vec4(tint, 1.); }`];

    function program(sources) {
        const made = gl.createProgram();
        [gl.VERTEX_SHADER, gl.FRAGMENT_SHADER].forEach((kind, i) => {
            const shader = gl.createShader(kind);
            gl.shaderSource(shader, sources[i]);
            gl.compileShader(shader);
            gl.attachShader(made, shader);
        });
        gl.linkProgram(made);
        if (!gl.getProgramParameter(made, gl.LINK_STATUS))
            throw new Error(gl.getProgramInfoLog(made) || "shaders do not link");
        return new Proxy({made}, {get: (known, name) =>
            (name in known ? known[name] : (known[name] = gl.getUniformLocation(made, name)))});
    }
    const surfaceProgram = program(surfaceShaders), lineProgram = program(lineShaders);

    /* Triangles' rims may come to lie in the pixel beside theirs by rounding: it gets their patch. */
    function spread(page, edge, pages) {
        const before = page.slice();
        for (let row = 0; row < edge * pages; row++)
            for (let x = 0; x < edge; x++) {
                const here = row * edge + x;
                for (let k = 0; k < 9 && !page[here]; k++) {
                    const there = here + ((k % 3) - 1) + (Math.floor(k / 3) - 1) * edge;
                    page[here] = before[there] || 0;
                }
            }
        return page;
    }

    function uploadModel(model) {
        const {edge, pages, layers} = model;
        model.buffer = gl.createVertexArray();
        gl.bindVertexArray(model.buffer);
        gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
        gl.bufferData(gl.ARRAY_BUFFER, model.vertex.packed, gl.STATIC_DRAW);
        [["place", 3, 0], ["spot", 2, 6]].forEach(([name, width, offset]) => {
            const slot = gl.getAttribLocation(surfaceProgram.made, name);
            gl.enableVertexAttribArray(slot);
            gl.vertexAttribPointer(slot, width, gl.UNSIGNED_SHORT, true, 12, offset);
        });
        gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
        gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, model.corners, gl.STATIC_DRAW);
        uploadPages(model);
    }

    function uploadPages(model) {
        const {edge, pages, layers} = model, tiles = Math.ceil(edge / TILE), most = Math.min(edge, TILE);
        model.tiles = tiles;
        model.texture = gl.createTexture();
        gl.bindTexture(gl.TEXTURE_2D_ARRAY, model.texture);
        gl.texStorage3D(gl.TEXTURE_2D_ARRAY, 1, gl.R32UI, most, most, pages * layers * tiles * tiles);
        gl.pixelStorei(gl.UNPACK_ROW_LENGTH, edge);
        model.page.forEach((page, layer) => {
            const shown = spread(page.slice(), edge, pages);
            for (let i = 0; i < pages * tiles * tiles; i++) {
                const x = (i % tiles) * TILE, y = (Math.floor(i / tiles) % tiles) * TILE;
                const from = (Math.floor(i / tiles / tiles) * edge + y) * edge + x;
                gl.texSubImage3D(gl.TEXTURE_2D_ARRAY, 0, 0, 0, layer * pages * tiles * tiles + i,
                                 Math.min(most, edge - x), Math.min(most, edge - y), 1, gl.RED_INTEGER,
                                 gl.UNSIGNED_INT, shown, from);
            }
        });
        gl.pixelStorei(gl.UNPACK_ROW_LENGTH, 0);
        gl.texParameteri(gl.TEXTURE_2D_ARRAY, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
        gl.texParameteri(gl.TEXTURE_2D_ARRAY, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    }

    /* The rims of all sprays, and lines to them from their nozzles. */
    function uploadLines(design) {
        const points = [];
        design.nozzles.forEach((nozzle) => nozzle.sprays.forEach(({from, rim}) => {
            for (let i = 0; i < rim.length; i++) {
                points.push(...rim[i], ...rim[(i + 1) % rim.length]);
                if (i % 4 === 0)
                    points.push(...from, ...rim[i]);
            }
        }));
        design.linePoints = points.length / 3;
        design.lines = gl.createVertexArray();
        gl.bindVertexArray(design.lines);
        gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
        gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(points), gl.STATIC_DRAW);
        const slot = gl.getAttribLocation(lineProgram.made, "place");
        gl.enableVertexAttribArray(slot);
        gl.vertexAttribPointer(slot, 3, gl.FLOAT, false, 0, 0);
    }

    function uploadColours(design) {
        const colours = coloursOf(design);
        design.colours = design.colours || gl.createTexture();
        gl.bindTexture(gl.TEXTURE_2D, design.colours);
        gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, WIDE, colours.length / 4 / WIDE, 0, gl.RGBA, gl.UNSIGNED_BYTE,
                      colours);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    }

    function drawSurface(design, matrix, view) {
        const model = design.model;
        gl.useProgram(surfaceProgram.made);
        gl.uniformMatrix4fv(surfaceProgram.view, false, matrix);
        gl.uniform3fv(surfaceProgram.low, model.low);
        gl.uniform3fv(surfaceProgram.extent, add(model.high, model.low, -1));
        gl.uniform1f(surfaceProgram.edge, model.edge);
        gl.uniform1i(surfaceProgram.tiles, model.tiles);
        gl.uniform4fv(surfaceProgram.cut, cutPlane());
        gl.uniform3fv(surfaceProgram.eye, view.eye);
        gl.uniform1i(surfaceProgram.patches, 0);
        gl.uniform1i(surfaceProgram.colours, 1);
        gl.activeTexture(gl.TEXTURE1);
        gl.bindTexture(gl.TEXTURE_2D, design.colours);
        gl.activeTexture(gl.TEXTURE0);
        gl.bindTexture(gl.TEXTURE_2D_ARRAY, model.texture);
        gl.bindVertexArray(model.buffer);
        (model.twoSided ? gl.disable : gl.enable).call(gl, gl.CULL_FACE);
        for (const draw of visibleDraws(model)) {
            gl.uniform1i(surfaceProgram.page, draw.page < 0 ? -1 : draw.layer * model.pages + draw.page);
            gl.drawElements(gl.TRIANGLES, 3 * draw.count, gl.UNSIGNED_INT, 12 * draw.first);
        }
    }

    const partKey = (model, part) => model.parts[part].name;
    const visibleDraws = (model) => model.draws.filter((draw) => !state.hidden.has(partKey(model, draw.part)));

    function drawLines(design, matrix) {
        gl.useProgram(lineProgram.made);
        gl.uniformMatrix4fv(lineProgram.view, false, matrix);
        gl.uniform3f(lineProgram.tint, 0.06, 0.13, 0.17);
        gl.bindVertexArray(design.lines);
        gl.drawArrays(gl.LINES, 0, design.linePoints);
    }

    const GAP = 8;
    /* Where a design's picture lies on the canvas, in CSS pixels from its top left. */
    function place(i) {
        const width = (canvas.clientWidth - GAP * (state.shown.length - 1)) / state.shown.length;
        return {left: i * (width + GAP), width, height: canvas.clientHeight};
    }

    function draw() {
        const ratio = Math.min(window.devicePixelRatio || 1, 2);
        canvas.width = Math.max(1, Math.round(canvas.clientWidth * ratio));
        canvas.height = Math.max(1, Math.round(canvas.clientHeight * ratio));
        gl.enable(gl.DEPTH_TEST);
        gl.clearColor(1, 1, 1, 1);
        gl.disable(gl.SCISSOR_TEST);
        gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
        gl.enable(gl.SCISSOR_TEST);
        const view = frame();
        state.shown.forEach((design, i) => {
            const {left, width, height} = place(i);
            const box = [left * ratio, 0, width * ratio, height * ratio].map(Math.round);
            gl.viewport(...box);
            gl.scissor(...box);
            design.matrix = projection(view, width / height);
            drawSurface(design, design.matrix, view);
            drawLines(design, design.matrix);
        });
        moveLabels();
    }
    let drawing = false;
    function redraw() {
        if (!drawing)
            requestAnimationFrame(() => ((drawing = false), draw()));
        drawing = true;
    }
    function recolour() {
        state.shown.forEach(uploadColours);
        drawBar();
        redraw();
    }

    /* ---- asking a point ---- */

    /* Where a ray meets the surface that is drawn: Möller and Trumbore, J. Graphics Tools 2(1), 1997. */
    function nearest(model, eye, ray) {
        const {places} = model.vertex, plane = cutPlane();
        let found = null, reach = Infinity;
        for (const drawn of visibleDraws(model))
            for (let t = drawn.first; t < drawn.first + drawn.count; t++) {
                const [a, b, c] = [0, 1, 2].map((k) => 3 * model.corners[3 * t + k]);
                const from = [places[a], places[a + 1], places[a + 2]];
                const e = [places[b] - from[0], places[b + 1] - from[1], places[b + 2] - from[2]];
                const f = [places[c] - from[0], places[c + 1] - from[1], places[c + 2] - from[2]];
                const p = cross(ray, f), det = dot(e, p);
                if (model.twoSided ? det === 0 : det <= 0)
                    continue;
                const to = add(eye, from, -1), u = dot(to, p) / det, q = cross(to, e), v = dot(ray, q) / det;
                const far = dot(f, q) / det;
                if (u < 0 || v < 0 || u + v > 1 || far <= 0 || far >= reach ||
                    dot(plane, add(eye, ray, far)) > plane[3])
                    continue;
                reach = far;
                found = {drawn, u, v, corners: [a / 3, b / 3, c / 3], at: add(eye, ray, far)};
            }
        return found;
    }

    /* The patch there, -1 for none. */
    function patchAt(model, {drawn, u, v, corners}) {
        if (drawn.page < 0)
            return -1;
        const spot = [model.vertex.u, model.vertex.v].map((along) => Math.min(model.edge - 1, Math.floor(model.edge *
            ((1 - u - v) * along[corners[0]] + u * along[corners[1]] + v * along[corners[2]]) / 65535)));
        return model.page[drawn.layer][(drawn.page * model.edge + spot[1]) * model.edge + spot[0]] - 1;
    }

    function figure(quantity, byte) {
        if (byte === 0)
            return "none";
        const value = valueOf(quantity, byte);
        const beyond = byte === 1 && quantity.log ? "at most " : byte === 255 ? "at least " : "";
        return `${beyond}${Number(value.toPrecision(3))} ${quantity.unit}`;
    }

    function figuresAt(design, patch) {
        const rows = about.quantities.map((quantity) =>
            [quantity.name, figure(quantity, design.values[quantity.key][patch])]);
        const known = design.nozzles.filter((nozzle) => nozzle.known);
        const bringing = known.filter((nozzle) => nozzle.flux[patch] > 0)
            .map((nozzle) => `${nozzle.name} ${figure(flux, nozzle.flux[patch])}`);
        rows.push(["Covered", `${Math.round(design.share[patch] / 2.55)} %${design.film[patch] ? ", by film" : ""}`]);
        if (known.length === design.nozzles.length)
            rows.push(["From", bringing.join(", ") || "no nozzle"]);
        return rows;
    }

    function element(tag, attributes, ...children) {
        const made = document.createElement(tag);
        Object.entries(attributes).forEach(([key, value]) =>
            (key in made && typeof value !== "string" ? (made[key] = value) : made.setAttribute(key, value)));
        made.append(...children);
        return made;
    }

    function tell(title, model, patch) {
        answer.replaceChildren(element("p", {}, title));
        if (patch < 0)
            return;
        const asked = designs.filter((design) => design.model === model);
        const columns = asked.map((design) => figuresAt(design, patch));
        const table = element("table", {class: "numbers small"},
            element("thead", {}, element("tr", {}, element("th", {scope: "col"}, "Here"),
                ...asked.map((design) => element("th", {scope: "col"}, design.name)))),
            element("tbody", {}, ...columns[0].map(([name], i) => element("tr", {}, element("th", {scope: "row"}, name),
                ...columns.map((rows) => element("td", {}, rows[i][1]))))));
        answer.append(element("div", {class: "wide"}, table));
    }

    /* x, y in CSS pixels from the canvas's top left. */
    function ask(x, y) {
        const i = state.shown.findIndex((_, k) => x >= place(k).left && x <= place(k).left + place(k).width);
        if (i < 0)
            return;
        const model = state.shown[i].model, {left, width, height} = place(i), view = frame();
        const wide = REACH * Math.max(width / height, 1), tall = (wide * height) / width;
        const ray = unit(add(add(scaled(view.back, -1), view.across, ((2 * (x - left)) / width - 1) * wide), view.above,
                             (1 - (2 * y) / height) * tall));
        const hit = nearest(model, view.eye, ray);
        if (!hit) {
            tell("Nothing there.", model, -1);
            return;
        }
        const patch = patchAt(model, hit), part = model.parts[hit.drawn.part];
        const where = hit.at.map((value, k) => (value + model.origin[k]).toFixed(3)).join(", ");
        tell(`${part.name} at ${where} m${patch < 0 ? ": no cleaning asked there" : ""}`, model, patch);
        answer.dataset.patch = patch;
    }

    /* ---- the controls ---- */

    const canvas = gl.canvas;
    const labels = element("div", {class: "labels"});
    const stage = element("div", {class: "stage"}, canvas, labels);
    const answer = element("div", {class: "answer", role: "status", "aria-live": "polite"});
    const bar = element("div", {class: "scale"});
    const controls = element("div", {class: "controls"});

    function moveLabels() {
        labels.replaceChildren(...state.shown.flatMap((design, i) => {
            const {left, width, height} = place(i);
            const title = element("span", {class: "title"}, `${design.name}: ${design.quote}`);
            title.style.left = `${left}px`;
            title.style.maxWidth = `${width - 16}px`;
            return [title, ...design.nozzles.map((nozzle, index) => {
                const [x, y, , w] = [0, 1, 2, 3].map((row) =>
                    dot([design.matrix[row], design.matrix[4 + row], design.matrix[8 + row]], nozzle.at) +
                    design.matrix[12 + row]);
                const chosen = state.nozzle && state.nozzle.design === design && state.nozzle.index === index;
                const label = element("span", {class: chosen ? "nozzle-dot chosen" : "nozzle-dot"}, nozzle.name);
                label.addEventListener("click", () => chooseNozzle(design, index));
                label.hidden = w <= 0 || Math.abs(x) > w || Math.abs(y) > w;
                label.style.left = `${left + ((1 + x / w) * width) / 2}px`;
                label.style.top = `${((1 - y / w) * height) / 2}px`;
                return label;
            })];
        }));
    }

    function chooseNozzle(design, index) {
        if (!design.nozzles[index].known)
            return tell(`What ${design.nozzles[index].name} does alone was not worked out.`, null, -1);
        const same = state.nozzle && state.nozzle.design === design && state.nozzle.index === index;
        state.nozzle = same ? null : {design, index};
        show(design);
        const name = design.nozzles[index].name;
        tell(same ? "All nozzles." : `${design.name}: what ${name} does alone, as liquid flux.`, null, -1);
    }

    function chooseShadow(design, index) {
        const {at, towards, extent} = design.shadows[index];
        const level = add(towards, up, -dot(towards, up));
        state.shadow = {design, index};
        state.camera = {
            target: at.slice(),
            azimuth: Math.hypot(...level) > 1e-6 ? Math.atan2(dot(level, right), dot(level, front)) : 0,
            elevation: Math.min(Math.max(Math.asin(Math.min(1, Math.max(-1, dot(towards, up)))), -1.45), 1.45),
            distance: Math.max(0.9 * extent, 0.06 * size) / REACH,
        };
        show(design);
        tell(`${design.name}: uncovered region ${index + 1}, marked in yellow.`, null, -1);
    }

    function show(design) {
        if (!state.shown.includes(design))
            state.shown = designs.filter((other) => state.shown.includes(other) || other === design);
        switches.forEach(([box, shown]) => (box.checked = state.shown.includes(shown)));
        recolour();
        stage.scrollIntoView({block: "nearest"});
    }

    function option(text, chosen) {
        return element("option", {value: text, selected: Boolean(chosen)}, text);
    }
    function choice(name, texts, chosen, act) {
        const list = element("select", {}, ...texts.map((text, i) => option(text, i === chosen)));
        list.addEventListener("change", () => act(list.selectedIndex));
        controls.append(element("label", {}, `${name} `, list));
        return list;
    }
    function button(name, act) {
        const made = element("button", {type: "button"}, name);
        made.addEventListener("click", act);
        return made;
    }
    function checkbox(name, checked, act) {
        const box = element("input", {type: "checkbox", checked});
        box.addEventListener("change", () => act(box));
        return [box, element("label", {}, box, ` ${name}`)];
    }

    const switches = [];
    const switchboard = element("span", {class: "switches"});
    function addSwitch(design) {
        const [box, label] = checkbox(design.name, state.shown.includes(design), (changed) => {
            const shown = designs.filter((other) =>
                (other === design ? changed.checked : state.shown.includes(other)));
            if (shown.length)
                state.shown = shown;
            changed.checked = state.shown.includes(design);
            recolour();
        });
        switches.push([box, design]);
        switchboard.append(label);
    }
    function addDesigns() {
        designs.forEach(addSwitch);
        controls.append(switchboard);
    }

    const scales = ["log", "linear", "stepped"];
    let scaleList;
    function addQuantities() {
        const quantities = [...about.quantities, coverage, ...(designs.length > 1 ? [difference] : [])];
        choice("Show", quantities.map((quantity) => quantity.name), quantities.indexOf(flux), (i) => {
            state.quantity = quantities[i];
            state.nozzle = null;
            recolour();
        });
        scaleList = choice("Scale", ["logarithmic", "linear", "stepped at the criterion"], 0, (i) => {
            state.scales[coloured().key] = scales[i];
            recolour();
        });
    }

    function addCut() {
        choice("Cut", ["nowhere", "across x", "across y", "across z"], state.cut.axis + 1, (i) => {
            state.cut.axis = i - 1;
            redraw();
        });
        const slider = element("input", {type: "range", min: "-1", max: "1", step: "0.01", value: "0",
                                         "aria-label": "Place of the cut"});
        slider.addEventListener("input", () => {
            state.cut.place = Number(slider.value);
            redraw();
        });
        controls.append(slider, button("Other side", () => {
            state.cut.turned = !state.cut.turned;
            redraw();
        }));
    }

    const views = {Fit: [0.5, 0.35], Front: [0, 0], Side: [Math.PI / 2, 0], Top: [0, 1.45], Below: [0.5, -0.5]};
    function addViews() {
        controls.append(...Object.entries(views).map(([name, angles]) => button(name, () => {
            fit(...angles);
            redraw();
        })));
    }

    function addParts() {
        const names = [...new Set(about.models.flatMap((model) =>
            model.draws.map((drawn) => partKey(model, drawn.part))))];
        if (names.length < 2)
            return;
        const boxes = names.map((name) => checkbox(name, true, (box) => {
            state.hidden[box.checked ? "delete" : "add"](name);
            redraw();
        }));
        const all = (shown) => button(shown ? "All" : "None", () => {
            boxes.forEach(([box]) => (box.checked = shown));
            state.hidden = new Set(shown ? [] : names);
            redraw();
        });
        controls.append(element("details", {}, element("summary", {}, "Parts"), all(true), all(false),
                                element("div", {class: "parts"}, ...boxes.map(([, label]) => label))));
    }

    /* Rows of the page's tables become buttons. */
    function bindRows(id, act) {
        designs.forEach((design) =>
            document.querySelectorAll(`#${id} table[data-design="${design.index}"] tbody tr`).forEach((row, index) => {
                const head = row.querySelector("th");
                const made = button("", () => act(design, index));
                made.className = "row";
                made.append(...head.childNodes);
                head.append(made);
            }));
    }

    function ticksOf(quantity) {
        const [from, to] = quantity.shown;
        if (state.scales[quantity.key] === "log" && from > 0)
            return [...Array(25).keys()].flatMap((power) => [1, 2, 5].map((step) => step * 10 ** (power - 12)))
                .filter((value) => value >= from * (1 - 1e-9) && value <= to * (1 + 1e-9));
        return [0, 0.25, 0.5, 0.75, 1].map((t) => from + t * (to - from));
    }

    function swatch(style, text) {
        const made = element("span", {class: "swatch-box"});
        made.style.background = style;
        return element("span", {class: "entry"}, made, ` ${text}`);
    }
    const HATCH = "repeating-linear-gradient(45deg,#c42636 0 2px,#faf8f5 2px 7px)";
    function drawBar() {
        const quantity = coloured();
        scaleList.disabled = !(quantity.key in state.scales);
        scaleList.selectedIndex = scales.indexOf(state.scales[quantity.key]);
        const keys = [swatch(HATCH, "not covered")];
        if (quantity === difference)
            keys.push(swatch("rgb(0,140,120)", "gained"), swatch("rgb(224,120,20)", "lost"),
                      swatch("rgb(205,212,220)", "covered by both"));
        else if (quantity === coverage)
            keys.push(swatch("rgb(70,130,180)", "covered"));
        else
            keys.unshift(ramp(quantity));
        if (quantity === difference)
            keys.unshift(element("span", {class: "entry"}, `against ${base().name}`));
        bar.replaceChildren(...keys, swatch(`rgb(${about.grey})`, "no cleaning asked"));
    }
    function ramp(quantity) {
        const stops = [...Array(33).keys()].map((i) => 3 * Math.round((i * 255) / 32))
            .map((at) => `rgb(${palette.subarray(at, at + 3)})`);
        const strip = element("span", {class: "ramp"}), stepped = state.scales[quantity.key] === "stepped";
        strip.style.background = stepped
            ? `linear-gradient(90deg,${stops[5]} 50%,${stops[27]} 50%)` : `linear-gradient(90deg,${stops})`;
        const ticks = stepped ? [quantity.step || quantity.shown[0]] : ticksOf(quantity);
        strip.append(...ticks.map((value) => {
            const tick = element("i", {}, String(Number(value.toPrecision(3))));
            tick.style.left = `${100 * (stepped ? 0.5 : shade(quantity, value))}%`;
            return tick;
        }));
        return element("span", {class: "entry"}, `${quantity.name}, ${quantity.unit} `, strip);
    }

    /* ---- turning and walking ---- */

    const turn = (x, y) => {
        state.camera.azimuth += x;
        state.camera.elevation = Math.min(Math.max(state.camera.elevation + y, -1.5), 1.5);
        redraw();
    };
    const shift = (x, y) => {
        const view = frame(), step = 2 * REACH * state.camera.distance;
        state.camera.target = add(add(state.camera.target, view.across, -x * step), view.above, y * step);
        redraw();
    };
    const zoom = (factor) => {
        state.camera.distance = Math.min(Math.max(state.camera.distance * factor, 0.02 * size), 20 * size);
        redraw();
    };

    function bindPointer() {
        const held = new Map();
        let moved = 0;
        canvas.addEventListener("pointerdown", (event) => {
            canvas.setPointerCapture(event.pointerId);
            held.set(event.pointerId, event);
            moved = 0;
        });
        canvas.addEventListener("pointermove", (event) => {
            const before = held.get(event.pointerId);
            if (!before)
                return;
            const x = event.clientX - before.clientX, y = event.clientY - before.clientY;
            moved += Math.hypot(x, y);
            const other = [...held.values()].find((finger) => finger.pointerId !== event.pointerId);
            const apart = (finger) => Math.hypot(finger.clientX - other.clientX, finger.clientY - other.clientY) || 1;
            if (other)
                zoom(apart(before) / apart(event));
            else if (event.buttons & 6 || event.shiftKey)
                shift(x / canvas.clientHeight, y / canvas.clientHeight);
            else
                turn(-x / 150, y / 150);
            held.set(event.pointerId, event);
        });
        canvas.addEventListener("pointerup", (event) => {
            held.delete(event.pointerId);
            const box = canvas.getBoundingClientRect();
            if (moved < 4)
                ask(event.clientX - box.left, event.clientY - box.top);
        });
        canvas.addEventListener("pointercancel", (event) => held.delete(event.pointerId));
        canvas.addEventListener("contextmenu", (event) => event.preventDefault());
        /* the page scrolls as ever until the canvas is asked for */
        canvas.addEventListener("wheel", (event) => {
            if (document.activeElement !== canvas)
                return;
            event.preventDefault();
            zoom(Math.exp(event.deltaY / 600));
        }, {passive: false});
    }

    function bindKeys() {
        const steps = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]};
        const acts = {"+": () => zoom(0.85), "=": () => zoom(0.85), "-": () => zoom(1 / 0.85),
                      f: () => fit(...views.Fit), 1: () => fit(...views.Front), 2: () => fit(...views.Side),
                      3: () => fit(...views.Top)};
        canvas.addEventListener("keydown", (event) => {
            const step = steps[event.key];
            if (step)
                event.shiftKey ? shift(-step[0] / 20, step[1] / 20) : turn(step[0] / 12, step[1] / 12);
            else if (event.key === "Enter" || event.key === " ")
                ask(place(0).width / 2, place(0).height / 2);
            else if (acts[event.key] && !event.ctrlKey && !event.metaKey)
                acts[event.key]();
            else
                return;
            event.preventDefault();
            redraw();
        });
    }

    /* ---- all together ---- */

    canvas.tabIndex = 0;
    canvas.setAttribute("role", "application");
    canvas.setAttribute("aria-label", "The surface in colours, designs side by side. Arrow keys turn, with shift they " +
        "move, plus and minus zoom, f fits, 1, 2 and 3 look from front, side and top, Enter asks the point in the middle " +
        "of the first design.");
    addDesigns();
    addQuantities();
    addViews();
    addCut();
    addParts();
    bindPointer();
    bindKeys();
    bindRows("nozzles", chooseNozzle);
    bindRows("contributions", chooseNozzle);
    bindRows("shadows", chooseShadow);
    section.append(controls, stage, bar, answer);
    section.hidden = false;
    fit(...views.Fit);
    about.models.forEach(uploadModel);
    designs.forEach(uploadLines);
    new ResizeObserver(draw).observe(stage);
    addEventListener("resize", draw); /* also where the page is zoomed: pixels are of another size then */
    recolour();
    tell("Drag to turn, with shift to move; click a point, a nozzle or a row of the tables below.", null, -1);
    section.dataset.ready = "true";

    /* For live.js: a design more, that changes. */
    function addDesign(design) {
        designs.push(design);
        uploadLines(design);
        addSwitch(design);
    }
    return {about, designs, section, inflated, element, button, option, addDesign, show, recolour, uploadLines, state,
            size, up, box: {low, high}};
})();
