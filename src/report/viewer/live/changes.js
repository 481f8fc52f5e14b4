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
    /* Steps of one name that follow one another soon are taken back as one: those of a slider or a handle of one
     * nozzle that is drawn. Whatever else is done has no name, and is taken back by itself. */
    function remember(name) {
        const now = Date.now(), goesOn = name && name === gesture && now - gestureAt <= 1500;
        if (!goesOn)
            history.push(JSON.stringify([live.nozzles, live.chosen, live.start, live.started]));
        [gesture, gestureAt] = [name, now];
        live.undoButton.disabled = false;
    }

    let moving = Promise.resolve();
    /* One after the other. */
    const after = (act) => (moving = moving.then(act));
    /* `name`: of a slider or a handle of the nozzle in hand; none where it is neither. */
    function change(name, act, rebuild) {
        return after(async () => {
            const nozzle = live.nozzles[live.chosen];
            remember(name && `${name} of ${live.chosen}`);
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
            remember(null);
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
