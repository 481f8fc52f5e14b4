/* Names of designs and nozzles over their pictures. */
function makeLabels(view) {
    "use strict";
    const {state, labels, place} = view, {dot} = geometry, {element} = widgets;

    /* Where a place lies in the picture of the i-th design shown, in CSS pixels; null where that is beyond it. */
    function spotOf(i, at) {
        const {left, width, height} = place(i), {matrix} = state.shown[i];
        const [x, y, , w] = [0, 1, 2, 3].map((row) =>
            dot([matrix[row], matrix[4 + row], matrix[8 + row]], at) + matrix[12 + row]);
        return w <= 0 || Math.abs(x) > w || Math.abs(y) > w ? null
            : [left + ((1 + x / w) * width) / 2, ((1 - y / w) * height) / 2];
    }

    /* Cut where it is long; whole where the pointer rests. */
    function labelOf(i, design, nozzle, index) {
        const chosen = state.nozzle && state.nozzle.design === design && state.nozzle.index === index;
        const label = element("span", {title: nozzle.name,
            class: `nozzle-dot${chosen ? " chosen" : ""}${nozzle.held ? " held" : ""}`}, nozzle.name);
        label.addEventListener("click", () => view.chooseNozzle(design, index));
        const spot = spotOf(i, nozzle.at);
        label.hidden = !spot;
        label.style.left = spot ? `${spot[0]}px` : "";
        label.style.top = spot ? `${spot[1]}px` : "";
        label.style.maxWidth = `${0.45 * place(i).width}px`;
        return label;
    }

    /* Of names that would lie over each other the first alone shows, that of the nozzle in hand before all. */
    function leaveOut(names) {
        const inHand = (label) => label.matches(".chosen, .held");
        const taken = [], boxes = new Map(names.map((label) => [label, label.getBoundingClientRect()]));
        for (const label of [...names].sort((a, b) => inHand(b) - inHand(a))) {
            const box = boxes.get(label);
            const lies = ({left, right, top, bottom}) =>
                left < box.right && box.left < right && top < box.bottom && box.top < bottom;
            if (!label.hidden && taken.some(lies))
                label.hidden = true;
            else if (!label.hidden)
                taken.push(box);
        }
    }

    function moveLabels() {
        const names = [];
        labels.replaceChildren(...state.shown.flatMap((design, i) => {
            const {left, width} = place(i);
            const title = element("span", {class: "title"}, `${design.name}: ${design.quote}`);
            title.style.left = `${left}px`;
            title.style.maxWidth = `${width - 16}px`;
            const own = design.nozzles.map((nozzle, index) => labelOf(i, design, nozzle, index));
            names.push(...own);
            return [title, ...own];
        }));
        leaveOut(names);
    }
    return {spotOf, moveLabels};
}
