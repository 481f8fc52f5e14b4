/* Put behind the report's own script by a test: puts nozzles where the scene does not allow them, and writes what the
 * page says of each into it. */
(async () => {
    const found = {errors: [], steps: {}};
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
    const labelled = (name) => [...live().querySelectorAll("label")].find((label) => label.textContent.startsWith(name))
        .querySelector("select");
    async function step(name, act) {
        if (act) {
            delete live().dataset.settled;
            act();
        }
        await until(has("settled"));
        found.steps[name] = {said: live().querySelector(".answer").textContent,
            type: labelled("Type").value, types: [...labelled("Type").options].map((option) => option.text),
            scene: live().querySelector("textarea").value};
    }
    function choose(list, text) {
        list.selectedIndex = [...list.options].findIndex((option) => option.text === text);
        list.dispatchEvent(new Event("change"));
    }
    const add = () => [...live().querySelectorAll("button")].find((one) => one.textContent === "Add a nozzle at");
    function addAt(mount) {
        choose(add().parentElement.querySelector("select"), mount);
        add().click();
    }

    if (live().dataset.ready) {
        await step("start");
        await step("narrow", () => choose(labelled("Mount"), "narrow"));
        await step("leftThere", () => choose(labelled("Mount"), "anywhere"));
        await step("wide", () => choose(labelled("Type"), "wide"));
        await step("narrower", () => choose(labelled("Mount"), "narrower"));
        await step("open", () => choose(labelled("Mount"), "open"));
        await step("two", () => addAt("open"));
        await step("rail", () => addAt("rail"));
        await step("crowd", () => addAt("rail"));
    }
    found.requests = performance.getEntriesByType("resource").map((entry) => entry.name)
        .filter((name) => !name.startsWith("blob:"));
    const told = document.createElement("pre");
    told.id = "told";
    told.textContent = JSON.stringify(found);
    document.body.append(told);
})();
