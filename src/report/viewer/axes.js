/* Which way x, y and z go, and how long things are in the middle of the picture, in its corner. */
function makeAxes(view) {
    "use strict";
    const {axes, state, frame, place, REACH} = view, {dot, roundStep} = geometry;
    const CROSS = 26, LONGEST = 130; /* CSS pixels */

    function shape(tag, attributes, text) {
        const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
        Object.entries(attributes).forEach(([key, value]) => made.setAttribute(key, value));
        made.textContent = text || "";
        return made;
    }

    function cross() {
        const {across, above, back} = frame();
        const ends = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map((axis, k) =>
            ({name: "xyz"[k], x: CROSS * dot(axis, across), y: -CROSS * dot(axis, above), near: dot(axis, back)}));
        return ends.sort((a, b) => a.near - b.near).flatMap(({name, x, y}) => [
            shape("line", {x1: 40, y1: 45, x2: 40 + x, y2: 45 + y}),
            shape("text", {x: 40 + 1.4 * x, y: 49 + 1.4 * y}, name)]);
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
