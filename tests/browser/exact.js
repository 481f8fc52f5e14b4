/* Put behind the report's own script by a test: the surface that layouts are evaluated on, as numbers that JSON
 * keeps. */
(async () => {
    const found = {errors: [], requests: []}, told = document.createElement("pre");
    addEventListener("error", (event) => found.errors.push(event.message));
    told.id = "told";
    const {about, section} = await viewer, {surface} = about.models[0];
    found.ready = section.dataset.ready;
    found.places = [...surface.places];
    found.triangles = [...surface.triangles];
    found.uv = [...surface.uv];
    told.textContent = JSON.stringify(found);
    document.body.append(told);
})();
