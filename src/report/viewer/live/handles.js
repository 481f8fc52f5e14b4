/* The nozzle in hand, moved in its picture: a disc where it is, drawn within its mount, and one at the end of its axis,
 * which leans within its tilt. By keyboard the sliders do the same. */
function makeHandles(live) {
    "use strict";
    const {view, design, editing, mountOf, change} = live, {datum} = editing;
    const {add, dot, scaled, unit, limited, tiltOf} = geometry;
    const LONG = 0.15 * view.size; /* of the axis that is shown, m */

    function shape(tag, attributes) {
        const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
        Object.entries(attributes).forEach(([key, value]) => made.setAttribute(key, value));
        return made;
    }
    const stem = shape("line", {}), place = shape("circle", {r: 7, "data-drag": "place"});
    const tip = shape("circle", {r: 6, "data-drag": "axis"});
    const picture = shape("svg", {class: "handles", "aria-hidden": "true"});
    picture.append(stem, place, tip);
    view.stage.append(picture);

    function move() {
        const nozzle = live.nozzles[live.chosen], i = view.state.shown.indexOf(design);
        const spots = i >= 0 && nozzle && nozzle.on
            ? [nozzle.place, add(nozzle.place, nozzle.axis, LONG)].map((at) => view.spotOf(i, at)) : [null];
        picture.style.display = spots.includes(null) ? "none" : "";
        if (spots.includes(null))
            return;
        tip.style.display = mountOf(nozzle).tilt > 0 ? "" : "none";
        [place, tip].forEach((disc, k) => {
            disc.setAttribute("cx", spots[k][0]);
            disc.setAttribute("cy", spots[k][1]);
            stem.setAttribute(`x${k + 1}`, spots[k][0]);
            stem.setAttribute(`y${k + 1}`, spots[k][1]);
        });
    }
    view.overlays.push(move);

    /* How far along a line from a place the point lies that is nearest to a ray; NaN where they lead the same way. */
    function alongLine(from, way, {eye, ray}) {
        const apart = add(from, eye, -1), b = dot(way, ray), d = dot(way, way) - b * b;
        return d > 1e-9 * dot(way, way) ? (b * dot(ray, apart) - dot(way, apart)) / d : NaN;
    }
    /* Where a ray meets a plane through a place. */
    function onPlane(through, normal, {eye, ray}) {
        const far = dot(add(through, eye, -1), normal) / dot(ray, normal);
        return far > 0 && Number.isFinite(far) ? add(eye, ray, far) : null;
    }
    function within({low, high}, at) {
        return at.map((x, k) => limited(x, low[k], high[k]));
    }

    /* Where the nozzle goes that is drawn along a ray, as its mount allows; its place where nothing lies there. */
    function drawn(nozzle, ray) {
        const mount = mountOf(nozzle), facing = view.frame().back;
        if (mount.kind === "port") {
            const depth = alongLine(mount.position, mount.axis, ray);
            return Number.isNaN(depth) ? nozzle.place
                : add(mount.position, mount.axis, limited(depth, mount.depth[0], mount.depth[1]));
        }
        if (mount.kind === "line") {
            const way = add(mount.to, mount.from, -1), along = alongLine(mount.from, way, ray);
            return Number.isNaN(along) ? nozzle.place : add(mount.from, way, limited(along, 0, 1));
        }
        if (mount.kind === "surface") {
            const hit = view.nearest(live.model, ray.eye, ray.ray);
            return hit ? hit.at : nozzle.place;
        }
        const box = mount.kind === "box" ? {low: mount.from, high: mount.to} : view.box;
        const flat = [0, 1, 2].find((k) => !(box.high[k] > box.low[k]));
        const normal = flat === undefined ? facing : [0, 1, 2].map((k) => (k === flat ? 1 : 0));
        const at = onPlane(nozzle.place, normal, ray);
        return at ? within(box, at) : nozzle.place;
    }

    /* Which way the axis goes whose end is drawn along a ray: to where that meets the sphere of such ends, of two such
     * places to that nearer to where it was, or else to where it passes nearest. */
    function turned(nozzle, {eye, ray}) {
        const from = add(nozzle.place, eye, -1), middle = dot(from, ray), off = add(scaled(ray, middle), from, -1);
        const left = LONG * LONG - dot(off, off), half = left > 0 ? Math.sqrt(left) : 0;
        const ways = [half, -half].map((back) => unit(add(off, ray, back)));
        return ways.sort((a, b) => dot(b, nozzle.axis) - dot(a, nozzle.axis))[0];
    }

    const acts = {
        place: (nozzle, ray) => (nozzle.place = drawn(nozzle, ray)),
        axis: (nozzle, ray) => Object.assign(nozzle, tiltOf(nozzle.reference, turned(nozzle, ray), datum)),
    };

    /* One change at a time; of several that are wished the latest. */
    let wish = null, busy = false;
    async function follow(drag) {
        if (busy)
            return;
        busy = true;
        try {
            while (wish) {
                const ray = view.rayAt(view.state.shown.indexOf(design), ...wish);
                wish = null;
                await change(`drag ${drag}`, (nozzle) => acts[drag](nozzle, ray));
            }
        } finally {
            busy = false;
        }
    }
    [place, tip].forEach((disc) => {
        disc.addEventListener("pointerdown", (event) => {
            disc.setPointerCapture(event.pointerId);
            event.preventDefault();
        });
        disc.addEventListener("pointermove", (event) => {
            if (!disc.hasPointerCapture(event.pointerId))
                return;
            const box = view.canvas.getBoundingClientRect();
            wish = [event.clientX - box.left, event.clientY - box.top];
            follow(disc.dataset.drag);
        });
    });
    return {};
}
