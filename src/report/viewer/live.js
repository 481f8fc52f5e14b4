/* A layout of the reader's own: nozzles are moved within their mounts, turned, exchanged, switched off and added, and a
 * worker (worker.js) evaluates what comes of it. What may be changed is written by live.c. */
(async () => {
    "use strict";
    const view = await viewer, source = document.getElementById("live-model");
    if (!view || !source || !window.WebAssembly || !window.Worker)
        return;
    const {about, element, button} = view;
    const editing = JSON.parse(source.textContent), {types, mounts} = editing;
    const {add, dot, cross, scaled, unit, limited, tiltOf, leaning, lies} = geometry;
    const model = about.models.find((other) => other.surface);
    const [DEGREE, LITRES, BAR, QUICK, IDLE] = [Math.PI / 180, 6e4, 1e5, 100, 150]; /* QUICK and IDLE in ms */
    const MOST_STRIDE = 8;

    const origin = editing.settings.slice(13, 16), density = editing.settings[0];
    /* A place as it is when it was written and read again. */
    const told = (place) => place.map((x, k) => x + origin[k] - origin[k]);

    /* ---- the worker ---- */

    async function startWorker() {
        const script = new Blob([document.getElementById("live-worker").textContent], {type: "text/javascript"});
        const address = URL.createObjectURL(script), worker = new Worker(address), waiting = new Map();
        let number = 0;
        worker.addEventListener("message", ({data: {id, answer, error}}) => {
            const {done, failed} = waiting.get(id);
            waiting.delete(id);
            error === undefined ? done(answer) : failed(new Error(error));
        });
        worker.addEventListener("error", (event) => {
            event.preventDefault();
            waiting.forEach(({failed}) => failed(new Error(event.message || "no worker")));
            waiting.clear();
        });
        return (act, more) => new Promise((done, failed) => {
            waiting.set(++number, {done, failed});
            worker.postMessage({id: number, act, ...more});
        });
    }

    async function open() {
        const ask = await startWorker(), {surface} = model;
        const zero = String.fromCharCode(0);
        const arrays = {...surface, settings: Float64Array.from(editing.settings),
            clean: Uint8Array.from(editing.parts, (part) => part.clean),
            names: new TextEncoder().encode(editing.parts.map((part) => part.name + zero).join("")),
            types: Float64Array.from(types.flatMap((type) => type.numbers)),
            members: Float64Array.from(editing.members.flat())};
        const module = await view.inflated(document.getElementById("live-module").textContent);
        await ask("open", {module, arrays, shown: about.quantities});
        return ask;
    }

    /* ---- the layout ---- */

    const downwards = scaled(view.up, -1), near = 1e-5 * view.size;
    const free = {kind: "free", tilt: Math.PI, axis: downwards, types: []};
    const mountOf = (nozzle) => mounts[nozzle.mount] || free;
    const typeOf = (nozzle) => types[nozzle.type].numbers;
    const named = types.filter((type) => type.name).length;
    const partsOf = (mount) => (mount.part >= 0 ? [mount.part]
        : editing.parts.flatMap((part, i) => (part.geometry === mount.geometry ? [i] : [])));

    function nozzleOf({name, numbers, keep, jets}) {
        const [type, x, y, z, ax, ay, az, roll, pressure, angle, flow, speed] = numbers;
        return {name, type, place: [x, y, z], axis: [ax, ay, az], roll, pressure, angle, flow, speed, on: true, keep,
                jets, mount: -1, reference: downwards};
    }
    const numbersOf = (nozzle) => [nozzle.type, ...nozzle.place, ...nozzle.axis, nozzle.roll, nozzle.pressure,
                                   nozzle.angle, nozzle.flow, nozzle.speed, nozzle.on ? 1 : 0];

    /* The mount that a nozzle is on, none where it is on none; and what its tilt is counted from. */
    async function findMount(nozzle, ask) {
        nozzle.mount = mounts.findIndex((mount) => lies(mount, nozzle.place, near) &&
            tiltOf(mount.axis, nozzle.axis).tilt <= mount.tilt + 1e-6);
        for (let i = 0; i < mounts.length && nozzle.mount < 0; i++) {
            if (mounts[i].kind !== "surface")
                continue;
            const {far, normal} = await ask("foot", {parts: partsOf(mounts[i]), point: nozzle.place});
            if (!normal || Math.abs(far - mounts[i].standoff) > 10 * near ||
                tiltOf(normal, nozzle.axis).tilt > mounts[i].tilt + 1e-3)
                continue;
            nozzle.mount = i;
            nozzle.reference = normal;
        }
        if (mountOf(nozzle).kind !== "surface")
            nozzle.reference = mountOf(nozzle).axis;
        Object.assign(nozzle, tiltOf(nozzle.reference, nozzle.axis));
    }

    /* Onto its mount, from wherever its place is. */
    async function settle(nozzle, ask) {
        const mount = mountOf(nozzle);
        if (mount.kind === "surface") {
            const {place, normal} = await ask("foot", {parts: partsOf(mount), point: nozzle.place});
            nozzle.place = add(place, normal, mount.standoff);
            nozzle.reference = normal;
        } else {
            nozzle.reference = mount.axis;
        }
        nozzle.place = told(nozzle.place);
        nozzle.tilt = Math.min(nozzle.tilt, mount.tilt);
        nozzle.axis = leaning(nozzle.reference, nozzle.tilt, nozzle.azimuth);
    }

    /* ---- what it looks like ---- */

    /* The rim of a spray, as long as the geometry lets it look well. */
    function rimOf(nozzle) {
        const [pattern, angle, , thickness] = typeOf(nozzle), half = Math.min((nozzle.angle || angle || 2) / 2, 3);
        const worldX = editing.settings[1] ? [0, 0, 1] : [0, 1, 0], axis = nozzle.axis;
        const level = cross(view.up, axis), x0 = unit(Math.hypot(...level) > 1e-6 ? level : cross(worldX, axis));
        const y0 = cross(axis, x0), [c, s] = [Math.cos(nozzle.roll), Math.sin(nozzle.roll)];
        const x = add(scaled(x0, c), y0, s), y = add(scaled(y0, c), x0, -s), length = 0.15 * view.size;
        return Array.from({length: 32}, (_, k) => {
            const turn = (2 * Math.PI * k) / 32, wide = half * Math.cos(turn), tall = thickness / 2 * Math.sin(turn);
            const way = pattern === 2
                ? [Math.cos(tall) * Math.cos(wide), Math.cos(tall) * Math.sin(wide), Math.sin(tall)]
                : [Math.cos(half), Math.sin(half) * Math.cos(turn), Math.sin(half) * Math.sin(turn)];
            return add(nozzle.place, add(add(scaled(axis, way[0]), x, way[1]), y, way[2]), length);
        });
    }

    const empty = new Uint8Array(model.patches);
    const design = {index: about.models.length + 1e6, name: "Yours", quote: "", manual: false, first: false, model,
                    values: Object.fromEntries(about.quantities.map(({key}) => [key, empty])), share: empty,
                    film: empty, shadowOf: empty, shadows: [], nozzles: []};
    let nozzles = [], chosen = 0, start = null, last = null;

    function drawNozzles() {
        design.nozzles = nozzles.map((nozzle, i) => ({name: nozzle.name, known: true, at: nozzle.place,
            flux: (design.nozzles[i] || {}).flux || empty,
            sprays: nozzle.on ? [{from: nozzle.place, rim: rimOf(nozzle)}] : []}));
        view.uploadLines(design);
    }

    const short = (value, digits = 4) => String(Number(value.toPrecision(digits)));
    const percent = (share) => `${(100 * share).toFixed(2)} %`;
    const litres = (flow) => `${(LITRES * flow).toFixed(1)} L/min`;

    const section = element("section", {id: "live"}), figures = element("div", {class: "wide"});
    const answer = element("div", {class: "answer", role: "status", "aria-live": "polite"});
    const holder = element("div", {class: "controls"}), sliders = element("div", {class: "sliders"});
    const scene = element("textarea", {readonly: "", rows: "12", spellcheck: "false",
                                         "aria-label": "The layout as a scene"});

    function tellFigures() {
        const [area] = [start, last].filter((one) => one && one.coverage > 0)
            .map((one) => one.covered / one.coverage);
        const row = (name, of) => element("tr", {}, element("th", {scope: "row"}, name),
            ...[start, last].map((one) => element("td", {}, one ? of(one) : "")));
        figures.replaceChildren(element("table", {class: "numbers narrow"},
            element("thead", {}, element("tr", {}, ...["", start.name, "Yours"].map((name) =>
                element("th", {scope: "col"}, name)))),
            element("tbody", {}, row("Coverage", (one) => percent(one.coverage)),
                row("Water", (one) => litres(one.flow)), row("Area per water, m² per L/min", (one) =>
                    (one.flow > 0 ? short(one.covered / one.flow / LITRES) : "none")),
                row("Not covered, m²", (one) => (area ? short(area - one.covered, 3) : "all")))));
    }

    function tell(stride, finished) {
        const texel = 1e3 * editing.settings[8];
        const how = stride > 1
            ? ` counted on one texel of ${stride * stride} (every ${short(stride * texel, 3)} mm); ` +
                "the figure on all of them follows" : ` on texels of ${short(texel, 3)} mm`;
        const words = [`Coverage ${percent(last.coverage)} with ${litres(last.flow)},${how}.`];
        if (finished) {
            const [largest] = finished.shadows;
            if (largest)
                words.push(`Largest region that is not covered: ${short(largest.area, 3)} m² on ` +
                    `${editing.parts[largest.part].name}, ${editing.lacks[largest.lack]}.`);
            finished.stands.forEach((wrong, i) => wrong && nozzles[i].on &&
                words.push(`This layout cannot be built: ${wrong.replace("nozzles: ", nozzles[i].name)}.`));
        }
        const ports = nozzles.filter((nozzle) => nozzle.on && mountOf(nozzle).kind === "port")
            .map((nozzle) => nozzle.mount);
        const twice = ports.find((port, i) => ports.indexOf(port) < i);
        if (twice !== undefined)
            words.push(`Port ${mounts[twice].name} holds two nozzles.`);
        answer.replaceChildren(...words.map((line) => element("p", {}, line)));
    }

    /* ---- evaluating ---- */

    let ask, wanted = false, busy = false, stride = 1, idle = 0;
    function show({figures: found, values, share}) {
        last = found;
        about.quantities.forEach(({key}, k) => (design.values[key] = values[k]));
        design.share = share;
        design.quote = `${(100 * found.coverage).toFixed(1)} % with ${litres(found.flow)}`;
        section.dataset.coverage = found.coverage;
        tellFigures();
        view.recolour();
    }

    /* True where nothing is left to be done. */
    async function evaluate(exactly) {
        const rows = nozzles.map(numbersOf), used = exactly ? 1 : stride;
        const found = await ask("evaluate", {nozzles: rows, stride: used});
        show(found);
        section.dataset.ms = found.ms;
        section.dataset.traced = found.figures.traced;
        if (!exactly && found.ms > QUICK && stride < MOST_STRIDE)
            stride *= 2;
        else if (!exactly && found.figures.traced && found.ms < QUICK / 5 && stride > 1)
            stride /= 2;
        if (used > 1 || wanted) {
            tell(used);
            return false;
        }
        const finished = await ask("finish", {nozzles: rows});
        design.shadowOf = finished.shadowOf;
        design.shadows = finished.shadows.map(({at}) => ({at, towards: view.up, extent: 0.1 * view.size}));
        design.nozzles.forEach((nozzle, i) => (nozzle.flux = finished.alone[i] || empty));
        tell(1, finished);
        await ask("prepare", {chosen});
        section.dataset.settled = JSON.stringify(rows);
        if (view.state.nozzle && view.state.nozzle.design === design)
            view.recolour();
        return true;
    }

    /* One at a time; the latest wish counts. */
    async function run(exactly) {
        clearTimeout(idle);
        wanted = true;
        if (busy)
            return;
        busy = true;
        try {
            let done = true;
            while (wanted) {
                wanted = false;
                done = await evaluate(exactly);
            }
            if (!done)
                idle = setTimeout(() => run(true), IDLE);
        } catch (error) {
            answer.replaceChildren(element("p", {}, `Not evaluated: ${error.message}.`));
            delete section.dataset.settled;
        }
        busy = false;
    }

    /* ---- changes ---- */

    const history = [];
    let gesture = null, gestureAt = 0;
    function remember(name) {
        const now = Date.now();
        if (name !== gesture || now - gestureAt > 1500)
            history.push(JSON.stringify({nozzles, chosen}));
        [gesture, gestureAt] = [name, now];
        undoButton.disabled = false;
    }

    let moving = Promise.resolve();
    /* `name`: changes of one name, one soon after the other, are undone together. */
    function change(name, act, rebuild) {
        moving = moving.then(async () => {
            remember(name);
            const nozzle = nozzles[chosen];
            act(nozzle);
            await settle(nozzle, ask);
            refresh(rebuild);
        });
        return moving;
    }

    function refresh(rebuild) {
        drawNozzles();
        if (!design.shown) {
            design.shown = true;
            view.show(design);
        }
        rebuild ? build() : syncs.forEach((sync) => sync());
        scene.value = sceneText();
        delete section.dataset.settled;
        run(false);
    }

    function undo() {
        const before = history.pop();
        if (!before)
            return;
        ({nozzles, chosen} = JSON.parse(before));
        gesture = null;
        undoButton.disabled = !history.length;
        refresh(true);
    }

    /* As sp_type_flow. */
    function flowAt(numbers, rated, pressure) {
        return rated * (pressure / numbers[5]) ** numbers[6] * Math.sqrt(1000 / density);
    }
    const adjustable = (low, high) => low < high;
    function flowOf(nozzle) {
        return nozzle.flow || flowAt(typeOf(nozzle), typeOf(nozzle)[4], nozzle.pressure);
    }
    /* Angle and flow as the type takes them: none of one that is not adjustable. */
    function fitType(nozzle) {
        const n = typeOf(nozzle);
        nozzle.angle = adjustable(n[9], n[10]) && nozzle.angle ? limited(nozzle.angle, n[9], n[10]) : 0;
        nozzle.flow = adjustable(n[11], n[12]) && nozzle.flow
            ? limited(nozzle.flow, flowAt(n, n[11], nozzle.pressure), flowAt(n, n[12], nozzle.pressure)) : 0;
    }

    /* ---- the controls ---- */

    let syncs = [];
    function slider(name, low, high, step, get, set) {
        const range = element("input", {type: "range", min: String(low), max: String(high), step: String(step)});
        const exact = element("input", {type: "number", min: String(low), max: String(high), step: "any",
                                        "aria-label": `${name}, as a number`});
        const act = (from) => () => {
            if (from.value === "" || !Number.isFinite(Number(from.value)))
                return sync(true);
            change(name, (nozzle) => set(nozzle, limited(Number(from.value), low, high)));
        };
        const sync = (all) => [range, exact].forEach((input) => {
            if (all || input !== document.activeElement || input === range)
                input.value = String(Number(get(nozzles[chosen]).toPrecision(7)));
        });
        range.addEventListener("input", act(range));
        exact.addEventListener("change", act(exact));
        syncs.push(sync);
        sync(true);
        sliders.append(element("label", {}, element("span", {}, name), range), exact);
    }

    const axes = ["x", "y", "z"];
    function placeSliders(nozzle, mount) {
        const margin = mount.kind === "box" ? [mount.from, mount.to]
            : [view.box.low, view.box.high];
        axes.forEach((axis, k) => {
            if (margin[1][k] > margin[0][k])
                slider(`${axis}, m`, margin[0][k] + origin[k], margin[1][k] + origin[k], 0.001,
                       (own) => own.place[k] + origin[k], (own, value) =>
                           (own.place = own.place.map((x, i) => (i === k ? value - origin[k] : x))));
        });
    }
    function positionSliders(nozzle, mount) {
        if (mount.kind === "port") {
            if (mount.depth[1] > mount.depth[0])
                slider("Depth, mm", 1e3 * mount.depth[0], 1e3 * mount.depth[1], 1,
                       (own) => 1e3 * dot(add(own.place, mount.position, -1), mount.axis),
                       (own, value) => (own.place = add(mount.position, mount.axis, value / 1e3)));
        } else if (mount.kind === "line") {
            const way = add(mount.to, mount.from, -1), length = Math.hypot(...way);
            slider("Along the line, mm", 0, 1e3 * length, 1,
                   (own) => (1e3 * dot(add(own.place, mount.from, -1), way)) / (length || 1),
                   (own, value) => (own.place = add(mount.from, way, length ? value / 1e3 / length : 0)));
        } else {
            placeSliders(nozzle, mount);
        }
    }
    function poseSliders(nozzle, mount) {
        if (mount.tilt > 0) {
            slider("Tilt, deg", 0, mount.tilt / DEGREE, 0.5, (own) => own.tilt / DEGREE,
                   (own, value) => (own.tilt = value * DEGREE));
            slider("Towards, deg", -180, 180, 1, (own) => own.azimuth / DEGREE,
                   (own, value) => (own.azimuth = value * DEGREE));
        }
        slider("Roll, deg", -180, 180, 1, (own) => Math.atan2(Math.sin(own.roll), Math.cos(own.roll)) / DEGREE,
               (own, value) => (own.roll = value * DEGREE));
    }
    function typeSliders(nozzle) {
        const n = typeOf(nozzle), rated = (row) => flowAt(n, row, nozzle.pressure);
        slider("Pressure, bar", 0.2, Math.max(10, (2 * nozzle.pressure) / BAR), 0.05, (own) => own.pressure / BAR,
               (own, value) => {
            own.pressure = value * BAR;
            fitType(own);
        });
        if (adjustable(n[9], n[10]))
            slider("Angle, deg", n[9] / DEGREE, n[10] / DEGREE, 0.5, (own) => (own.angle || n[1]) / DEGREE,
                   (own, value) => (own.angle = limited(value * DEGREE, n[9], n[10])));
        if (adjustable(n[11], n[12]))
            slider("Flow, L/min", LITRES * rated(n[11]), LITRES * rated(n[12]), 0.1, (own) => LITRES * flowOf(own),
                   (own, value) => {
                own.flow = value / LITRES;
                fitType(own);
            });
    }

    function list(name, texts, at, act) {
        const made = element("select", {}, ...texts.map((text, i) => view.option(text, i === at)));
        made.addEventListener("change", () => act(made.selectedIndex));
        holder.append(element("label", {}, `${name} `, made));
    }
    const mountName = (mount) => mount.name ||
        (mount.part >= 0 && mount.kind === "surface" ? `surface of ${editing.parts[mount.part].name}` : mount.kind);

    async function mountAt(nozzle, index) {
        nozzle.mount = index;
        const mount = mountOf(nozzle);
        nozzle.place = mount.kind === "port" ? add(mount.position, mount.axis, mount.depth[0])
            : mount.kind === "line" || mount.kind === "box" ? scaled(add(mount.from, mount.to), 0.5) : nozzle.place;
        if (mount.types.length && !mount.types.includes(nozzle.type))
            nozzle.type = mount.types[0];
        fitType(nozzle);
    }

    function addNozzle(index) {
        moving = moving.then(async () => {
            remember("add");
            const like = nozzles[chosen], taken = new Set(nozzles.map((nozzle) => nozzle.name));
            let number = nozzles.length + 1;
            while (taken.has(`A${number}`))
                number++;
            const made = {...like, name: `A${number}`, on: true, keep: false, jets: 0, tilt: 0, azimuth: 0};
            mountAt(made, index);
            await settle(made, ask);
            nozzles = [...nozzles, made];
            chosen = nozzles.length - 1;
            refresh(true);
        });
    }

    const undoButton = button("Undo", undo);
    undoButton.disabled = true;
    function build() {
        const focused = document.activeElement && document.activeElement.dataset.key;
        const nozzle = nozzles[chosen], mount = mountOf(nozzle);
        holder.replaceChildren();
        sliders.replaceChildren();
        syncs = [];
        list("Nozzle", nozzles.map(({name, on}) => (on ? name : `${name}, off`)), chosen, (i) => {
            chosen = i;
            build();
            run(true);
        });
        const allowed = types.map((_, i) => i).filter((i) => i < named && (i === nozzle.type || !mount.types.length ||
            mount.types.includes(i)));
        list("Type", allowed.map((i) => types[i].name), allowed.indexOf(nozzle.type), (i) => change("type", (own) => {
            own.type = allowed[i];
            fitType(own);
        }, true));
        list("Mount", ["anywhere", ...mounts.map(mountName)], nozzle.mount + 1, (i) =>
            change("mount", (own) => mountAt(own, i - 1), true));
        const toggle = button(nozzle.on ? "Switch off" : "Switch on", () =>
            change("switch", (own) => (own.on = !own.on), true));
        const adds = element("select", {"aria-label": "Mount of a nozzle more"},
            ...["anywhere", ...mounts.map(mountName)].map((text, i) => view.option(text, i === 1)));
        const more = button("Add a nozzle at", () => addNozzle(adds.selectedIndex - 1));
        holder.append(toggle, element("span", {class: "adding"}, more, " ", adds), undoButton,
                      button("Save as scene", save));
        [...holder.querySelectorAll("select, button")].forEach((one, i) => (one.dataset.key = `key${i}`));
        if (focused)
            (holder.querySelector(`[data-key="${focused}"]`) || holder.querySelector("select")).focus();
        positionSliders(nozzle, mount);
        poseSliders(nozzle, mount);
        typeSliders(nozzle);
    }

    /* ---- the scene ---- */

    const quoted = (name) => JSON.stringify(name);
    function nozzleText(nozzle) {
        const place = nozzle.place.map((x, k) => `${x + origin[k]} m`).join(", ");
        const lines = [`name: ${quoted(nozzle.name)}`, `type: ${quoted(types[nozzle.type].name)}`,
                       `position: [${place}]`, `axis: [${nozzle.axis.join(", ")}]`, `roll: ${nozzle.roll} rad`,
                       `pressure: ${nozzle.pressure} Pa`];
        if (nozzle.angle)
            lines.push(`angle: ${nozzle.angle} rad`);
        if (nozzle.flow)
            lines.push(`flow: ${nozzle.flow} m3/s`);
        if (nozzle.speed)
            lines.push(`speed: ${nozzle.speed} m/s`);
        if (nozzle.jets)
            lines.push(`jets: ${nozzle.jets}`);
        if (nozzle.keep)
            lines.push("keep: true");
        return `  - ${lines.join("\n    ")}\n`;
    }
    function sceneText() {
        const block = /^nozzles:.*\n(?:[ -].*\n)*/m, on = nozzles.filter((nozzle) => nozzle.on);
        const text = on.length ? `nozzles:\n${on.map(nozzleText).join("")}` : "nozzles: []\n";
        return editing.scene.replace(block, () => text);
    }
    function save() {
        if (!nozzles.some((nozzle) => nozzle.on)) {
            answer.replaceChildren(element("p", {}, "No nozzle is switched on: there is no layout to save."));
            return;
        }
        const address = URL.createObjectURL(new Blob([sceneText()], {type: "text/yaml"}));
        element("a", {href: address, download: "changed.yaml"}).click();
        setTimeout(() => URL.revokeObjectURL(address), 1000);
        answer.replaceChildren(element("p", {}, "Saved as changed.yaml. Put it beside this page: its paths to " +
            "geometry and catalogue start there."));
    }

    /* ---- all together ---- */

    async function startFrom(from) {
        nozzles = from.nozzles.map(nozzleOf);
        for (const nozzle of nozzles)
            await findMount(nozzle, ask);
        chosen = 0;
        start = {name: view.designs.find((other) => other.index === from.index).name};
        const found = await ask("evaluate", {nozzles: nozzles.map(numbersOf), stride: 1});
        Object.assign(start, found.figures);
        return found;
    }

    view.section.append(section);
    section.append(element("h3", {}, "Try a change"), answer);
    answer.replaceChildren(element("p", {}, "Getting ready to evaluate layouts here…"));
    try {
        ask = await open();
        /* What the report says must come out to the last digits that matter, or nothing is said here. */
        for (const other of [...editing.designs].sort((a, b) => a.main - b.main)) {
            if (!other.nozzles.length)
                continue;
            const found = await startFrom(other);
            if (!(Math.abs(found.figures.coverage - other.coverage) <= 1e-9))
                throw new Error(`this browser finds ${percent(found.figures.coverage)} where the report has ` +
                    `${percent(other.coverage)}`);
            show(found);
        }
    } catch (error) {
        answer.replaceChildren(element("p", {}, `Layouts are shown here and not evaluated: ${error.message}.`));
        section.dataset.failed = error.message;
        return;
    }
    const choices = editing.designs.filter((other) => other.nozzles.length);
    const starts = element("select", {}, ...choices.map((other) =>
        view.option(view.designs.find(({index}) => index === other.index).name, other.main)));
    starts.addEventListener("change", () => {
        moving = moving.then(async () => {
            remember("start");
            await startFrom(choices[starts.selectedIndex]);
            refresh(true);
        });
    });
    drawNozzles();
    view.addDesign(design);
    build();
    scene.value = sceneText();
    section.append(element("div", {class: "controls"}, element("label", {}, "Start from ", starts)), holder, sliders,
                   figures, element("details", {}, element("summary", {}, "The layout as a scene"), scene));
    await run(true);
    section.dataset.ready = "true";
})();
