/* Nozzles within their mounts. Lengths in m, angles in rad. */
function makeLayout(live) {
    "use strict";
    const {view, editing, origin} = live, {types, mounts, datum} = editing, density = editing.settings[0];
    const {add, scaled, cross, unit, limited, tiltOf, leaning, lies} = geometry;

    /* A place as it is when it was written and read again. */
    const told = (place) => place.map((x, k) => x + origin[k] - origin[k]);
    const downwards = scaled(datum.axis, -1), near = 1e-5 * view.size;
    const free = {kind: "free", tilt: Math.PI, axis: downwards, types: types.map((_, i) => i), most: 0};
    const mountOf = (nozzle) => mounts[nozzle.mount] || free;
    /* The same, or the port in which a nozzle stands that was put elsewhere, as sp_mount_at has it. */
    const mountHolding = (nozzle) => (mountOf(nozzle).kind !== "port" &&
        mounts.find((mount) => mount.kind === "port" && lies(mount, nozzle.place, 4e-4 * view.size))) ||
        mountOf(nozzle);
    const typeOf = (nozzle) => types[nozzle.type].numbers;
    const named = types.filter((type) => type.name).length;
    const partsOf = (mount) => (mount.part >= 0 ? [mount.part]
        : editing.parts.flatMap((part, i) => (part.geometry === mount.geometry ? [i] : [])));

    function nozzleOf({name, numbers, keep, jets, cost}) {
        const [type, x, y, z, ax, ay, az, roll, pressure, angle, flow, speed] = numbers;
        return {name, type, place: [x, y, z], axis: [ax, ay, az], roll, pressure, angle, flow, speed, on: true, keep,
                jets, cost, mount: -1, reference: downwards};
    }
    const numbersOf = (nozzle) => [nozzle.type, ...nozzle.place, ...nozzle.axis, nozzle.roll, nozzle.pressure,
                                   nozzle.angle, nozzle.flow, nozzle.speed, nozzle.on ? 1 : 0];

    /* The mount that a nozzle is on, none where it is on none; and what its tilt is counted from. */
    async function findMount(nozzle) {
        nozzle.mount = mounts.findIndex((mount) => lies(mount, nozzle.place, near) &&
            tiltOf(mount.axis, nozzle.axis, datum).tilt <= mount.tilt + 1e-6);
        for (let i = 0; i < mounts.length && nozzle.mount < 0; i++) {
            if (mounts[i].kind !== "surface")
                continue;
            const {far, normal} = await live.ask("foot", {parts: partsOf(mounts[i]), point: nozzle.place});
            if (!normal || Math.abs(far - mounts[i].standoff) > 10 * near ||
                tiltOf(normal, nozzle.axis, datum).tilt > mounts[i].tilt + 1e-3)
                continue;
            nozzle.mount = i;
            nozzle.reference = normal;
        }
        if (mountOf(nozzle).kind !== "surface")
            nozzle.reference = mountOf(nozzle).axis;
        Object.assign(nozzle, tiltOf(nozzle.reference, nozzle.axis, datum));
    }

    /* Onto its mount, from wherever its place is. */
    async function settle(nozzle) {
        const mount = mountOf(nozzle);
        if (mount.kind === "surface") {
            const {place, normal} = await live.ask("foot", {parts: partsOf(mount), point: nozzle.place});
            nozzle.place = add(place, normal, mount.standoff);
            nozzle.reference = normal;
        } else {
            nozzle.reference = mount.axis;
        }
        nozzle.place = told(nozzle.place);
        nozzle.tilt = Math.min(nozzle.tilt, mount.tilt);
        nozzle.axis = leaning(nozzle.reference, nozzle.tilt, nozzle.azimuth, datum);
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

    const mountName = (mount) => mount.name ||
        (mount.part >= 0 && mount.kind === "surface" ? `surface of ${editing.parts[mount.part].name}` : mount.kind);
    async function mountAt(nozzle, index) {
        nozzle.mount = index;
        const mount = mountOf(nozzle);
        nozzle.place = mount.kind === "port" ? add(mount.position, mount.axis, mount.depth[0])
            : mount.kind === "line" || mount.kind === "box" ? scaled(add(mount.from, mount.to), 0.5) : nozzle.place;
        if (mount.types.length && !mount.types.includes(nozzle.type))
            nozzle.type = mount.types[0];
        nozzle.cost = nozzle.keep ? 0 : mount.cost || 0;
        fitType(nozzle);
    }

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
    return {mountOf, mountHolding, typeOf, named, nozzleOf, numbersOf, findMount, settle, flowAt, flowOf, adjustable,
            fitType, mountName, mountAt, rimOf};
}
