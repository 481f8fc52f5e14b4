/* What the colours mean. */
function makeBar(view) {
    "use strict";
    const {about, state, bar, coverage, difference, chartHues, SCALES, palette, coloured, base, shade, ticksOf,
           admits} = view;
    const {element} = widgets;

    function swatch(style, text) {
        const made = element("span", {class: "swatch-box"});
        made.style.background = style;
        return element("span", {class: "entry"}, made, ` ${text}`);
    }
    const HATCH = "repeating-linear-gradient(45deg,#c42636 0 2px,#faf8f5 2px 7px)";
    const rgb = (colour) => `rgb(${colour})`;

    function ramp(quantity) {
        const colours = palette(), stops = [...Array(33).keys()].map((i) => 3 * Math.round((i * 255) / 32))
            .map((at) => rgb(colours.subarray(at, at + 3)));
        const strip = element("span", {class: "ramp"}), stepped = state.scales[quantity.key] === "stepped";
        strip.style.background = stepped
            ? `linear-gradient(90deg,${stops[5]} 50%,${stops[27]} 50%)` : `linear-gradient(90deg,${stops})`;
        strip.append(...ticksOf(quantity).map((value) => {
            const tick = element("i", {}, String(Number(value.toPrecision(3))));
            tick.style.left = `${100 * (stepped ? 0.5 : shade(quantity, value))}%`;
            return tick;
        }));
        const unit = quantity.unit ? `, ${quantity.unit}` : "";
        return element("span", {class: "entry"}, `${quantity.name}${unit} `, strip);
    }

    function keysOf(quantity) {
        const uncovered = swatch(HATCH, "not covered"), none = swatch("rgb(222,226,230)", "none");
        if (quantity === chartHues)
            return [element("span", {class: "entry"}, "each chart in one of "),
                    ...chartHues.hues.map((hue, i) => swatch(rgb(hue), String(i + 1)))];
        if (quantity === difference)
            return [element("span", {class: "entry"}, `against ${base().name}`), uncovered,
                    swatch("rgb(0,140,120)", "gained"), swatch("rgb(224,120,20)", "lost"),
                    swatch("rgb(205,212,220)", "covered by both")];
        if (state.nozzle || quantity.counts)
            return [ramp(quantity), none, ...(quantity.counts ? [] : [uncovered])];
        return quantity === coverage ? [uncovered, swatch("rgb(70,130,180)", "covered")] : [ramp(quantity), uncovered];
    }

    function drawBar() {
        const quantity = coloured(), scale = state.scales[quantity.key];
        view.scaleList.disabled = !scale;
        [...view.scaleList.options].forEach((option, i) => (option.disabled = !admits(quantity, SCALES[i])));
        view.scaleList.selectedIndex = SCALES.indexOf(scale);
        bar.replaceChildren(...keysOf(quantity), swatch(rgb(about.grey), "no cleaning asked"));
    }

    /* The same in words, for who listens. */
    function barText() {
        const quantity = coloured(), [low, high] = quantity.shown || [], scale = state.scales[quantity.key];
        const short = (value) => `${Number(value.toPrecision(3))} ${quantity.unit}`.trimEnd();
        if (!quantity.shown)
            return `${quantity.name}.`;
        return scale === "stepped"
            ? `${quantity.name} in two colours of ${state.map}, stepped at ${short(quantity.step)}.`
            : `${quantity.name} from ${short(low)} to ${short(high)}, ${scale === "log" ? "logarithmic" : "linear"}, ` +
                `in ${state.map}.`;
    }
    return {drawBar, barText};
}
