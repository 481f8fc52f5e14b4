/* What is shown, cut and looked at from where, chosen from lists and by buttons. */
function makeControls(view) {
    "use strict";
    const {about, state, designs, controls, flux, coverage, difference, reached, chartHues, SCALES, MAPS, coloured, fit,
           uploadLines, redraw, recolour, partKey, tell, barText} = view;
    const {element, option, button, checkbox} = widgets;

    function choice(name, texts, chosen, act) {
        const list = element("select", {}, ...texts.map((text, i) => option(text, i === chosen)));
        list.addEventListener("change", () => act(list.selectedIndex));
        controls.append(element("label", {}, `${name} `, list));
        return list;
    }

    /* By a key: the next that may be chosen. */
    function nextOf(list) {
        const free = [...list.options].filter((one) => !one.disabled);
        const at = free.indexOf(list.options[list.selectedIndex]);
        if (list.disabled)
            return;
        list.selectedIndex = free[(at + 1) % free.length].index;
        list.dispatchEvent(new Event("change"));
    }

    const switches = [];
    const switchboard = element("span", {class: "switches"});
    function addSwitch(design) {
        const [box, label] = checkbox(design.name, state.shown.includes(design), (changed) => {
            const shown = designs.filter((other) =>
                (other === design ? changed.checked : state.shown.includes(other)));
            if (shown.length)
                state.shown = shown;
            changed.checked = state.shown.includes(design);
            recolour();
        });
        switches.push([box, design]);
        switchboard.append(label);
    }
    /* For live.js: a design more, that changes. */
    function addDesign(design) {
        designs.push(design);
        uploadLines(design);
        addSwitch(design);
    }
    function addDesigns() {
        designs.forEach(addSwitch);
        controls.append(switchboard);
    }

    function addQuantities() {
        const known = designs.every((design) => design.nozzles.every((nozzle) => nozzle.known));
        const quantities = [...about.quantities, ...(known ? [reached] : []), coverage,
                            ...(designs.length > 1 ? [difference] : []), chartHues];
        const say = () => {
            recolour();
            tell(barText(), null, -1);
        };
        view.quantityList = choice("Show", quantities.map(({name}) => name), quantities.indexOf(flux), (i) => {
            state.quantity = quantities[i];
            state.nozzle = null;
            say();
        });
        view.scaleList = choice("Scale", ["logarithmic", "linear", "stepped at the criterion"], 0, (i) => {
            state.scales[coloured().key] = SCALES[i];
            say();
        });
        view.mapList = choice("Colours", MAPS, 0, (i) => {
            state.map = MAPS[i];
            say();
        });
    }

    function addCut() {
        choice("Cut", ["nowhere", "across x", "across y", "across z"], state.cut.axis + 1, (i) => {
            state.cut.axis = i - 1;
            redraw();
        });
        const slider = element("input", {type: "range", min: "-1", max: "1", step: "0.01", value: "0",
                                         "aria-label": "Place of the cut"});
        slider.addEventListener("input", () => {
            state.cut.place = Number(slider.value);
            redraw();
        });
        controls.append(slider, button("Other side", () => {
            state.cut.turned = !state.cut.turned;
            redraw();
        }));
    }

    const views = {Fit: [0.5, 0.35], Front: [0, 0], Side: [Math.PI / 2, 0], Top: [0, 1.45], Below: [0.5, -0.5]};
    function addViews() {
        controls.append(...Object.entries(views).map(([name, angles]) => button(name, () => {
            fit(...angles);
            redraw();
        })));
    }

    function addParts() {
        const names = [...new Set(about.models.flatMap((model) =>
            model.draws.map((drawn) => partKey(model, drawn.part))))];
        if (names.length < 2)
            return;
        const boxes = names.map((name) => checkbox(name, true, (box) => {
            state.hidden[box.checked ? "delete" : "add"](name);
            redraw();
        }));
        const all = (shown) => button(shown ? "All" : "None", () => {
            boxes.forEach(([box]) => (box.checked = shown));
            state.hidden = new Set(shown ? [] : names);
            redraw();
        });
        controls.append(element("details", {}, element("summary", {}, "Parts"), all(true), all(false),
                                element("div", {class: "parts"}, ...boxes.map(([, label]) => label))));
    }
    return {views, nextOf, switches, addDesign, addDesigns, addQuantities, addViews, addCut, addParts};
}
