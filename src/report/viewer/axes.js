/* Which way x, y and z go, and how long things are in the middle of the picture, in its corner. */
function makeAxes(view) {
    "use strict";
    const {axes, state, frame, place, REACH} = view, {dot, roundStep} = geometry;
    const CROSS = 26, LETTER = 11, NEAR = 15, SHORTEST = 4, LONGEST = 130; /* CSS pixels; shorter axes are dots */

    function shape(tag, attributes, text) {
        const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
        Object.entries(attributes).forEach(([key, value]) => made.setAttribute(key, value));
        made.textContent = text || "";
        return made;
    }

    /* Where a letter goes: beyond its axis's end, or beside it, with a stroke, where that of a longer axis is near. */
    function letterOf({x, y, seen}, others) {
        const right = (LETTER * x) / seen, down = (LETTER * y) / seen, beyond = {x: x + right, y: y + down, stroke: ""};
        return others.some((at) => Math.hypot(at.x - beyond.x, at.y - beyond.y) < NEAR)
            ? {x: x + down, y: y - right, stroke: `l${down / 2} ${-right / 2}`} : beyond;
    }

    function cross() {
        const {across, above} = frame(), letters = [];
        const ends = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map((axis, k) => {
            const x = CROSS * dot(axis, across), y = -CROSS * dot(axis, above);
            return {name: "xyz"[k], x, y, seen: Math.hypot(x, y)};
        });
        return ends.filter(({seen}) => seen > SHORTEST).sort((a, b) => b.seen - a.seen).flatMap((axis) => {
            const at = letterOf(axis, letters);
            letters.push(at);
            return [shape("path", {d: `M40 45l${axis.x} ${axis.y}${at.stroke}`}),
                    shape("text", {x: 40 + at.x, y: 49 + at.y}, axis.name)];
        });
    }

    function ruler() {
        const {width, height} = place(0), wide = REACH * Math.max(width / height, 1) * state.camera.distance;
        const pixels = width / 2 / wide, length = roundStep(LONGEST / pixels), end = 96 + length * pixels;
        const text = length < 1 ? `${Number((1e3 * length).toPrecision(1))} mm` : `${length} m`;
        return [shape("path", {d: `M96 68v8H${end.toFixed(1)}v-8`}),
                shape("text", {x: (96 + end) / 2, y: 66}, text)];
    }

    function moveAxes() {
        axes.replaceChildren(...cross(), ...ruler());
    }
    return {moveAxes};
}
