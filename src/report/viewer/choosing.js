/* One nozzle, or one uncovered region, chosen in its picture or in a row of the page's tables. */
function makeChoosing(view) {
    "use strict";
    const {state, designs, stage, up, right, front, size, REACH, tell, recolour} = view;
    const {add, dot} = geometry, {button} = widgets;

    function chooseNozzle(design, index) {
        if (!design.nozzles[index].known)
            return tell(`What ${design.nozzles[index].name} does alone was not worked out.`, null, -1);
        const same = state.nozzle && state.nozzle.design === design && state.nozzle.index === index;
        state.nozzle = same ? null : {design, index};
        show(design);
        const {name, direct} = design.nozzles[index], jets = direct.length ? ", and a few of its jets" : "";
        tell(same ? "All nozzles." : `${design.name}: what ${name} does alone, as liquid flux${jets}.`, null, -1);
    }

    function chooseShadow(design, index) {
        const {at, towards, extent} = design.shadows[index];
        const level = add(towards, up, -dot(towards, up));
        state.shadow = {design, index};
        state.camera = {
            target: at.slice(),
            azimuth: Math.hypot(...level) > 1e-6 ? Math.atan2(dot(level, right), dot(level, front)) : 0,
            elevation: Math.min(Math.max(Math.asin(Math.min(1, Math.max(-1, dot(towards, up)))), -1.45), 1.45),
            distance: Math.max(0.9 * extent, 0.06 * size) / REACH,
        };
        show(design);
        tell(`${design.name}: uncovered region ${index + 1}, marked in yellow.`, null, -1);
    }

    function show(design) {
        if (!state.shown.includes(design))
            state.shown = designs.filter((other) => state.shown.includes(other) || other === design);
        view.switches.forEach(([box, shown]) => (box.checked = state.shown.includes(shown)));
        recolour();
        stage.scrollIntoView({block: "nearest"});
    }

    /* Rows of the page's tables become buttons. */
    function bindRows(id, act) {
        designs.forEach((design) =>
            document.querySelectorAll(`#${id} table[data-design="${design.index}"] tbody tr`).forEach((row, index) => {
                const head = row.querySelector("th");
                const made = button("", () => act(design, index));
                made.className = "row";
                made.append(...head.childNodes);
                head.append(made);
            }));
    }
    return {chooseNozzle, chooseShadow, show, bindRows};
}
