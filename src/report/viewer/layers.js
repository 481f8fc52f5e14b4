/* What may be drawn over the colours: edges of triangles, jets, boxes. */
function makeLayers(view) {
    "use strict";
    const {state, designs, about, layers, tell, redraw, uploadWires, uploadBoxes} = view, {checkbox} = widgets;
    const bounces = () => designs.some((design) => design.nozzles.some(({bounced}) => bounced && bounced.length));
    const kinds = {
        wires: {name: "Wireframe", told: "the edges of the triangles",
                prepare: () => about.models.forEach(uploadWires)},
        jets: {name: "Jets", told: "a few jets of every nozzle, or of the one chosen, to the first wall in pink",
               more: () => (bounces() ? ", and on to three more in orange" : "")},
    };

    /* Resolves when it is drawn. */
    async function switchLayer(key, on) {
        const {name, told, more, prepare, box} = kinds[key];
        if (on && prepare && !kinds[key].ready)
            kinds[key].ready = (await prepare(), true);
        state.layers[key] = box.checked = on;
        tell(on ? `${name}: ${told}${more ? more() : ""}.` : `${name}: off.`, null, -1);
        redraw();
    }

    function addBox(key) {
        const [box, label] = checkbox(kinds[key].name, false, () => switchLayer(key, box.checked));
        kinds[key].box = box;
        layers.append(label);
    }
    /* `prepare` draws them: a page that evaluates layouts has them from there. */
    function addBoxes(prepare) {
        kinds.boxes = {name: "Boxes", prepare, told: "the leaves of the hierarchy that finds what a jet meets, each of " +
            "eight triangles at most"};
        addBox("boxes");
    }
    function addLayers() {
        const told = about.models.filter((model) => model.leaves);
        Object.keys(kinds).forEach(addBox);
        if (told.length)
            addBoxes(() => told.forEach((model) => uploadBoxes(model, model.leaves)));
    }
    const toggleLayer = (key) => kinds[key] && switchLayer(key, !state.layers[key]);
    return {addLayers, addBoxes, toggleLayer};
}
