/* Where the designs are looked at from, and what is cut off: places in m, matrices column by column. */
function makeCamera(view) {
    "use strict";
    const {about, state, canvas} = view;
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

    const GAP = 8;
    /* Where a design's picture lies on the canvas, in CSS pixels from its top left. */
    function place(i) {
        const width = (canvas.clientWidth - GAP * (state.shown.length - 1)) / state.shown.length;
        return {left: i * (width + GAP), width, height: canvas.clientHeight};
    }

    const turn = (x, y) => {
        state.camera.azimuth += x;
        state.camera.elevation = Math.min(Math.max(state.camera.elevation + y, -1.5), 1.5);
        view.redraw();
    };
    const shift = (x, y) => {
        const seen = frame(), step = 2 * REACH * state.camera.distance;
        state.camera.target = add(add(state.camera.target, seen.across, -x * step), seen.above, y * step);
        view.redraw();
    };
    const zoom = (factor) => {
        state.camera.distance = Math.min(Math.max(state.camera.distance * factor, 0.02 * size), 20 * size);
        view.redraw();
    };
    return {up, right, front, size, REACH, box: {low, high}, fit, frame, projection, cutPlane, place, turn, shift,
            zoom};
}
