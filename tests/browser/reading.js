/* Put before every script that a test puts behind the report's own: how a script that changes the layout waits for the
 * page, and how it tells what it found. The page's clock runs ahead while the worker works: it is waited for by
 * working. */
const reading = (() => {
    const errors = [];
    addEventListener("error", (event) => errors.push(event.message));
    const live = () => document.getElementById("live");
    async function until(what) {
        for (let i = 0; i < 2000 && !what(); i++) {
            for (let k = 0, sum = 0; k < 5e6; k++)
                sum += k;
            await new Promise((done) => setTimeout(done, 1));
        }
    }
    const has = (name) => () => live() && (live().dataset[name] || live().dataset.failed);

    /* Into the page, with what went wrong and what was asked for outside of it. */
    function tell(found) {
        const requests = performance.getEntriesByType("resource").map((entry) => entry.name)
            .filter((name) => !name.startsWith("blob:"));
        const told = document.createElement("pre");
        told.id = "told";
        told.textContent = JSON.stringify({...found, errors, requests});
        document.body.append(told);
    }
    return {live, until, has, tell};
})();
