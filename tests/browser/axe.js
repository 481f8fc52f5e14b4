/* Put behind the report's own script by a test that asks axe: what a reader does before. */
const asked = (() => {
    const live = () => document.getElementById("live"), viewer = document.getElementById("viewer");
    const wait = (ms) => new Promise((done) => setTimeout(done, ms));
    async function until(name) {
        for (let i = 0; i < 6000 && live() && !(live().dataset[name] || live().dataset.failed); i++)
            await wait(10);
    }
    const ready = () => until("ready");
    const boxed = (name) => [...viewer.querySelectorAll("label")].find((label) => label.textContent.includes(name))
        .querySelector("input");

    async function change() {
        [...live().querySelectorAll("button")].find((button) => button.textContent === "Move it in the picture").click();
        const tilt = [...live().querySelectorAll(".sliders label")].find((label) => label.textContent.startsWith("Tilt"))
            .querySelector("input");
        delete live().dataset.settled;
        tilt.value = String((Number(tilt.min) + Number(tilt.max)) / 2);
        tilt.dispatchEvent(new Event("input"));
        await until("settled");
    }

    /* Jets and boxes shown, a nozzle and a point asked about, a nozzle moved, all that folds unfolded. */
    async function use() {
        document.querySelectorAll("details").forEach((details) => (details.open = true));
        boxed("Jets").click();
        if (live() && !live().dataset.failed)
            await change();
        document.querySelector("#nozzles button.row").click();
        document.querySelector("#shadows button.row").click();
        const answer = viewer.querySelector(".answer"), said = answer.textContent;
        const canvas = viewer.querySelector("canvas");
        canvas.focus();
        canvas.dispatchEvent(new KeyboardEvent("keydown", {key: "Enter", bubbles: true}));
        await wait(300);
        return said + answer.textContent;
    }

    /* Once the page is laid out as wide as it is now. */
    const drawn = () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done))));

    async function faults() {
        await drawn();
        const {violations, passes} = await axe.run();
        return {checked: passes.length, faults: violations.map(({id, impact, help, nodes}) =>
            ({id, impact, help, at: nodes.slice(0, 3).map(({target}) => target.join(" ")).join(", ")}))};
    }
    return {ready, use, faults};
})();
