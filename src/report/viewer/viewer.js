/* The report's viewer: the surface in colours that may be turned, cut and asked, every design under one camera. Needs
 * WebGL 2; without it the section says so and the page is what it is on paper. Of the files before this one each
 * makes a part of it from what those before it have made. */
const viewer = (async () => {
    "use strict";
    const section = document.getElementById("viewer"), {element} = widgets;
    function withoutPictures() {
        const more = document.getElementById("live-model") ? ", and no layout can be tried" : "";
        section.append(element("p", {class: "note"}, "This browser draws no pictures that turn, for which it needs " +
            `WebGL 2: nothing can be looked at from other sides here${more}. The rest of the report is as ever.`));
        section.hidden = false;
        return null;
    }
    if (!section)
        return null;
    if (!window.WebGL2RenderingContext || !window.DecompressionStream)
        return withoutPictures();
    /* first: the browser brings up meanwhile what the context below waits for */
    const {about, designs, inflated} = await readData();
    const canvas = element("canvas", {});
    const gl = canvas.getContext("webgl2", {antialias: true, preserveDrawingBuffer: true});
    if (!gl)
        return withoutPictures();
    const flux = about.quantities.find((quantity) => quantity.key === "flux");
    const coverage = {key: "covered", name: "Covered"};
    const difference = {key: "difference", name: "Difference"};
    const most = Math.max(2, ...designs.map((design) => design.nozzles.length));
    const reached = {key: "reached", name: "Nozzles that reach it", unit: "", counts: true, shown: [1, most]};
    /* Okabe and Ito's colours, which everybody tells apart (2008, jfly.uni-koeln.de/color), but black. */
    const chartHues = {key: "charts", name: "Charts of the atlas", hues: [[86, 180, 233], [230, 159, 0], [0, 158, 115],
        [240, 228, 66], [0, 114, 178], [213, 94, 0], [204, 121, 167]]};
    const state = {
        quantity: flux,
        scales: Object.fromEntries(about.quantities.map(({key, log}) => [key, log ? "log" : "linear"])),
        map: "viridis",
        layers: {wires: false, jets: false, boxes: false},
        shown: designs.filter((design) => design.first),
        hidden: new Set(),
        cut: {axis: about.models[0].cut ? 1 : -1, place: 0, turned: false},
        nozzle: null,
        shadow: null,
        camera: null,
    };
    const labels = element("div", {class: "labels"});
    const axes = document.createElementNS("http://www.w3.org/2000/svg", "svg");
    axes.setAttribute("aria-hidden", "true");
    const view = {section, gl, canvas, about, designs, inflated, flux, coverage, difference, reached, chartHues, state,
        labels, axes, layers: element("span", {class: "switches"}),
        stage: element("div", {class: "stage"}, canvas, labels, axes),
        answer: element("div", {class: "answer", role: "status", "aria-live": "polite"}),
        bar: element("div", {class: "scale"}),
        controls: element("div", {class: "controls"})};
    for (const make of [makeScales, makeColours, makeCamera, makeShaders, makeUploads, makeDrawing, makePick,
                        makeLabels, makeAxes, makeChoosing, makeBar, makeControls, makeLayers, makePointer,
                        makeKeyboard])
        Object.assign(view, make(view));
    view.overlays = [view.moveLabels, view.moveAxes]; /* what moves with the picture */

    view.addDesigns();
    view.addQuantities();
    view.addViews();
    view.addCut();
    view.addLayers();
    view.controls.append(view.layers);
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
