/* Names of designs and nozzles over their pictures. */
function makeLabels(view) {
    "use strict";
    const {state, labels, place} = view, {dot} = geometry, {element} = widgets;

    function moveLabels() {
        labels.replaceChildren(...state.shown.flatMap((design, i) => {
            const {left, width, height} = place(i);
            const title = element("span", {class: "title"}, `${design.name}: ${design.quote}`);
            title.style.left = `${left}px`;
            title.style.maxWidth = `${width - 16}px`;
            return [title, ...design.nozzles.map((nozzle, index) => {
                const [x, y, , w] = [0, 1, 2, 3].map((row) =>
                    dot([design.matrix[row], design.matrix[4 + row], design.matrix[8 + row]], nozzle.at) +
                    design.matrix[12 + row]);
                const chosen = state.nozzle && state.nozzle.design === design && state.nozzle.index === index;
                const label = element("span", {class: chosen ? "nozzle-dot chosen" : "nozzle-dot"}, nozzle.name);
                label.addEventListener("click", () => view.chooseNozzle(design, index));
                label.hidden = w <= 0 || Math.abs(x) > w || Math.abs(y) > w;
                label.style.left = `${left + ((1 + x / w) * width) / 2}px`;
                label.style.top = `${((1 - y / w) * height) / 2}px`;
                return label;
            })];
        }));
    }
    return {moveLabels};
}
