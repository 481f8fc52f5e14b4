/* Put behind a report's own scripts by times.sh: says on the console how long after its navigation began the page was
 * drawn and could evaluate layouts, where it does. */
(async () => {
    const wait = (ms) => new Promise((done) => setTimeout(done, ms));
    const told = (id, name) => document.getElementById(id) && document.getElementById(id).dataset[name];
    while (!told("viewer", "ready"))
        await wait(5);
    await new Promise(requestAnimationFrame);
    const drawn = performance.now();
    while (document.getElementById("live-model") && !told("live", "ready") && !told("live", "failed"))
        await wait(5);
    const ready = told("live", "ready") ? `live ${Math.round(performance.now())} ms` : "not live";
    const live = told("live", "failed") || ready;
    console.log(`open-times drawn ${Math.round(drawn)} ms, ${live}`);
})();
