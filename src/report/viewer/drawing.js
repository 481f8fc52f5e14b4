/* Designs side by side on the canvas. */
function makeDrawing(view) {
    "use strict";
    const {gl, canvas, state, chartHues, surfaceProgram, lineProgram, cutPlane, frame, projection, place, uploadColours,
           uploadHues} = view;
    const {add} = geometry;
    const NOWHERE = [0, 0, 0, 1e30]; /* cut */
    const OUTLINE = [0.06, 0.13, 0.17, 1], JET = [0.95, 0.25, 0.65, 1], BOUNCED = [1, 0.6, 0.1, 1];
    const BOX = [0.25, 0.05, 0.25, 0.35];

    /* The nozzle chosen in a design, -1 for none. */
    const chosenOf = (design) => (state.nozzle && state.nozzle.design === design ? state.nozzle.index : -1);

    function setSurface(design, matrix, seen) {
        const {model} = design;
        gl.useProgram(surfaceProgram.made);
        gl.uniformMatrix4fv(surfaceProgram.view, false, matrix);
        gl.uniform3fv(surfaceProgram.low, model.low);
        gl.uniform3fv(surfaceProgram.extent, add(model.high, model.low, -1));
        gl.uniform1f(surfaceProgram.edge, model.edge);
        gl.uniform1i(surfaceProgram.tiles, model.tiles);
        gl.uniform4fv(surfaceProgram.cut, cutPlane());
        gl.uniform3fv(surfaceProgram.eye, seen.eye);
        gl.uniform1i(surfaceProgram.patches, 0);
        gl.uniform1i(surfaceProgram.colours, 1);
        gl.uniform1i(surfaceProgram.wires, state.layers.wires);
        gl.uniform1i(surfaceProgram.charts, state.quantity === chartHues && chosenOf(design) < 0);
        gl.uniform3fv(surfaceProgram.hues, chartHues.hues.flat().map((level) => level / 255));
    }

    function drawSurface(design, matrix, seen) {
        const {model} = design, {wires} = state.layers;
        setSurface(design, matrix, seen);
        gl.activeTexture(gl.TEXTURE1);
        gl.bindTexture(gl.TEXTURE_2D, design.colours);
        gl.activeTexture(gl.TEXTURE0);
        gl.bindTexture(gl.TEXTURE_2D_ARRAY, model.texture);
        gl.bindVertexArray(wires ? model.wires : model.buffer);
        (model.twoSided ? gl.disable : gl.enable).call(gl, gl.CULL_FACE);
        for (const draw of visibleDraws(model)) {
            gl.uniform1i(surfaceProgram.page, draw.page < 0 ? -1 : draw.layer * model.pages + draw.page);
            if (wires)
                gl.drawArrays(gl.TRIANGLES, 3 * draw.first, 3 * draw.count);
            else
                gl.drawElements(gl.TRIANGLES, 3 * draw.count, gl.UNSIGNED_INT, 12 * draw.first);
        }
    }

    const partKey = (model, part) => model.parts[part].name;
    const visibleDraws = (model) => model.draws.filter((draw) => !state.hidden.has(partKey(model, draw.part)));

    function drawSome(tint, cut, first, count) {
        gl.uniform4fv(lineProgram.tint, tint);
        gl.uniform4fv(lineProgram.cut, cut);
        gl.drawArrays(gl.LINES, first, count);
    }

    /* Outlines of sprays whole, jets and boxes cut as the surface is. */
    function drawLines(design, matrix) {
        const chosen = chosenOf(design);
        gl.useProgram(lineProgram.made);
        gl.uniformMatrix4fv(lineProgram.view, false, matrix);
        gl.bindVertexArray(design.lines);
        drawSome(OUTLINE, NOWHERE, 0, design.rimPoints);
        design.jets.forEach(({first, direct, bounced}, i) => {
            if (chosen === i || (chosen < 0 && state.layers.jets)) {
                drawSome(JET, cutPlane(), first, direct);
                drawSome(BOUNCED, cutPlane(), first + direct, bounced);
            }
        });
        if (state.layers.boxes && design.model.boxes) {
            gl.bindVertexArray(design.model.boxes.lines);
            drawSome(BOX, cutPlane(), 0, design.model.boxes.points);
        }
    }

    function draw() {
        /* nothing to draw on while it is not shown, as in print */
        if (!canvas.clientWidth || !canvas.clientHeight)
            return;
        const ratio = Math.min(window.devicePixelRatio || 1, 2);
        canvas.width = Math.round(canvas.clientWidth * ratio);
        canvas.height = Math.round(canvas.clientHeight * ratio);
        gl.enable(gl.DEPTH_TEST);
        gl.enable(gl.BLEND);
        gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
        gl.clearColor(1, 1, 1, 1);
        gl.disable(gl.SCISSOR_TEST);
        gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
        gl.enable(gl.SCISSOR_TEST);
        const seen = frame();
        state.shown.forEach((design, i) => {
            const {left, width, height} = place(i);
            const box = [left * ratio, 0, width * ratio, height * ratio].map(Math.round);
            gl.viewport(...box);
            gl.scissor(...box);
            design.matrix = projection(seen, width / height);
            drawSurface(design, design.matrix, seen);
            drawLines(design, design.matrix);
        });
        view.overlays.forEach((move) => move());
    }
    let drawing = false;
    function redraw() {
        if (!drawing)
            requestAnimationFrame(() => ((drawing = false), draw()));
        drawing = true;
    }
    function recolour() {
        if (state.quantity === chartHues)
            state.shown.forEach(({model}) => uploadHues(model));
        state.shown.forEach(uploadColours);
        view.drawBar();
        redraw();
    }
    return {visibleDraws, partKey, draw, redraw, recolour};
}
