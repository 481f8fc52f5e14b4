/* A layout of the reader's own: nozzles are moved within their mounts, turned, exchanged, switched off and added, and a
 * worker (worker.js) evaluates what comes of it. What may be changed is written by live.c. Of the files before this one
 * each makes a part of it from what those before it have made. */
(async () => {
    "use strict";
    const view = await viewer;
    const {element, option, button} = widgets;
    const editing = JSON.parse(document.getElementById("live-model").textContent);
    const model = view.about.models.find((other) => other.surface);
    const empty = new Uint8Array(model.patches);
    const design = {index: view.about.models.length + 1e6, name: "Yours", quote: "", manual: false, first: false, model,
                    asked: view.designs.find((other) => other.model === model).asked,
                    values: Object.fromEntries(view.about.quantities.map(({key}) => [key, empty])), share: empty,
                    film: empty, shadowOf: empty, shadows: [], nozzles: [], jets: []};
    const live = {view, editing, model, empty, design, origin: editing.settings.slice(13, 16), LITRES: 6e4,
        nozzles: [], chosen: 0, last: null, syncs: [],
        start: null, started: 0, /* what the table compares with, and where that stands in the list */
        section: element("section", {id: "live"}), figures: scrolling.watch(element("div", {class: "wide"})),
        answer: element("div", {class: "answer", role: "status", "aria-live": "polite"}),
        holder: element("div", {class: "controls"}), sliders: element("div", {class: "sliders"}),
        scene: element("textarea", {readonly: "", rows: "12", spellcheck: "false",
                                    "aria-label": "The layout as a scene"}),
        undoButton: button("Undo", () => live.undo())};
    live.undoButton.disabled = true;
    for (const make of [makeEvaluator, makeLayout, makeTelling, makeEvaluating, makeScene, makeChanges, makeSliders,
                        makeEditor, makeHandles])
        Object.assign(live, make(live));
    const {section, answer, nozzleOf, numbersOf, findMount} = live;

    async function startFrom(from) {
        live.nozzles = from.nozzles.map(nozzleOf);
        for (const nozzle of live.nozzles)
            await findMount(nozzle);
        live.chosen = 0;
        const found = await live.ask("evaluate", {nozzles: live.nozzles.map(numbersOf), stride: 1});
        live.start = {name: view.designs.find((other) => other.index === from.index).name, ...found.figures,
                      price: live.priceOf(found.figures.flow)};
        return found;
    }

    view.section.append(section);
    section.append(element("h3", {}, "Try a change"), answer);
    answer.replaceChildren(element("p", {}, "Getting ready to evaluate layouts here…"));
    try {
        await live.open();
        /* What the report says must come out to the last digits that matter, or nothing is said here. */
        for (const other of [...editing.designs].sort((a, b) => a.main - b.main)) {
            if (!other.nozzles.length)
                continue;
            const found = await startFrom(other);
            if (!(Math.abs(found.figures.coverage - other.coverage) <= 1e-9))
                throw new Error(`this browser finds ${live.percent(found.figures.coverage)} where the report has ` +
                    `${live.percent(other.coverage)}`);
            live.show(found);
        }
    } catch (error) {
        answer.replaceChildren(element("p", {}, `Layouts are shown here and not evaluated: ${error.message}.`));
        section.dataset.failed = error.message;
        return;
    }
    const choices = editing.designs.filter((other) => other.nozzles.length);
    const starts = element("select", {}, ...choices.map((other) =>
        option(view.designs.find(({index}) => index === other.index).name, other.main)));
    starts.addEventListener("change", () => {
        live.after(async () => {
            live.remember(null);
            live.started = starts.selectedIndex;
            await startFrom(choices[live.started]);
            live.refresh(true);
        });
    });
    Object.assign(live, {starts, started: starts.selectedIndex});
    view.addBoxes(async () => view.uploadBoxes(model, await live.ask("boxes")));
    live.drawNozzles();
    view.addDesign(design);
    live.build();
    live.scene.value = live.sceneText();
    section.append(element("div", {class: "controls"}, element("label", {}, "Start from ", starts)), live.holder,
                   live.sliders, live.figures,
                   element("details", {}, element("summary", {}, "The layout as a scene"), live.scene));
    await live.run(true);
    section.dataset.ready = "true";
})();
