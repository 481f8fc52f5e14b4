/* Designs side by side on the canvas. */
function makeDrawing(view) {
    "use strict";
    const {gl, canvas, state, surfaceProgram, lineProgram, cutPlane, frame, projection, place, uploadColours} = view;
    const {add} = geometry;

    function drawSurface(design, matrix, seen) {
        const model = design.model;
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
        gl.activeTexture(gl.TEXTURE1);
        gl.bindTexture(gl.TEXTURE_2D, design.colours);
        gl.activeTexture(gl.TEXTURE0);
        gl.bindTexture(gl.TEXTURE_2D_ARRAY, model.texture);
        gl.bindVertexArray(model.buffer);
        (model.twoSided ? gl.disable : gl.enable).call(gl, gl.CULL_FACE);
        for (const draw of visibleDraws(model)) {
            gl.uniform1i(surfaceProgram.page, draw.page < 0 ? -1 : draw.layer * model.pages + draw.page);
            gl.drawElements(gl.TRIANGLES, 3 * draw.count, gl.UNSIGNED_INT, 12 * draw.first);
        }
    }

    const partKey = (model, part) => model.parts[part].name;
    const visibleDraws = (model) => model.draws.filter((draw) => !state.hidden.has(partKey(model, draw.part)));

    function drawLines(design, matrix) {
        gl.useProgram(lineProgram.made);
        gl.uniformMatrix4fv(lineProgram.view, false, matrix);
        gl.uniform3f(lineProgram.tint, 0.06, 0.13, 0.17);
        gl.bindVertexArray(design.lines);
        gl.drawArrays(gl.LINES, 0, design.linePoints);
    }

    function draw() {
        const ratio = Math.min(window.devicePixelRatio || 1, 2);
        canvas.width = Math.max(1, Math.round(canvas.clientWidth * ratio));
        canvas.height = Math.max(1, Math.round(canvas.clientHeight * ratio));
        gl.enable(gl.DEPTH_TEST);
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
        view.moveLabels();
    }
    let drawing = false;
    function redraw() {
        if (!drawing)
            requestAnimationFrame(() => ((drawing = false), draw()));
        drawing = true;
    }
    function recolour() {
        state.shown.forEach(uploadColours);
        view.drawBar();
        redraw();
    }
    return {visibleDraws, partKey, draw, redraw, recolour};
}
