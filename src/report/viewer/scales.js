/* What a byte of a quantity means, where on the colour bar that is, and what colour. */
function makeScales(view) {
    "use strict";
    const {about, state} = view;

    const HALF = 128; /* of a byte of share: covered */
    const SCALES = ["log", "linear", "stepped"];

    /* All 256 colours, three bytes each. Cividis (Nuñez, Anderton and Renslow, PLoS ONE 13(7), 2018, under CC0) is for
     * who sees no red or no green: knots, each its number and its red, green and blue; straight lines between them stay
     * within 2/255 of it. */
    const bytesOf = (text) => Uint8Array.from(text.match(/../g), (digits) => parseInt(digits, 16));
    function fromKnots(knots) {
        const colours = new Uint8Array(3 * 256);
        for (let i = 0, knot = 0; i < 256; i++) {
            while (knots[knot + 4] < i)
                knot += 4;
            const share = (i - knots[knot]) / (knots[knot + 4] - knots[knot]);
            for (let k = 1; k < 4; k++)
                colours[3 * i + k - 1] = Math.round((1 - share) * knots[knot + k] + share * knots[knot + 4 + k]);
        }
        return colours;
    }
    const maps = {viridis: bytesOf(about.palette), cividis: fromKnots(bytesOf("0000224e1300306f1500317017013271" +
        "1c123570221e3a6f3436466c54565c6d7e7b7a78938f8a78b3aea371cdc9b965e8e7d150f3f3db42fbfde334fffee838"))};
    const palette = () => maps[state.map];

    /* The value that a byte stands for, NaN for none; the ends of the scale mean that or beyond. */
    function valueOf(quantity, byte) {
        if (byte === 0)
            return NaN;
        if (quantity.counts)
            return byte;
        const t = (byte - 1) / 254;
        return quantity.log ? quantity.low * (quantity.high / quantity.low) ** t
                            : quantity.low + t * (quantity.high - quantity.low);
    }

    /* Where on the colour map the colour is of what is up so many steps of a stepped scale. */
    const stepAt = (quantity, steps) => 0.15 + (0.7 * steps) / quantity.steps.length;

    /* Where on the colour bar, 0 to 1. */
    function shade(quantity, value) {
        const [low, high] = quantity.shown;
        const scale = state.scales[quantity.key];
        if (scale === "stepped")
            return stepAt(quantity, quantity.steps.filter((step) => value >= step).length);
        const t = scale === "log" && low > 0 ? Math.log(value / low) / Math.log(high / low)
                                             : (value - low) / (high - low);
        return Math.min(Math.max(t, 0), 1);
    }

    function ticksOf(quantity) {
        const [from, to] = quantity.shown;
        if (quantity.counts)
            return Array.from({length: to}, (_, i) => i + 1).filter((i) => i % Math.ceil(to / 8) === 0 || i === 1);
        if (state.scales[quantity.key] === "stepped")
            return quantity.steps;
        if (state.scales[quantity.key] === "log" && from > 0) {
            /* of many decades whole ones alone */
            const steps = to / from > 200 ? [1] : [1, 2, 5];
            return [...Array(25).keys()].flatMap((power) => steps.map((step) => step * 10 ** (power - 12)))
                .filter((value) => value >= from * (1 - 1e-9) && value <= to * (1 + 1e-9));
        }
        const step = geometry.roundStep((to - from) / 4), first = Math.ceil(from / step - 1e-9);
        const whole = Array.from({length: Math.floor(to / step + 1e-9) - first + 1}, (_, i) => (first + i) * step);
        return first * step - from > step / 2 ? [from, ...whole] : whole;
    }

    /* Whether some of what is shown lies below, and above, the bar's ends, whose colours it has. */
    function beyond(quantity) {
        const {key, shown: [low, high]} = quantity;
        let least = Infinity, most = 0;
        if (key in state.scales && state.scales[key] !== "stepped")
            for (const {values, share} of state.shown)
                values[key].forEach((byte, i) => {
                    if (byte > 0 && share[i] >= HALF)
                        [least, most] = [Math.min(least, byte), Math.max(most, byte)];
                });
        return [valueOf(quantity, Math.min(least, 255)) < low * (1 - 1e-6), valueOf(quantity, most) > high * (1 + 1e-6)];
    }

    /* Scales that a quantity may have: by ratios where it does not begin at 0, stepped where something is asked. */
    const admits = (quantity, scale) => quantity.key in state.scales &&
        (scale === "linear" || (scale === "log" ? quantity.shown[0] > 0 || quantity.log : quantity.steps.length > 0));

    /* To as many digits as keep it on the side of what is asked where it is, which the verdict beside it goes by. */
    function rounded(value, digits, asked, atMost) {
        const meets = (told) => (atMost ? told <= asked : told >= asked);
        let told = Number(value.toPrecision(digits));
        for (let more = digits + 1; asked > 0 && meets(told) !== meets(value) && more < 17; more++)
            told = Number(value.toPrecision(more));
        return told;
    }

    /* The same byte in words; `asked` by the design's criterion, if anything. Steps of equal ratios are of 4.6 %, which
     * two digits say. */
    function figure(quantity, byte, asked) {
        if (byte === 0)
            return "none";
        const value = valueOf(quantity, byte), steps = quantity.log && !quantity.whole;
        const told = quantity.whole ? Math.round(value) : rounded(value, steps ? 2 : 3, asked, quantity.atMost);
        const beyond = quantity.whole ? "" : byte === 1 && quantity.log ? "at most " : byte === 255 ? "at least "
            : steps ? "about " : "";
        return `${beyond}${quantity.whole ? Number(told.toPrecision(3)) : told} ${quantity.unit}`.trimEnd();
    }
    return {SCALES, HALF, MAPS: Object.keys(maps), palette, valueOf, stepAt, shade, ticksOf, beyond, admits, figure};
}
