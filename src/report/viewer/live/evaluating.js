/* Layouts are evaluated one at a time, of several that are asked for the latest. */
function makeEvaluating(live) {
    "use strict";
    const {view, design, section, answer, empty, numbersOf, litres, priceOf, tellFigures, tell} = live;
    const {element} = widgets;
    const QUICK = 100, IDLE = 150; /* ms */
    const MOST_STRIDE = 8;

    let wanted = false, busy = false, stride = 1, idle = 0;
    function show({figures: found, values, share}) {
        live.last = {...found, price: priceOf(found.flow)};
        view.about.quantities.forEach(({key}, k) => (design.values[key] = values[k]));
        design.share = share;
        design.quote = `${(100 * found.coverage).toFixed(1)} % with ${litres(found.flow)}`;
        section.dataset.coverage = found.coverage;
        tellFigures();
        view.recolour();
    }

    /* True where nothing is left to be done. */
    async function evaluate(exactly) {
        const rows = live.nozzles.map(numbersOf), used = exactly ? 1 : stride;
        const found = await live.ask("evaluate", {nozzles: rows, stride: used});
        show(found);
        section.dataset.ms = found.ms;
        section.dataset.traced = found.figures.traced;
        if (!exactly && found.ms > QUICK && stride < MOST_STRIDE)
            stride *= 2;
        else if (!exactly && found.figures.traced && found.ms < QUICK / 5 && stride > 1)
            stride /= 2;
        if (used > 1 || wanted) {
            tell(used);
            return false;
        }
        const finished = await live.ask("finish", {nozzles: rows});
        design.shadowOf = finished.shadowOf;
        design.shadows = finished.shadows.map(({at}) => ({at, towards: view.up, extent: 0.1 * view.size}));
        design.nozzles.forEach((nozzle, i) =>
            Object.assign(nozzle, {flux: finished.alone[i] || empty}, sprays.jetsOf(finished.jets[i], view.up)));
        view.uploadLines(design);
        tell(1, finished);
        await live.ask("prepare", {chosen: live.chosen});
        section.dataset.settled = JSON.stringify(rows);
        if (view.state.quantity === view.reached || (view.state.nozzle && view.state.nozzle.design === design))
            view.recolour();
        view.redraw();
        return true;
    }

    /* One at a time; the latest wish counts. */
    async function run(exactly) {
        clearTimeout(idle);
        wanted = true;
        if (busy)
            return;
        busy = true;
        try {
            let done = true;
            while (wanted) {
                wanted = false;
                done = await evaluate(exactly);
            }
            if (!done)
                idle = setTimeout(() => run(true), IDLE);
        } catch (error) {
            answer.replaceChildren(element("p", {}, `Not evaluated: ${error.message}.`));
            delete section.dataset.settled;
        }
        busy = false;
    }
    return {show, run};
}
