/* What colour each patch has. */
function makeColours(view) {
    "use strict";
    const {about, state, flux, coverage, difference, reached, HALF, palette, valueOf, shade} = view;

    function setColour(colours, i, red, green, blue, kind) {
        colours.set([red, green, blue, kind], 4 * i);
    }
    const PLAIN = 255, UNCOVERED = 0, MARKED = 128; /* kinds, as the fragment shader tells them */

    function setShade(colours, i, t, kind) {
        const at = 3 * Math.round(255 * t), map = palette();
        setColour(colours, i, map[at], map[at + 1], map[at + 2], kind);
    }

    const coloured = () => (state.nozzle ? flux : state.quantity);
    const base = () => state.shown.find((design) => design.manual) || state.shown[0];

    function colourDifference(colours, design, from) {
        for (let i = 0; i < design.share.length; i++) {
            const before = from.share[i] >= HALF, now = design.share[i] >= HALF;
            if (now && !before)
                setColour(colours, i, 0, 140, 120, PLAIN);
            else if (before && !now)
                setColour(colours, i, 224, 120, 20, PLAIN);
            else
                setColour(colours, i, 205, 212, 220, now ? PLAIN : UNCOVERED);
        }
    }

    function colourQuantity(colours, design, quantity, bytes, keepsHatch) {
        for (let i = 0; i < bytes.length; i++) {
            const covered = design.share[i] >= HALF;
            if (keepsHatch && !covered)
                setColour(colours, i, 0, 0, 0, UNCOVERED);
            else if (design.film[i] && quantity === flux)
                setColour(colours, i, ...about.film, PLAIN);
            else if (bytes[i] === 0)
                setColour(colours, i, 222, 226, 230, PLAIN);
            else
                setShade(colours, i, shade(quantity, valueOf(quantity, bytes[i])), PLAIN);
        }
    }

    function nozzlesOf(design) {
        const counts = new Uint8ClampedArray(design.share.length);
        design.nozzles.forEach((nozzle) => nozzle.flux.forEach((byte, i) => (counts[i] += byte > 0)));
        return counts;
    }

    /* A colour for each patch of a design, RGBA, of a texture WIDE pixels wide. */
    const WIDE = 2048;
    function coloursOf(design) {
        const colours = new Uint8Array(4 * WIDE * Math.max(1, Math.ceil(design.share.length / WIDE)));
        const quantity = state.quantity;
        if (state.nozzle && state.nozzle.design === design)
            colourQuantity(colours, design, flux, design.nozzles[state.nozzle.index].flux, false);
        else if (quantity === difference && design.model === base().model && design !== base())
            colourDifference(colours, design, base());
        else if (quantity === coverage || quantity === difference)
            design.share.forEach((share, i) => setColour(colours, i, 70, 130, 180, share >= HALF ? PLAIN : UNCOVERED));
        else if (quantity === reached)
            colourQuantity(colours, design, quantity, nozzlesOf(design), false);
        else if (quantity.shown)
            colourQuantity(colours, design, quantity, design.values[quantity.key], true);
        if (state.shadow && state.shadow.design === design)
            design.shadowOf.forEach((number, i) => {
                if (number === state.shadow.index + 1)
                    colours[4 * i + 3] = MARKED;
            });
        return colours;
    }
    return {WIDE, coloured, base, coloursOf};
}
