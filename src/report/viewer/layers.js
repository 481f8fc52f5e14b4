/* What may be drawn over the colours: edges of triangles, jets, boxes. */
function makeLayers(view) {
    "use strict";
    const {state, designs, about, layers, tell, redraw, uploadWires} = view, {checkbox} = widgets;
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
    /* For live.js: one more. */
    function addLayer(key, kind) {
        kinds[key] = kind;
        addBox(key);
    }
    const addLayers = () => Object.keys(kinds).forEach(addBox);
    const toggleLayer = (key) => kinds[key] && switchLayer(key, !state.layers[key]);
    return {addLayers, addLayer, toggleLayer};
}
