/* A slider and a number for each of what can be set of the nozzle in hand. */
function makeSliders(live) {
    "use strict";
    const {view, editing, origin, sliders, typeOf, flowAt, flowOf, adjustable, fitType, change, LITRES} = live;
    const {add, dot, scaled, tiltOf, limited} = geometry, {datum} = editing, {element} = widgets;
    const [DEGREE, BAR] = [Math.PI / 180, 1e5];

    /* Without what units round off: 30 deg that read 29.999999999999996 would leave out the last step. */
    const told = (value) => String(Number(value.toPrecision(12)));
    function slider(name, low, high, step, get, set) {
        const range = element("input", {type: "range", min: told(low), max: told(high), step: String(step)});
        const exact = element("input", {type: "number", min: told(low), max: told(high), step: "any",
                                        "aria-label": `${name}, as a number`});
        const act = (from) => () => {
            if (from.value === "" || !Number.isFinite(Number(from.value)))
                return sync(true);
            change(from === range && name, (nozzle) => set(nozzle, limited(Number(from.value), low, high)));
        };
        const sync = (all) => [range, exact].forEach((input) => {
            if (all || input !== document.activeElement || input === range)
                input.value = String(Number(get(live.nozzles[live.chosen]).toPrecision(7)));
        });
        range.addEventListener("input", act(range));
        exact.addEventListener("change", act(exact));
        live.syncs.push(sync);
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
    /* In deg, from 0 on. */
    const turnOf = (angle) => (angle < 0 ? angle + 2 * Math.PI : angle) / DEGREE;
    /* Which way the nozzle points as the sheet has it (sp_fitting_row). */
    function tellPose() {
        const line = element("p", {class: "pose"}), sync = () => {
            const {tilt, azimuth} = tiltOf(scaled(datum.axis, -1), live.nozzles[live.chosen].axis, datum);
            const told = (tilt / DEGREE).toFixed(1), towards = turnOf(azimuth).toFixed(1);
            line.textContent = `On the sheet: tilt ${told}°, towards ${towards === "360.0" || told === "0.0" ||
                told === "180.0" ? "0.0" : towards}°.`;
        };
        live.syncs.push(sync);
        sync();
        sliders.append(line);
    }
    /* Of a mount that points straight down, against the datum's axis, sliders count as the sheet does. Of any other
     * they count from the mount, and a line beside them says what the sheet has. */
    function poseSliders(nozzle, mount) {
        const wall = mount.kind === "surface", plumb = !wall && dot(mount.axis, datum.axis) < 1e-9 - 1;
        const from = wall ? "the wall's normal" : "the mount's axis";
        const [tilt, towards] = plumb ? ["Tilt, deg", "Towards, deg"]
            : [`Tilt from ${from}, deg`, `Round ${from}, deg`];
        if (mount.tilt > 0) {
            slider(tilt, 0, mount.tilt / DEGREE, 0.5, (own) => own.tilt / DEGREE,
                   (own, value) => (own.tilt = value * DEGREE));
            slider(towards, 0, 360, 1, (own) => turnOf(own.azimuth),
                   (own, value) => (own.azimuth = value * DEGREE));
        }
        slider("Roll, deg", -180, 180, 1, (own) => Math.atan2(Math.sin(own.roll), Math.cos(own.roll)) / DEGREE,
               (own, value) => (own.roll = value * DEGREE));
        if (!plumb)
            tellPose();
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
    return {positionSliders, poseSliders, typeSliders};
}
