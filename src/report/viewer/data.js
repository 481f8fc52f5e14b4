/* The data that model.c and design.c write into the page. */
async function readData() {
    "use strict";
    const about = JSON.parse(document.getElementById("viewer-model").textContent);

    /* Two letters of 91 are 13 bits, the least first; what they hold is deflated. */
    const letters = "!#$%&'()*+,-./0123456789:;=>?@ABCDEFGHIJKLMNOPQRSTUVWXYZ[]^_`abcdefghijklmnopqrstuvwxyz{|}~";
    const digits = new Uint8Array(128);
    [...letters].forEach((letter, value) => (digits[letter.charCodeAt(0)] = value));
    function bytesOf(text) {
        const from = text.indexOf(" ") + 1, bytes = new Uint8Array(Number(text.slice(0, from)));
        for (let i = from, held = 0, bits = 0, at = 0; i < text.length; i += 2) {
            held |= (digits[text.charCodeAt(i)] + 91 * digits[text.charCodeAt(i + 1)]) << bits;
            for (bits += 13; bits >= 8; bits -= 8, held >>>= 8)
                bytes[at++] = held;
        }
        return bytes;
    }
    async function inflated(text) {
        const bytes = bytesOf(text);
        const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
        return new Response(stream).arrayBuffer();
    }

    /* For each layer a picture of the pages, a patch's number + 1 in every pixel that it has, 0 elsewhere. */
    function readPages(model, take) {
        const rows = take(Uint32Array, model.runs, true);
        const starts = take(Uint16Array, model.runs, false);
        const counts = take(Uint16Array, model.runs, false);
        return Array.from({length: model.layers}, () => {
            const patches = take(Uint32Array, model.pixels, true);
            const page = new Uint32Array(model.pages * model.edge * model.edge);
            for (let run = 0, pixel = 0; run < model.runs; run++)
                for (let k = 0; k < counts[run]; k++)
                    page[rows[run] * model.edge + starts[run] + k] = patches[pixel++];
            return page;
        });
    }

    /* Low and high x, y, z of each, m. */
    function readBoxes({count, low, high}, take) {
        const boxes = new Float64Array(6 * count);
        for (let k = 0; k < 6; k++)
            take(Uint16Array, count, true).forEach((part, i) =>
                (boxes[6 * i + k] = low[k % 3] + (part * (high[k % 3] - low[k % 3])) / 65535));
        return boxes;
    }

    const hasJets = about.quantities.some(({key}) => key === "jets");
    async function readModel(model) {
        const take = surfaces.reader(await inflated(model.data)), coder = makeCoder(bytesOf(model.coded));
        delete model.data;
        delete model.coded;
        surfaces.read(model, take, coder);
        model.page = readPages(model, take);
        const patches = makePatches(model);
        for (const design of model.designs) {
            patches.readDesign(design, coder, hasJets);
            design.nozzles.forEach((nozzle) => sprays.read(nozzle, about.up, take));
            design.model = model;
        }
        model.leaves = model.leaves && readBoxes(model.leaves, take);
    }

    await Promise.all(about.models.map(readModel));
    const designs = about.models.flatMap((model) => model.designs).sort((a, b) => a.index - b.index);
    return {about, designs, inflated};
}
