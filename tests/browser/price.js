/* Put behind the report's own script by a test: adds a nozzle at a mount that costs something, and writes what the page
 * tells of prices into it. */
(async () => {
    const found = {errors: []};
    addEventListener("error", (event) => found.errors.push(event.message));
    const live = () => document.getElementById("live");
    async function until(what) {
        for (let i = 0; i < 2000 && !what(); i++) {
            for (let k = 0, sum = 0; k < 5e6; k++)
                sum += k;
            await new Promise((done) => setTimeout(done, 1));
        }
    }
    const has = (name) => () => live() && (live().dataset[name] || live().dataset.failed);
    await until(has("ready"));
    found.ready = live().dataset.ready || live().dataset.failed;
    const look = () => ({said: live().querySelector(".answer").textContent,
        rows: [...live().querySelectorAll("tbody tr")].map((row) => [...row.children].map((cell) => cell.textContent)),
        scene: live().querySelector("textarea").value});
    found.start = look();
    const add = [...live().querySelectorAll("button")].find((button) => button.textContent === "Add a nozzle at");
    const mounts = add.parentElement.querySelector("select");
    mounts.selectedIndex = [...mounts.options].findIndex((option) => option.text === "P2");
    delete live().dataset.settled;
    add.click();
    await until(has("settled"));
    found.added = look();
    found.requests = performance.getEntriesByType("resource").map((entry) => entry.name)
        .filter((name) => !name.startsWith("blob:"));
    const told = document.createElement("pre");
    told.id = "told";
    told.textContent = JSON.stringify(found);
    document.body.append(told);
})();
