/* The controls of the nozzle in hand. */
function makeEditor(live) {
    "use strict";
    const {view, design, editing, holder, sliders, undoButton, named, mountOf, fitType, mountName, mountAt, run, change,
           addNozzle, drawNozzles, save, positionSliders, poseSliders, typeSliders} = live;
    const {types, mounts} = editing, {element, option, button} = widgets;

    function list(name, texts, at, act) {
        const made = element("select", {}, ...texts.map((text, i) => option(text, i === at)));
        made.addEventListener("change", () => act(made.selectedIndex));
        holder.append(element("label", {}, `${name} `, made));
    }

    function build() {
        const focused = document.activeElement && document.activeElement.dataset.key;
        const nozzle = live.nozzles[live.chosen], mount = mountOf(nozzle);
        holder.replaceChildren();
        sliders.replaceChildren();
        live.syncs = [];
        list("Nozzle", live.nozzles.map(({name, on}) => (on ? name : `${name}, off`)), live.chosen, (i) => {
            live.chosen = i;
            drawNozzles();
            view.redraw();
            build();
            run(true);
        });
        const allowed = types.map((_, i) => i).filter((i) => i < named && (i === nozzle.type ||
            mount.types.includes(i)));
        list("Type", allowed.map((i) => types[i].name), allowed.indexOf(nozzle.type), (i) => change(null, (own) => {
            own.type = allowed[i];
            fitType(own);
        }, true));
        list("Mount", ["anywhere", ...mounts.map(mountName)], nozzle.mount + 1, (i) =>
            change(null, (own) => mountAt(own, i - 1), true));
        const toggle = button(nozzle.on ? "Switch off" : "Switch on", () =>
            change(null, (own) => (own.on = !own.on), true));
        const adds = element("select", {"aria-label": "Mount of a nozzle more"},
            ...["anywhere", ...mounts.map(mountName)].map((text, i) => option(text, i === 1)));
        const more = button("Add a nozzle at", () => addNozzle(adds.selectedIndex - 1));
        const grip = button("Move it in the picture", () => {
            design.shown = true;
            view.show(design);
        });
        holder.append(grip, toggle, element("span", {class: "adding"}, more, " ", adds), undoButton,
                      button("Save as scene", save));
        [...holder.querySelectorAll("select, button")].forEach((one, i) => (one.dataset.key = `key${i}`));
        if (focused)
            (holder.querySelector(`[data-key="${focused}"]`) || holder.querySelector("select")).focus();
        positionSliders(nozzle, mount);
        poseSliders(nozzle, mount);
        typeSliders(nozzle);
    }
    return {build};
}
