/* The layout as a scene for `simulate` and `place`. */
function makeScene(live) {
    "use strict";
    const {editing, origin, answer} = live, {types} = editing, {element} = widgets;

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
        const block = /^nozzles:.*\n(?:[ -].*\n)*/m, on = live.nozzles.filter((nozzle) => nozzle.on);
        const text = on.length ? `nozzles:\n${on.map(nozzleText).join("")}` : "nozzles: []\n";
        return editing.scene.replace(block, () => text);
    }
    function save() {
        if (!live.nozzles.some((nozzle) => nozzle.on)) {
            answer.replaceChildren(element("p", {}, "No nozzle is switched on: there is no layout to save."));
            return;
        }
        const address = URL.createObjectURL(new Blob([sceneText()], {type: "text/yaml"}));
        element("a", {href: address, download: "changed.yaml"}).click();
        setTimeout(() => URL.revokeObjectURL(address), 1000);
        answer.replaceChildren(element("p", {}, "Saved as changed.yaml. Put it beside this page: its paths to " +
            "geometry and catalogue start there."));
    }
    return {sceneText, save};
}
