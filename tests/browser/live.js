/* Put behind the report's own script by a test: changes the layout as a reader would, and writes what came of it into
 * the page. */
(async () => {
    const found = {steps: {}}, {live, until, has, tell} = reading;
    await until(has("ready"));
    found.ready = live().dataset.ready || live().dataset.failed;

    const labelled = (name) => [...live().querySelectorAll("label")].find((label) => label.textContent.startsWith(name))
        .querySelector("input, select");
    const pressed = (name) => [...live().querySelectorAll("button")].find((button) => button.textContent === name);
    async function step(name, act) {
        if (act) {
            delete live().dataset.settled;
            await act();
        }
        await until(has("settled"));
        found.steps[name] = {coverage: Number(live().dataset.coverage), traced: Number(live().dataset.traced),
            said: live().querySelector(".answer").textContent,
            figures: (live().querySelector("table") || {}).textContent,
            head: (live().querySelector("thead") || {}).textContent, from: labelled("Start from").selectedOptions[0].text,
            nozzles: labelled("Nozzle").length, scene: live().querySelector("textarea").value};
    }
    function set(name, share) {
        const input = labelled(name);
        input.value = String(Number(input.min) + share * (Number(input.max) - Number(input.min)));
        input.dispatchEvent(new Event("input"));
    }
    /* The option of this text, or any other than now. */
    function choose(name, text) {
        const list = labelled(name), other = (option, i) => i !== list.selectedIndex;
        list.selectedIndex = [...list.options].findIndex(text ? (option) => option.text === text : other);
        list.dispatchEvent(new Event("change"));
    }

    /* Of the canvas, by its context's pixels. */
    function look() {
        dispatchEvent(new Event("resize"));
        const canvas = document.querySelector("#viewer canvas"), gl = canvas.getContext("webgl2");
        const {width, height} = canvas, pixels = new Uint8Array(4 * width * height);
        gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
        return pixels.reduce((sum, byte) => (sum * 31 + byte) % 2147483647, 0);
    }
    const switchOf = (name) => [...document.querySelectorAll("#viewer .switches label")]
        .find((label) => label.textContent.includes(name)).querySelector("input");
    const boxes = () => switchOf("Boxes");

    if (live().dataset.ready) {
        found.boxes = [look()];
        document.querySelector("#viewer canvas").dispatchEvent(new KeyboardEvent("keydown", {key: "b"}));
        await until(() => boxes().checked);
        found.boxes.push(look());
        found.said = document.querySelector("#viewer > .answer").textContent;
        boxes().click();
        await until(() => !boxes().checked);
        found.boxes.push(look());
        await step("start");
        await step("moved", () => set("Depth", 0.7));
        await step("turned", () => set("Tilt", 0.5));
        await step("pressed", () => set("Pressure", 0.25));
        await step("off", () => pressed("Switch off").click());
        pressed("Save as scene").click();
        found.savedWithout = live().querySelector(".answer").textContent;
        await step("undone", () => pressed("Undo").click());
        await step("added", () => pressed("Add a nozzle at").click());
        await step("typed", () => choose("Type"));
        await step("free", () => choose("Mount", "anywhere"));
        await step("placed", () => set("x, m", 0.31));
        await step("anew", () => choose("Start from", "Manual"));
        await step("returned", () => pressed("Undo").click());
        await step("twice", () => [1, 2].forEach(() => pressed("Add a nozzle at").click()));
        await step("once", () => pressed("Undo").click());
        await step("switched", async () => {
            pressed("Switch off").click();
            await until(() => pressed("Switch on"));
            pressed("Switch on").click();
        });
        await step("unswitched", () => pressed("Undo").click());
        found.isOff = Boolean(pressed("Switch on"));
        await step("on", () => pressed("Switch on").click());
        await step("drawn", () => [0.4, 0.5, 0.6].forEach((share) => set("Pressure", share)));
        await step("undrawn", () => pressed("Undo").click());
        found.reachable = [...live().querySelectorAll("button, input, select, textarea, summary")].every((one) =>
            one.tabIndex >= 0 && (one.textContent || one.ariaLabel || one.labels.length));
        const shown = [...document.querySelectorAll("#viewer .switches:first-child input:checked")];
        found.shown = shown.length;
        shown.filter((box) => box !== switchOf("Yours")).forEach((box) => box.click());
        found.jets = [look()];
        switchOf("Jets").click();
        found.jets.push(look());
    }
    tell(found);
})();
