/* What the colours mean. */
function makeBar(view) {
    "use strict";
    const {about, state, bar, SCALES, palette, coverage, difference, coloured, base, shade, ticksOf} = view;
    const {element} = widgets;

    function swatch(style, text) {
        const made = element("span", {class: "swatch-box"});
        made.style.background = style;
        return element("span", {class: "entry"}, made, ` ${text}`);
    }
    const HATCH = "repeating-linear-gradient(45deg,#c42636 0 2px,#faf8f5 2px 7px)";
    function drawBar() {
        const quantity = coloured();
        view.scaleList.disabled = !(quantity.key in state.scales);
        view.scaleList.selectedIndex = SCALES.indexOf(state.scales[quantity.key]);
        const keys = [swatch(HATCH, "not covered")];
        if (quantity === difference)
            keys.push(swatch("rgb(0,140,120)", "gained"), swatch("rgb(224,120,20)", "lost"),
                      swatch("rgb(205,212,220)", "covered by both"));
        else if (quantity === coverage)
            keys.push(swatch("rgb(70,130,180)", "covered"));
        else
            keys.unshift(ramp(quantity));
        if (quantity === difference)
            keys.unshift(element("span", {class: "entry"}, `against ${base().name}`));
        bar.replaceChildren(...keys, swatch(`rgb(${about.grey})`, "no cleaning asked"));
    }
    function ramp(quantity) {
        const stops = [...Array(33).keys()].map((i) => 3 * Math.round((i * 255) / 32))
            .map((at) => `rgb(${palette.subarray(at, at + 3)})`);
        const strip = element("span", {class: "ramp"}), stepped = state.scales[quantity.key] === "stepped";
        strip.style.background = stepped
            ? `linear-gradient(90deg,${stops[5]} 50%,${stops[27]} 50%)` : `linear-gradient(90deg,${stops})`;
        const ticks = stepped ? [quantity.step || quantity.shown[0]] : ticksOf(quantity);
        strip.append(...ticks.map((value) => {
            const tick = element("i", {}, String(Number(value.toPrecision(3))));
            tick.style.left = `${100 * (stepped ? 0.5 : shade(quantity, value))}%`;
            return tick;
        }));
        return element("span", {class: "entry"}, `${quantity.name}, ${quantity.unit} `, strip);
    }
    return {drawBar};
}
