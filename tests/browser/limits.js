/* Put behind the report's own script by a test: puts nozzles where the scene does not allow them, and writes what the
 * page says of each into it. */
(async () => {
    const found = {steps: {}}, {live, until, has, tell} = reading;
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
    tell(found);
})();
