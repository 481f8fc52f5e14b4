/* Put behind the report's own script by a test, in a frame as narrow as a phone: tells the page around it how high the
 * letters of its drawings are, and how wide what scrolls. Lists have long names in them. */
(async () => {
    const found = {};
    const wait = (ms) => new Promise((done) => setTimeout(done, ms));
    const ready = (id) => document.getElementById(id) && document.getElementById(id).dataset.ready;
    for (let i = 0; i < 400 && !(ready("viewer") && (ready("live") || !document.getElementById("live-model"))); i++)
        await wait(50);
    found.ready = ready("viewer");
    for (const list of document.querySelectorAll("select"))
        list.options[0].text = "An ordinary name of an alternative, that is as long as this";
    await wait(200);
    found.width = document.documentElement.clientWidth;
    found.scrolled = document.documentElement.scrollWidth;
    found.letters = [".bar text", ".chart text"].map((drawn) =>
        document.querySelector(drawn).getBoundingClientRect().height);
    parent.postMessage(JSON.stringify(found), "*");
})();
