/* Keys on the canvas. */
function makeKeyboard(view) {
    "use strict";
    const {canvas, views, fit, turn, shift, zoom, ask, place, redraw, toggleLayer, nextOf} = view;

    const steps = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]};
    const acts = {"+": () => zoom(0.85), "=": () => zoom(0.85), "-": () => zoom(1 / 0.85),
                  f: () => fit(...views.Fit), 1: () => fit(...views.Front), 2: () => fit(...views.Side),
                  3: () => fit(...views.Top), q: () => nextOf(view.quantityList), l: () => nextOf(view.scaleList),
                  c: () => nextOf(view.mapList), w: () => toggleLayer("wires"), j: () => toggleLayer("jets"),
                  b: () => toggleLayer("boxes")};
    const explained = "The surface in colours, designs side by side. Arrow keys turn, with shift they move, plus and " +
        "minus zoom, f fits, 1, 2 and 3 look from front, side and top, Enter asks the point in the middle of the " +
        "first design, q shows the next quantity, l by the next scale, c in other colours; w draws a wireframe, " +
        "j jets, b boxes.";

    function bindKeys() {
        canvas.tabIndex = 0;
        canvas.setAttribute("role", "application");
        canvas.setAttribute("aria-label", explained);
        canvas.addEventListener("keydown", (event) => {
            const step = steps[event.key];
            if (step)
                event.shiftKey ? shift(-step[0] / 20, step[1] / 20) : turn(step[0] / 12, step[1] / 12);
            else if (event.key === "Enter" || event.key === " ")
                ask(place(0).width / 2, place(0).height / 2);
            else if (acts[event.key] && !event.ctrlKey && !event.metaKey)
                acts[event.key]();
            else
                return;
            event.preventDefault();
            redraw();
        });
    }
    return {bindKeys};
}
