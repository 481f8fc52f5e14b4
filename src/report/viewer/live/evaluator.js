/* The worker that evaluates layouts (worker.js). */
function makeEvaluator(live) {
    "use strict";
    const {view, editing, model, design} = live, {types} = editing;

    async function startWorker() {
        const script = await view.inflated(document.getElementById("live-worker").textContent);
        const address = URL.createObjectURL(new Blob([script], {type: "text/javascript"}));
        const worker = new Worker(address), waiting = new Map();
        let number = 0;
        worker.addEventListener("message", ({data: {id, answer, error}}) => {
            const {done, failed} = waiting.get(id);
            waiting.delete(id);
            error === undefined ? done(answer) : failed(new Error(error));
        });
        worker.addEventListener("error", (event) => {
            event.preventDefault();
            waiting.forEach(({failed}) => failed(new Error(event.message || "no worker")));
            waiting.clear();
        });
        return (act, more) => new Promise((done, failed) => {
            waiting.set(++number, {done, failed});
            worker.postMessage({id: number, act, ...more});
        });
    }

    async function open() {
        const ask = await startWorker(), {surface} = model;
        const zero = String.fromCharCode(0);
        const arrays = {...surface, settings: Float64Array.from(editing.settings),
            clean: Uint8Array.from(editing.parts, (part) => part.clean),
            names: new TextEncoder().encode(editing.parts.map((part) => part.name + zero).join("")),
            types: Float64Array.from(types.flatMap((type) => type.numbers)),
            members: Float64Array.from(editing.members.flat())};
        const shown = view.about.quantities.map((quantity, k) => ({...quantity, asked: design.asked[k]}));
        const module = await view.inflated(document.getElementById("live-module").textContent);
        await ask("open", {module, arrays, shown});
        live.ask = ask;
    }
    return {open};
}
