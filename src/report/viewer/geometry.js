/* Places and directions, [x, y, z] in m and unit, angles in rad: what the viewer and live.js reckon with. */
const geometry = (() => {
    "use strict";

    const add = (a, b, s = 1) => a.map((x, k) => x + s * b[k]);
    const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    const scaled = (a, s) => a.map((x) => x * s);
    const unit = (a) => scaled(a, 1 / (Math.sqrt(dot(a, a)) || 1));
    const distance = (a, b) => Math.hypot(...add(a, b, -1));
    const limited = (x, low, high) => Math.min(Math.max(x, low), high);

    /* 1, 2 or 5 of a power of ten: the largest that is no more. */
    function roundStep(most) {
        const power = 10 ** Math.floor(Math.log10(most));
        return power * [5, 2, 1].find((step) => step * power <= most || step === 1);
    }

    /* Two directions across one, of which a tilt's azimuth is counted from the first to the second: across one that
     * leads against the datum's axis those of the datum's azimuths 0 and 90. */
    function across(axis, datum) {
        const other = Math.abs(dot(axis, datum.zero)) < 0.9 ? datum.zero : datum.axis;
        const first = unit(add(other, axis, -dot(other, axis)));
        return [first, cross(first, axis)];
    }
    function leaning(reference, tilt, azimuth, datum) {
        const [first, second] = across(reference, datum);
        return unit(add(add(scaled(reference, Math.cos(tilt)), first, Math.sin(tilt) * Math.cos(azimuth)), second,
                        Math.sin(tilt) * Math.sin(azimuth)));
    }
    function tiltOf(reference, axis, datum) {
        const [first, second] = across(reference, datum), x = dot(axis, first), y = dot(axis, second);
        return {tilt: Math.atan2(Math.hypot(x, y), dot(axis, reference)), azimuth: x || y ? Math.atan2(y, x) : 0};
    }

    /* Whether a mount other than a surface holds this place, to `near`. */
    function lies(mount, place, near) {
        const from = add(place, mount.position, -1), depth = dot(from, mount.axis), way = add(mount.to, mount.from, -1);
        const along = limited(dot(add(place, mount.from, -1), way) / (dot(way, way) || 1), 0, 1);
        return mount.kind === "port" ? depth > mount.depth[0] - near && depth < mount.depth[1] + near &&
                distance(add(mount.position, mount.axis, depth), place) < near
            : mount.kind === "line" ? distance(add(mount.from, way, along), place) < near
            : mount.kind === "box" && place.every((x, k) => x > mount.from[k] - near && x < mount.to[k] + near);
    }
    return {add, dot, cross, scaled, unit, limited, roundStep, tiltOf, leaning, lies};
})();
