/* What the reader changes, and takes back. */
function makeChanges(live) {
    "use strict";
    const {view, design, section, scene, empty, mountAt, settle, rimOf, run, sceneText} = live;

    function drawNozzles() {
        design.nozzles = live.nozzles.map((nozzle, i) => ({name: nozzle.name, known: true, at: nozzle.place,
            held: i === live.chosen && nozzle.on,
            flux: (design.nozzles[i] || {}).flux || empty, direct: [], bounced: [],
            sprays: nozzle.on ? [{from: nozzle.place, rim: rimOf(nozzle)}] : []}));
        view.uploadLines(design);
    }

    const history = [];
    let gesture = null, gestureAt = 0;
    function remember(name) {
        const now = Date.now();
        if (name !== gesture || now - gestureAt > 1500)
            history.push(JSON.stringify([live.nozzles, live.chosen, live.start, live.started]));
        [gesture, gestureAt] = [name, now];
        live.undoButton.disabled = false;
    }

    let moving = Promise.resolve();
    /* One after the other. */
    const after = (act) => (moving = moving.then(act));
    /* `name`: changes of one name, one soon after the other, are undone together. */
    function change(name, act, rebuild) {
        return after(async () => {
            remember(name);
            const nozzle = live.nozzles[live.chosen];
            act(nozzle);
            await settle(nozzle);
            refresh(rebuild);
        });
    }

    function refresh(rebuild) {
        drawNozzles();
        if (!design.shown) {
            design.shown = true;
            view.show(design);
        }
        rebuild ? live.build() : live.syncs.forEach((sync) => sync());
        scene.value = sceneText();
        delete section.dataset.settled;
        run(false);
    }

    /* After what is on its way. The start comes back too: what the table compares with, and what the list says. */
    const undo = () => after(async () => {
        const before = history.pop();
        if (!before)
            return;
        [live.nozzles, live.chosen, live.start, live.started] = JSON.parse(before);
        live.starts.selectedIndex = live.started;
        gesture = null;
        live.undoButton.disabled = !history.length;
        refresh(true);
    });

    function addNozzle(index) {
        after(async () => {
            remember("add");
            const like = live.nozzles[live.chosen], taken = new Set(live.nozzles.map((nozzle) => nozzle.name));
            let number = live.nozzles.length + 1;
            while (taken.has(`A${number}`))
                number++;
            const made = {...like, name: `A${number}`, on: true, keep: false, jets: 0, tilt: 0, azimuth: 0};
            mountAt(made, index);
            await settle(made);
            live.nozzles = [...live.nozzles, made];
            live.chosen = live.nozzles.length - 1;
            refresh(true);
        });
    }
    return {drawNozzles, remember, after, change, refresh, undo, addNozzle};
}
