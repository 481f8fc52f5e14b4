/* What a layout comes to, in words and as a table. */
function makeTelling(live) {
    "use strict";
    const {editing, figures, answer, mountHolding, mountName, LITRES} = live, {types, mounts} = editing;
    const {element} = widgets;

    const short = (value, digits = 4) => String(Number(value.toPrecision(digits)));
    const percent = (share) => `${(100 * share).toFixed(2)} %`;
    /* As the page's tables tell water: the tenth from 10 L/min on, three significant digits below; 0 with nothing. */
    function waterDecimals(value) {
        let decimals = 1;
        while (value >= 0.5e-9 && decimals < 9 && value < 10 ** (2 - decimals) - 0.5 * 10 ** (-decimals - 1))
            decimals++;
        return decimals;
    }
    const litres = (flow) => `${(LITRES * flow).toFixed(waterDecimals(LITRES * flow))} L/min`;

    /* Water, and what the mounts of the nozzles that are on cost, in m³/s. */
    const priceOf = (flow) => live.nozzles.reduce((sum, {on, cost}) => sum + (on && cost || 0), flow);
    const priceText = (price) => `${litres(price)}${editing.currency ? `, ${Math.round(price * editing.money)} ` +
        editing.currency : ""}`;

    function tellFigures() {
        const [area] = [live.start, live.last].filter((one) => one && one.coverage > 0)
            .map((one) => one.covered / one.coverage);
        const row = (name, of) => element("tr", {}, element("th", {scope: "row"}, name),
            ...[live.start, live.last].map((one) => element("td", {}, one ? of(one) : "")));
        const rows = [row("Coverage", (one) => percent(one.coverage)), row("Water", (one) => litres(one.flow)),
            row("Area per water, m² per L/min", (one) =>
                (one.flow > 0 ? short(one.covered / one.flow / LITRES) : "none")),
            row("Not covered, m²", (one) => (area ? short(area - one.covered, 3) : "all"))];
        if (editing.costly)
            rows.splice(2, 0, row("Price: water and mounts", (one) => priceText(one.price)));
        figures.replaceChildren(element("table", {class: "numbers narrow"},
            element("thead", {}, element("tr", {}, ...["Layout", live.start.name, "Yours"].map((name) =>
                element("th", {scope: "col"}, name)))),
            element("tbody", {}, ...rows)));
    }

    /* Nozzles whose bodies overlap, as sp_layout_overlap tells of them. */
    function crowded() {
        const on = live.nozzles.filter((nozzle) => nozzle.on);
        return on.flatMap((own, i) => {
            for (const other of on.slice(0, i)) {
                const apart = Math.hypot(...own.place.map((x, k) => x - other.place[k]));
                const bodies = [other, own].map(({type}) => 1e3 * types[type].body);
                if (apart <= 1e-6)
                    return [`${other.name} and ${own.name} stand in one place: their bodies overlap.`];
                if (1e3 * apart < (1 - 1e-9) * (bodies[0] + bodies[1]) / 2)
                    return [`${other.name} and ${own.name} stand ${short(1e3 * apart, 3)} mm apart: their bodies of ` +
                        `${short(bodies[0])} mm and ${short(bodies[1])} mm overlap.`];
            }
            return [];
        });
    }

    /* What the scene does not allow: types that do not fit where they are, and more nozzles than are to be. On a mount
     * other than a port kept ones do not count. */
    function broken() {
        const on = live.nozzles.filter((nozzle) => nozzle.on);
        const words = on.filter((nozzle) => !mountHolding(nozzle).types.includes(nozzle.type)).map((nozzle) =>
            `${nozzle.name}, of type ${types[nozzle.type].name}, does not fit port ${mountHolding(nozzle).name}.`);
        for (const mount of mounts.filter(({most}) => most)) {
            const port = mount.kind === "port", name = mount.name ? `${mount.kind} ${mount.name}` : mountName(mount);
            const held = on.filter((nozzle) => mountHolding(nozzle) === mount && (port || !nozzle.keep)).length;
            if (held > mount.most)
                words.push(`${name[0].toUpperCase()}${name.slice(1)} holds ${held} nozzles${port ? "" :
                    " besides kept ones"}, and takes ${mount.most}.`);
        }
        if (editing.most && on.length > editing.most)
            words.push(`These are ${on.length} nozzles, and max_nozzles allows ${editing.most}.`);
        return words;
    }

    function tell(stride, finished) {
        const texel = 1e3 * editing.settings[8];
        const how = stride > 1
            ? ` counted on one texel of ${stride * stride} (every ${short(stride * texel, 3)} mm); ` +
                "the figure on all of them follows" : ` on texels of ${short(texel, 3)} mm`;
        const words = [`Coverage ${percent(live.last.coverage)} with ${litres(live.last.flow)},${how}.`];
        if (editing.costly)
            words.push(`Water and mounts cost ${priceText(live.last.price)}.`);
        if (finished) {
            const [largest] = finished.shadows;
            if (largest)
                words.push(`Largest region that is not covered: ${short(largest.area, 3)} m² on ` +
                    `${editing.parts[largest.part].name}, ${editing.lacks[largest.lack]}.`);
            finished.stands.forEach((wrong, i) => wrong && live.nozzles[i].on &&
                words.push(`This layout cannot be built: ${wrong.replace("nozzles: ", live.nozzles[i].name)}.`));
        }
        answer.replaceChildren(...words.concat(broken(), crowded()).map((line) => element("p", {}, line)));
    }
    return {percent, litres, priceOf, tellFigures, tell};
}
