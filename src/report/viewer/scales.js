/* What a byte of a quantity means, and where on the colour bar that is. */
function makeScales(view) {
    "use strict";
    const {about, state} = view;

    const palette = Uint8Array.from(about.palette.match(/../g), (digits) => parseInt(digits, 16));

    const SCALES = ["log", "linear", "stepped"];

    /* The value that a byte stands for, NaN for none; the ends of the scale mean that or beyond. */
    function valueOf(quantity, byte) {
        if (byte === 0)
            return NaN;
        const t = (byte - 1) / 254;
        return quantity.log ? quantity.low * (quantity.high / quantity.low) ** t
                            : quantity.low + t * (quantity.high - quantity.low);
    }

    /* Where on the colour bar, 0 to 1. */
    function shade(quantity, value) {
        const [low, high] = quantity.shown;
        const scale = state.scales[quantity.key];
        if (scale === "stepped")
            return value < (quantity.step || low) ? 0.15 : 0.85;
        const t = scale === "log" && low > 0 ? Math.log(value / low) / Math.log(high / low)
                                             : (value - low) / (high - low);
        return Math.min(Math.max(t, 0), 1);
    }

    function ticksOf(quantity) {
        const [from, to] = quantity.shown;
        if (state.scales[quantity.key] === "log" && from > 0)
            return [...Array(25).keys()].flatMap((power) => [1, 2, 5].map((step) => step * 10 ** (power - 12)))
                .filter((value) => value >= from * (1 - 1e-9) && value <= to * (1 + 1e-9));
        return [0, 0.25, 0.5, 0.75, 1].map((t) => from + t * (to - from));
    }

    /* The same byte in words. */
    function figure(quantity, byte) {
        if (byte === 0)
            return "none";
        const value = valueOf(quantity, byte);
        const beyond = byte === 1 && quantity.log ? "at most " : byte === 255 ? "at least " : "";
        return `${beyond}${Number(value.toPrecision(3))} ${quantity.unit}`;
    }
    return {SCALES, palette, valueOf, shade, ticksOf, figure};
}
