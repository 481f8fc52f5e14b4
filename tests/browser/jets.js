/* Put behind the report's own script by a test: what a page of flown jets says of how many arrive, patch by patch. */
(async () => {
    const found = {errors: [], requests: []}, told = document.createElement("pre");
    addEventListener("error", (event) => found.errors.push(event.message));
    told.id = "told";
    const view = await viewer, quantity = view.about.quantities.find(({key}) => key === "jets");
    found.ready = view.section.dataset.ready;
    found.said = Array.from(view.designs[0].values.jets, (byte) => view.figure(quantity, byte));
    const list = [...view.section.querySelectorAll("select")].find((select) =>
        [...select.options].some(({text}) => text === quantity.name));
    list.selectedIndex = [...list.options].findIndex(({text}) => text === quantity.name);
    list.dispatchEvent(new Event("change"));
    found.bar = document.querySelector("#viewer .scale").textContent;
    told.textContent = JSON.stringify(found);
    document.body.append(told);
})();
