/* Surfaces, sprays and colours on their way to the graphics unit. */
function makeUploads(view) {
    "use strict";
    const {gl, TILE, WIDE, surfaceProgram, lineProgram, coloursOf} = view;

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

    function uploadModel(model) {
        const {edge, pages, layers} = model;
        model.buffer = gl.createVertexArray();
        gl.bindVertexArray(model.buffer);
        gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
        gl.bufferData(gl.ARRAY_BUFFER, model.vertex.packed, gl.STATIC_DRAW);
        [["place", 3, 0], ["spot", 2, 6]].forEach(([name, width, offset]) => {
            const slot = gl.getAttribLocation(surfaceProgram.made, name);
            gl.enableVertexAttribArray(slot);
            gl.vertexAttribPointer(slot, width, gl.UNSIGNED_SHORT, true, 12, offset);
        });
        gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
        gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, model.corners, gl.STATIC_DRAW);
        uploadPages(model);
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

    /* The rims of all sprays, and lines to them from their nozzles. */
    function uploadLines(design) {
        const points = [];
        design.nozzles.forEach((nozzle) => nozzle.sprays.forEach(({from, rim}) => {
            for (let i = 0; i < rim.length; i++) {
                points.push(...rim[i], ...rim[(i + 1) % rim.length]);
                if (i % 4 === 0)
                    points.push(...from, ...rim[i]);
            }
        }));
        design.linePoints = points.length / 3;
        design.lines = gl.createVertexArray();
        gl.bindVertexArray(design.lines);
        gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
        gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(points), gl.STATIC_DRAW);
        const slot = gl.getAttribLocation(lineProgram.made, "place");
        gl.enableVertexAttribArray(slot);
        gl.vertexAttribPointer(slot, 3, gl.FLOAT, false, 0, 0);
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
    return {uploadModel, uploadLines, uploadColours};
}
