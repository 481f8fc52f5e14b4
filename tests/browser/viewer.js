/* Put behind the report's own script by a test: uses the viewer as a reader would, and writes what it saw into the page. */
const shown = viewer;
(async () => {
    const found = {errors: [], picks: []};
    const told = document.createElement("pre");
    told.id = "told";
    addEventListener("error", (event) => found.errors.push(event.message));
    const wait = (ms) => new Promise((done) => setTimeout(done, ms));
    const viewer = document.getElementById("viewer");
    for (let i = 0; i < 200 && !viewer.dataset.ready; i++)
        await wait(50);
    found.ready = viewer.dataset.ready || "";
    const canvas = viewer.querySelector("canvas"), gl = canvas.getContext("webgl2");
    const answer = viewer.querySelector(".answer"), bar = viewer.querySelector(".scale");

    /* Sums of each half's pixels, and how many of it are not white. */
    function look() {
        dispatchEvent(new Event("resize")); /* it draws at once, whenever the browser shows frames */
        const {width, height} = canvas, half = Math.floor(width / 2);
        return [0, half].map((left) => {
            const pixels = new Uint8Array(4 * half * height);
            gl.readPixels(left, 0, half, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
            let drawn = 0, sum = 0;
            for (let i = 0; i < pixels.length; i += 4) {
                drawn += pixels[i] + pixels[i + 1] + pixels[i + 2] < 765;
                sum = (sum * 31 + pixels[i] + 256 * pixels[i + 1] + 65536 * pixels[i + 2]) % 2147483647;
            }
            return {drawn, sum};
        });
    }
    const press = (key, more) => canvas.dispatchEvent(new KeyboardEvent("keydown", {key, bubbles: true, cancelable: true, ...more}));
    function choose(list, text) {
        list.selectedIndex = [...list.options].findIndex((option) => option.text === text);
        list.dispatchEvent(new Event("change"));
    }

    press("f"); /* the window may have got its size only now */
    found.first = look();
    const [show] = viewer.querySelectorAll("select");
    found.quantities = [];
    for (const {text} of [...show.options]) {
        choose(show, text);
        found.quantities.push({text, seen: look(), bar: bar.textContent});
    }
    choose(show, "Liquid flux");

    const labelled = (name) => [...viewer.querySelectorAll(".controls label")]
        .find((label) => label.textContent.trim().startsWith(name)).querySelector("input, select");
    const toldOf = () => ({seen: look(), said: answer.textContent, ramp: bar.querySelector(".ramp").style.background,
                            ticks: [...bar.querySelectorAll(".ramp i")].map((tick) => tick.textContent)});
    const scale = labelled("Scale"), colours = labelled("Colours");
    found.scales = [...scale.options].map(({text, disabled}) => {
        choose(scale, text);
        return {text, disabled, ...toldOf()};
    });
    choose(show, "Impact pressure");
    found.unasked = scale.options[2].disabled; /* of which the criterion asks nothing */
    choose(show, "Liquid flux");
    choose(scale, "logarithmic");
    choose(colours, "cividis");
    found.cividis = toldOf();
    choose(colours, "viridis");

    found.layers = {};
    const more = document.getElementById("live-model") ? [] : [["Boxes", "b"]]; /* else they are the evaluator's */
    for (const [name, key] of [["Wireframe", "w"], ["Jets", "j"], ...more]) {
        const box = labelled(name);
        box.click();
        await wait(0);
        const on = toldOf();
        box.click();
        await wait(0);
        const off = toldOf();
        press(key);
        await wait(0);
        found.layers[name] = {on, off, byKey: toldOf(), checked: box.checked};
        press(key);
        await wait(0);
    }
    found.byKeys = [];
    for (const [key, list] of [["l", scale], ["c", colours], ["q", show]]) {
        const before = list.value;
        press(key);
        found.byKeys.push(list.value !== before && answer.textContent);
    }
    choose(show, "Liquid flux");
    choose(scale, "logarithmic");
    choose(colours, "viridis");

    /* One design, one nozzle: its jets are drawn whether all are or not. */
    const others = [...viewer.querySelectorAll(".switches input")].slice(1, 3).filter((box) => box.checked);
    const chosen = document.querySelector('#nozzles table[data-design="0"] tbody button');
    others.forEach((box) => box.click());
    found.jets = [look()];
    chosen.click();
    found.jets.push(look());
    press("j");
    await wait(0);
    found.jets.push(look());
    press("j");
    await wait(0);
    chosen.click();
    others.forEach((box) => box.click());

    const corner = viewer.querySelector(".stage > svg");
    look();
    found.corner = [corner.textContent];
    for (let i = 0; i < 8; i++)
        press("+");
    look();
    found.corner.push(corner.textContent);
    press("f");
    found.named = [...viewer.querySelectorAll(".controls button, .controls input, .controls select, summary, canvas")]
        .every((one) => one.tabIndex >= 0 && (one.textContent || one.ariaLabel || one.labels.length));
    canvas.focus();
    found.focused = document.activeElement === canvas;
    for (let i = 0; i < 24; i++) {
        press("ArrowLeft");
        if (i < 4) /* beside what stands in the middle */
            press("ArrowRight", {shiftKey: true});
        press(i % 2 ? "ArrowUp" : "+");
        press("Enter");
        found.picks.push({patch: Number(answer.dataset.patch), text: answer.querySelector("p").textContent,
            rows: [...answer.querySelectorAll("tbody tr")].map((row) => [...row.children].map((cell) => cell.textContent))});
    }
    press("f");
    found.fitted = look();
    const row = (id) => document.querySelector(`#${id} table[data-design="0"] tbody button`);
    if (row("nozzles")) {
        row("nozzles").click();
        found.nozzle = {text: answer.textContent, seen: look()};
        row("nozzles").click();
    }
    if (row("shadows")) {
        row("shadows").click();
        found.shadow = {text: answer.textContent, seen: look()};
    }
    const view = await shown, proposed = view.designs.find(({name}) => name === "Proposed");
    found.fluxes = Array.from(proposed.values.flux, (byte) => view.figure(view.flux, byte, proposed.asked[0]));
    found.places = [-0.0004, -0.0006].map(view.placeText);

    /* A crowd of nozzles: names that show do not lie over each other, the chosen one's among them. */
    const real = proposed.nozzles, [first] = real;
    proposed.nozzles = Array.from({length: 60}, (_, i) => ({...first, name: `Nozzle ${i + 1}`,
        at: first.at.map((x, k) => x + 0.003 * ((i * (k + 2)) % 7))}));
    view.state.nozzle = {design: proposed, index: 41};
    view.moveLabels();
    const names = [...viewer.querySelectorAll(".nozzle-dot")].filter((name) => name.textContent.startsWith("Nozzle"));
    const boxes = names.filter((name) => !name.hidden).map((name) => name.getBoundingClientRect());
    found.crowd = {all: names.length, shown: boxes.length,
        overlaps: boxes.some((a, i) => boxes.slice(0, i).some((b) =>
            a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom)),
        chosen: names.some((name) => name.classList.contains("chosen") && !name.hidden)};
    [proposed.nozzles, view.state.nozzle] = [real, null];
    view.moveLabels();
    found.requests = performance.getEntriesByType("resource").map((entry) => entry.name)
        .filter((name) => !name.startsWith("blob:")); /* the worker, which the page made itself */
    told.textContent = JSON.stringify(found);
    document.body.append(told);
})();
