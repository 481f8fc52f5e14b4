/* What the colours mean. */
function makeBar(view) {
    "use strict";
    const {about, state, bar, coverage, difference, chartHues, SCALES, palette, coloured, base, stepAt, shade,
           ticksOf, beyond, admits} = view;
    const {element} = widgets;

    function swatch(style, text) {
        const made = element("span", {class: "swatch-box"});
        made.style.background = style;
        return element("span", {class: "entry"}, made, ` ${text}`);
    }
    const HATCH = "repeating-linear-gradient(45deg,#c42636 0 2px,#faf8f5 2px 7px)";
    const rgb = (colour) => `rgb(${colour})`;

    /* One field for each step, of equal width. */
    function stepsOf(quantity, colourAt) {
        const fields = quantity.steps.length + 1;
        return Array.from({length: fields}, (_, i) =>
            `${colourAt(stepAt(quantity, i))} ${(100 * i) / fields}% ${(100 * (i + 1)) / fields}%`);
    }

    /* What lies beyond an end has its colour: the tick there says so. */
    function ramp(quantity) {
        const colourAt = (t) => rgb(palette().subarray(3 * Math.round(255 * t), 3 * Math.round(255 * t) + 3));
        const strip = element("span", {class: "ramp"}), stepped = state.scales[quantity.key] === "stepped";
        const stops = stepped ? stepsOf(quantity, colourAt)
            : Array.from({length: 33}, (_, i) => colourAt(i / 32));
        strip.style.background = `linear-gradient(90deg,${stops})`;
        const ticks = ticksOf(quantity), [below, above] = beyond(quantity);
        strip.append(...ticks.map((value, i) => {
            const sign = below && i === 0 ? "≤ " : above && i === ticks.length - 1 ? "≥ " : "";
            const tick = element("i", {}, `${sign}${Number(value.toPrecision(3))}`);
            tick.style.left = `${100 * (stepped ? (i + 1) / (ticks.length + 1) : shade(quantity, value))}%`;
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
            ? `${quantity.name} in ${quantity.steps.length + 1} colours of ${state.map}, stepped at ` +
                `${quantity.steps.map(short).join(" and ")}.`
            : `${quantity.name} from ${short(low)} to ${short(high)}, ${scale === "log" ? "logarithmic" : "linear"}, ` +
                `in ${state.map}.`;
    }
    return {drawBar, barText};
}
