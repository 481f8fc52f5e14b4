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

    function moveLabels() {
        labels.replaceChildren(...state.shown.flatMap((design, i) => {
            const {left, width} = place(i);
            const title = element("span", {class: "title"}, `${design.name}: ${design.quote}`);
            title.style.left = `${left}px`;
            title.style.maxWidth = `${width - 16}px`;
            return [title, ...design.nozzles.map((nozzle, index) => {
                const chosen = state.nozzle && state.nozzle.design === design && state.nozzle.index === index;
                const label = element("span", {
                    class: `nozzle-dot${chosen ? " chosen" : ""}${nozzle.held ? " held" : ""}`}, nozzle.name);
                label.addEventListener("click", () => view.chooseNozzle(design, index));
                const spot = spotOf(i, nozzle.at);
                label.hidden = !spot;
                label.style.left = spot ? `${spot[0]}px` : "";
                label.style.top = spot ? `${spot[1]}px` : "";
                return label;
            })];
        }));
    }
    return {spotOf, moveLabels};
}
