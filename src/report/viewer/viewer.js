/* The report's viewer: the surface in colours that may be turned, cut and asked, every design under one camera. Needs
 * WebGL 2; without it the section stays hidden and the page is what it is on paper. Of the files before this one each
 * makes a part of it from what those before it have made. */
const viewer = (async () => {
    "use strict";
    const section = document.getElementById("viewer");
    const gl = document.createElement("canvas").getContext("webgl2", {antialias: true, preserveDrawingBuffer: true});
    if (!section || !gl || !window.DecompressionStream)
        return null;

    const {about, designs, inflated} = await readData(), {element} = widgets, {canvas} = gl;
    const flux = about.quantities.find((quantity) => quantity.key === "flux");
    const coverage = {key: "covered", name: "Covered"};
    const difference = {key: "difference", name: "Difference"};
    const state = {
        quantity: flux,
        scales: Object.fromEntries(about.quantities.map(({key, log}) => [key, log ? "log" : "linear"])),
        shown: designs.filter((design) => design.first),
        hidden: new Set(),
        cut: {axis: about.models[0].cut ? 1 : -1, place: 0, turned: false},
        nozzle: null,
        shadow: null,
        camera: null,
    };
    const labels = element("div", {class: "labels"});
    const view = {section, gl, canvas, about, designs, inflated, flux, coverage, difference, state, labels,
        stage: element("div", {class: "stage"}, canvas, labels),
        answer: element("div", {class: "answer", role: "status", "aria-live": "polite"}),
        bar: element("div", {class: "scale"}),
        controls: element("div", {class: "controls"})};
    for (const make of [makeScales, makeColours, makeCamera, makeShaders, makeUploads, makeDrawing, makePick, makeLabels,
                        makeChoosing, makeBar, makeControls, makePointer, makeKeyboard])
        Object.assign(view, make(view));

    canvas.tabIndex = 0;
    canvas.setAttribute("role", "application");
    canvas.setAttribute("aria-label", "The surface in colours, designs side by side. Arrow keys turn, with shift they " +
        "move, plus and minus zoom, f fits, 1, 2 and 3 look from front, side and top, Enter asks the point in the middle " +
        "of the first design.");
    view.addDesigns();
    view.addQuantities();
    view.addViews();
    view.addCut();
    view.addParts();
    view.bindPointer();
    view.bindKeys();
    view.bindRows("nozzles", view.chooseNozzle);
    view.bindRows("contributions", view.chooseNozzle);
    view.bindRows("shadows", view.chooseShadow);
    section.append(view.controls, view.stage, view.bar, view.answer);
    section.hidden = false;
    view.fit(...view.views.Fit);
    about.models.forEach(view.uploadModel);
    designs.forEach(view.uploadLines);
    new ResizeObserver(view.draw).observe(view.stage);
    addEventListener("resize", view.draw); /* also where the page is zoomed: pixels are of another size then */
    view.recolour();
    view.tell("Drag to turn, with shift to move; click a point, a nozzle or a row of the tables below.", null, -1);
    section.dataset.ready = "true";
    return view;
})();
