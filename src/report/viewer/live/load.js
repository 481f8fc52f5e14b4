/* Runs the scripts of this folder, which come deflated beside the evaluator, once there is something to turn. */
(async () => {
    "use strict";
    const view = await viewer, source = document.getElementById("live-script");
    if (!view || !source || !window.WebAssembly || !window.Worker)
        return;
    const script = document.createElement("script");
    script.textContent = new TextDecoder().decode(await view.inflated(source.textContent));
    document.body.append(script);
})();
