/* Put behind the report's own script by a test that moves the mouse: what it asks the page. */
const dragged = (() => {
    const live = () => document.getElementById("live"), found = {errors: []};
    addEventListener("error", (event) => found.errors.push(event.message));
    const wait = (ms) => new Promise((done) => setTimeout(done, ms));
    async function until(name) {
        for (let i = 0; i < 6000 && !(live() && (live().dataset[name] || live().dataset.failed)); i++)
            await wait(10);
        return live().dataset[name] || live().dataset.failed;
    }
    const pressed = (text) => [...live().querySelectorAll("button")].find((button) => button.textContent === text);
    const labelled = (name) => [...live().querySelectorAll("label")].find((label) => label.textContent.startsWith(name))
        .querySelector("input, select");
    async function start() {
        found.ready = await until("ready");
        pressed("Move it in the picture").click();
        await wait(300);
        document.querySelector("#viewer canvas").scrollIntoView();
        await wait(300);
        return found.ready;
    }
    async function mount(text) {
        const list = labelled("Mount");
        list.selectedIndex = [...list.options].findIndex((option) => option.text === text);
        delete live().dataset.settled;
        list.dispatchEvent(new Event("change"));
        await until("settled");
        document.querySelector("#viewer canvas").scrollIntoView();
        await wait(100);
        return list.selectedIndex;
    }
    function handle(drag) {
        delete live().dataset.settled;
        const box = document.querySelector(`#viewer .handles [data-drag="${drag}"]`).getBoundingClientRect();
        return [box.x + box.width / 2, box.y + box.height / 2];
    }
    /* Once nothing is on its way any more: a place on a surface is asked of the worker, behind what that evaluates. */
    async function look() {
        for (let before = null; !before || before !== live().dataset.settled;) {
            before = await until("settled");
            await wait(300);
        }
        const sliders = Object.fromEntries([...live().querySelectorAll(".sliders label")].map((label) =>
            [label.textContent, Number(label.querySelector("input").value)]));
        const line = live().querySelector(".sliders .pose"), exact = (name) => live()
            .querySelector(`[aria-label="${name}, deg, as a number"]`).value;
        const pose = line ? line.textContent : `On the sheet: tilt ${exact("Tilt")}°, towards ${exact("Towards")}°.`;
        return {...found, sliders, pose, coverage: Number(live().dataset.coverage),
            row: live().querySelector("tbody tr").textContent, scene: live().querySelector("textarea").value,
            requests: performance.getEntriesByType("resource").map((entry) => entry.name)
                .filter((name) => !name.startsWith("blob:"))};
    }
    return {start, mount, handle, look};
})();
