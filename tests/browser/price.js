/* Put behind the report's own script by a test: adds a nozzle at a mount that costs something, and writes what the page
 * tells of prices into it. */
(async () => {
    const found = {}, {live, until, has, tell} = reading;
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
    tell(found);
})();
