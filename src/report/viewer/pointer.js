/* Mouse and fingers on the canvas. */
function makePointer(view) {
    "use strict";
    const {canvas, turn, shift, zoom, ask} = view;

    function bindPointer() {
        const held = new Map();
        let moved = 0;
        canvas.addEventListener("pointerdown", (event) => {
            canvas.setPointerCapture(event.pointerId);
            held.set(event.pointerId, event);
            moved = 0;
        });
        canvas.addEventListener("pointermove", (event) => {
            const before = held.get(event.pointerId);
            if (!before)
                return;
            const x = event.clientX - before.clientX, y = event.clientY - before.clientY;
            moved += Math.hypot(x, y);
            const other = [...held.values()].find((finger) => finger.pointerId !== event.pointerId);
            const apart = (finger) => Math.hypot(finger.clientX - other.clientX, finger.clientY - other.clientY) || 1;
            if (other)
                zoom(apart(before) / apart(event));
            else if (event.buttons & 6 || event.shiftKey)
                shift(x / canvas.clientHeight, y / canvas.clientHeight);
            else
                turn(-x / 150, y / 150);
            held.set(event.pointerId, event);
        });
        canvas.addEventListener("pointerup", (event) => {
            held.delete(event.pointerId);
            const box = canvas.getBoundingClientRect();
            if (moved < 4)
                ask(event.clientX - box.left, event.clientY - box.top);
        });
        canvas.addEventListener("pointercancel", (event) => held.delete(event.pointerId));
        canvas.addEventListener("contextmenu", (event) => event.preventDefault());
        /* the page scrolls as ever until the canvas is asked for */
        canvas.addEventListener("wheel", (event) => {
            if (document.activeElement !== canvas)
                return;
            event.preventDefault();
            zoom(Math.exp(event.deltaY / 600));
        }, {passive: false});
    }
    return {bindPointer};
}
