/* What the surface is told to be where it is asked. */
function makePick(view) {
    "use strict";
    const {about, state, designs, flux, answer, frame, cutPlane, place, REACH, visibleDraws, figure} = view;
    const {add, scaled, dot, cross, unit} = geometry, {element} = widgets;

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

    /* To a millimetre, without a sign where that is none. */
    const placeText = (value) => value.toFixed(3).replace(/^-(?=[0.]+$)/, "");

    /* The patch there, -1 for none. */
    function patchAt(model, {drawn, u, v, corners}) {
        if (drawn.page < 0)
            return -1;
        const spot = [model.vertex.u, model.vertex.v].map((along) => Math.min(model.edge - 1, Math.floor(model.edge *
            ((1 - u - v) * along[corners[0]] + u * along[corners[1]] + v * along[corners[2]]) / 65535)));
        return model.page[drawn.layer][(drawn.page * model.edge + spot[1]) * model.edge + spot[0]] - 1;
    }

    function figuresAt(design, patch) {
        const rows = about.quantities.map((quantity, k) =>
            [quantity.name, figure(quantity, design.values[quantity.key][patch], design.asked[k])]);
        const known = design.nozzles.filter((nozzle) => nozzle.known);
        const bringing = known.filter((nozzle) => nozzle.flux[patch] > 0)
            .map((nozzle) => `${nozzle.name} ${figure(flux, nozzle.flux[patch], design.asked[0])}`);
        rows.push(["Covered", `${Math.round(design.share[patch] / 2.55)} %${design.film[patch] ? ", by film" : ""}`]);
        if (known.length === design.nozzles.length)
            rows.push(["From", bringing.join(", ") || "no nozzle"]);
        return rows;
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
        answer.append(scrolling.watch(element("div", {class: "wide"}, table)));
    }

    /* Through x, y of the canvas, in CSS pixels from its top left, in the picture of the i-th design shown. */
    function rayAt(i, x, y) {
        const {left, width, height} = place(i), seen = frame();
        const wide = REACH * Math.max(width / height, 1), tall = (wide * height) / width;
        const ray = unit(add(add(scaled(seen.back, -1), seen.across, ((2 * (x - left)) / width - 1) * wide), seen.above,
                             (1 - (2 * y) / height) * tall));
        return {eye: seen.eye, ray};
    }

    function ask(x, y) {
        const i = state.shown.findIndex((_, k) => x >= place(k).left && x <= place(k).left + place(k).width);
        if (i < 0)
            return;
        const model = state.shown[i].model, {eye, ray} = rayAt(i, x, y);
        const hit = nearest(model, eye, ray);
        if (!hit) {
            tell("Nothing there.", model, -1);
            return;
        }
        const patch = patchAt(model, hit), part = model.parts[hit.drawn.part];
        const where = hit.at.map((value, k) => placeText(value + model.origin[k])).join(", ");
        tell(`${part.name} at ${where} m${patch < 0 ? ": no cleaning asked there" : ""}`, model, patch);
        answer.dataset.patch = patch;
    }
    return {tell, nearest, rayAt, ask, placeText};
}
