/* Put behind a report's own scripts by times.sh: moves and turns every nozzle of the layout, and says on the
 * console how long the page's worker took for each, evaluation and colours. */
(async () => {
    const wait = (ms) => new Promise((done) => setTimeout(done, ms));
    const live = () => document.getElementById("live"), told = (name) => live() && live().dataset[name];
    while (!told("ready") && !told("failed"))
        await wait(50);
    const times = {move: [], turn: []};
    const slider = (name) => [...live().querySelectorAll(".sliders label")]
        .filter((label) => label.textContent.startsWith(name)).map((label) => label.querySelector("input"))[0];
    const list = (name) => [...live().querySelectorAll("label")].find((label) => label.textContent.startsWith(name))
        .querySelector("select");
    async function set(name, share, kind) {
        const input = slider(name);
        if (!input)
            return;
        delete live().dataset.settled;
        input.value = String(Number(input.min) + share * (Number(input.max) - Number(input.min)));
        input.dispatchEvent(new Event("input"));
        for (let i = 0; i < 2000 && !told("settled"); i++)
            await wait(5);
        if (Number(told("traced")) === (kind === "move" ? 1 : 0))
            times[kind].push(Number(told("ms")));
    }
    const count = told("ready") ? list("Nozzle").options.length : 0;
    for (let round = 0; round < 8; round++)
        for (let i = 0; i < count; i++) {
            const nozzles = list("Nozzle");
            nozzles.selectedIndex = i;
            nozzles.dispatchEvent(new Event("change"));
            for (const name of ["x, m", "z, m", "Depth, mm"])
                await set(name, 0.3 + 0.05 * round, "move");
            for (const name of ["Tilt", "Towards", "Round", "Roll, deg", "Angle, deg", "Flow, L/min"])
                await set(name, 0.2 + 0.09 * round, "turn");
        }
    const say = (kind) => {
        const sorted = times[kind].sort((a, b) => a - b);
        const at = (share) => sorted[Math.floor(share * (sorted.length - 1))];
        return `${kind}: median ${at(0.5).toFixed(1)} ms, 10 % below ${at(0.1).toFixed(1)}, 90 % below ` +
            `${at(0.9).toFixed(1)}, of ${sorted.length}`;
    };
    console.log(count ? `live-times ${say("move")}; ${say("turn")}` : `live-times failed: ${told("failed")}`);
})();
