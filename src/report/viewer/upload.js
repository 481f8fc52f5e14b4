/* Surfaces, sprays and colours on their way to the graphics unit. */
function makeUploads(view) {
    "use strict";
    const {gl, TILE, WIDE, chartHues, surfaceProgram, lineProgram, coloursOf} = view;

    /* Triangles' rims may come to lie in the pixel beside theirs by rounding: it gets their patch. */
    function spread(page, edge, pages) {
        const before = page.slice();
        for (let row = 0; row < edge * pages; row++)
            for (let x = 0; x < edge; x++) {
                const here = row * edge + x;
                for (let k = 0; k < 9 && !page[here]; k++) {
                    const there = here + ((k % 3) - 1) + (Math.floor(k / 3) - 1) * edge;
                    page[here] = before[there] || 0;
                }
            }
        return page;
    }

    const ATTRIBUTES = [["place", 3, 0, true], ["spot", 2, 6, true], ["hue", 1, 10, false]];
    function uploadVertices(packed) {
        const made = gl.createVertexArray(), buffer = gl.createBuffer();
        gl.bindVertexArray(made);
        gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
        gl.bufferData(gl.ARRAY_BUFFER, packed, gl.STATIC_DRAW);
        ATTRIBUTES.forEach(([name, width, offset, parts]) => {
            const slot = gl.getAttribLocation(surfaceProgram.made, name);
            gl.enableVertexAttribArray(slot);
            gl.vertexAttribPointer(slot, width, gl.UNSIGNED_SHORT, parts, 12, offset);
        });
        return [made, buffer];
    }

    function uploadModel(model) {
        [model.buffer, model.filled] = uploadVertices(model.vertex.packed);
        gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
        gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, model.corners, gl.STATIC_DRAW);
        uploadPages(model);
    }

    /* The corners one after the other, so that each knows which of its triangle it is. */
    function uploadWires(model) {
        const {packed} = model.vertex, all = new Uint16Array(6 * model.corners.length);
        model.corners.forEach((vertex, i) => {
            for (let k = 0; k < 6; k++)
                all[6 * i + k] = packed[6 * vertex + k];
        });
        if (model.wires)
            gl.deleteVertexArray(model.wires);
        [model.wires] = uploadVertices(all);
    }

    function uploadHues(model) {
        if (model.hued)
            return;
        model.hued = true;
        charts.choose(model, chartHues.hues.length);
        gl.bindVertexArray(null);
        gl.bindBuffer(gl.ARRAY_BUFFER, model.filled);
        gl.bufferSubData(gl.ARRAY_BUFFER, 0, model.vertex.packed);
        if (model.wires)
            uploadWires(model);
    }

    function uploadPages(model) {
        const {edge, pages, layers} = model, tiles = Math.ceil(edge / TILE), most = Math.min(edge, TILE);
        model.tiles = tiles;
        model.texture = gl.createTexture();
        gl.bindTexture(gl.TEXTURE_2D_ARRAY, model.texture);
        gl.texStorage3D(gl.TEXTURE_2D_ARRAY, 1, gl.R32UI, most, most, pages * layers * tiles * tiles);
        gl.pixelStorei(gl.UNPACK_ROW_LENGTH, edge);
        model.page.forEach((page, layer) => {
            const shown = spread(page.slice(), edge, pages);
            for (let i = 0; i < pages * tiles * tiles; i++) {
                const x = (i % tiles) * TILE, y = (Math.floor(i / tiles) % tiles) * TILE;
                const from = (Math.floor(i / tiles / tiles) * edge + y) * edge + x;
                gl.texSubImage3D(gl.TEXTURE_2D_ARRAY, 0, 0, 0, layer * pages * tiles * tiles + i,
                                 Math.min(most, edge - x), Math.min(most, edge - y), 1, gl.RED_INTEGER,
                                 gl.UNSIGNED_INT, shown, from);
            }
        });
        gl.pixelStorei(gl.UNPACK_ROW_LENGTH, 0);
        gl.texParameteri(gl.TEXTURE_2D_ARRAY, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
        gl.texParameteri(gl.TEXTURE_2D_ARRAY, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    }

    function uploadPoints(points) {
        const made = gl.createVertexArray(), slot = gl.getAttribLocation(lineProgram.made, "place");
        const buffer = (made.buffer = gl.createBuffer());
        gl.bindVertexArray(made);
        gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
        gl.bufferData(gl.ARRAY_BUFFER, Float32Array.from(points), gl.STATIC_DRAW);
        gl.enableVertexAttribArray(slot);
        gl.vertexAttribPointer(slot, 3, gl.FLOAT, false, 0, 0);
        return made;
    }

    /* The rims of all sprays, lines to them from their nozzles, and jets nozzle by nozzle. */
    function uploadLines(design) {
        let points = [];
        design.nozzles.forEach((nozzle) => nozzle.sprays.forEach(({from, rim}) => {
            for (let i = 0; i < rim.length; i++) {
                points.push(...rim[i], ...rim[(i + 1) % rim.length]);
                if (i % 4 === 0)
                    points.push(...from, ...rim[i]);
            }
        }));
        design.rimPoints = points.length / 3;
        design.jets = design.nozzles.map(({direct, bounced}) => {
            const first = points.length / 3;
            points = points.concat(direct, bounced);
            return {first, direct: direct.length / 3, bounced: bounced.length / 3};
        });
        if (design.lines) {
            gl.deleteBuffer(design.lines.buffer);
            gl.deleteVertexArray(design.lines);
        }
        design.lines = uploadPoints(points);
    }

    /* The edges of boxes: low and high x, y, z of each. */
    function uploadBoxes(model, boxes) {
        const points = new Float32Array(boxes.length * 12);
        let at = 0;
        for (let box = 0; box < boxes.length; box += 6)
            for (let axis = 0; axis < 3; axis++)
                for (let side = 0; side < 8; side++) { /* both ends of four edges along the axis */
                    const [i, j] = [(axis + 1) % 3, (axis + 2) % 3];
                    points[at + axis] = boxes[box + axis + 3 * (side & 1)];
                    points[at + i] = boxes[box + i + 3 * (side >> 1 & 1)];
                    points[at + j] = boxes[box + j + 3 * (side >> 2)];
                    at += 3;
                }
        model.boxes = {lines: uploadPoints(points), points: at / 3};
    }

    function uploadColours(design) {
        const colours = coloursOf(design);
        design.colours = design.colours || gl.createTexture();
        gl.bindTexture(gl.TEXTURE_2D, design.colours);
        gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, WIDE, colours.length / 4 / WIDE, 0, gl.RGBA, gl.UNSIGNED_BYTE,
                      colours);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    }
    return {uploadModel, uploadWires, uploadHues, uploadLines, uploadBoxes, uploadColours};
}
