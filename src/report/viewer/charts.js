/* Charts of the atlas: what is drawn of each hangs together by its corners. */
const charts = (() => {
    "use strict";

    /* Of each vertex one that stands for its chart. */
    function chartsOf(corners, count) {
        const parent = Uint32Array.from({length: count}, (_, i) => i);
        const root = (i) => {
            while (parent[i] !== i)
                i = parent[i] = parent[parent[i]];
            return i;
        };
        for (let i = 0; i < corners.length; i++)
            parent[root(corners[i])] = root(corners[i - (i % 3)]);
        return parent.map(root);
    }

    /* Of each chart those that it has a place of the surface in common with. */
    function neighboursOf(packed, chart) {
        const at = new Map(), beside = new Map();
        chart.forEach((own, i) => {
            const place = (packed[6 * i] * 65536 + packed[6 * i + 1]) * 65536 + packed[6 * i + 2];
            const here = at.has(place) ? [at.get(place)].flat() : []; /* mostly one, which is kept without a list */
            beside.has(own) || beside.set(own, new Set());
            if (here.includes(own))
                return;
            here.forEach((other) => {
                beside.get(own).add(other);
                beside.get(other).add(own);
            });
            at.set(place, here.length ? [...here, own] : own);
        });
        return beside;
    }

    /* Writes into the model's vertices which of so many hues each has, no two neighbours the same where that is found,
     * of these the one that is used least, the charts with most neighbours first. */
    function choose(model, hues) {
        const {packed} = model.vertex, chart = chartsOf(model.corners, packed.length / 6);
        const beside = neighboursOf(packed, chart), hueOf = new Map(), used = new Array(hues).fill(0);
        [...beside].sort((a, b) => b[1].size - a[1].size).forEach(([own, others]) => {
            const taken = new Array(hues).fill(0);
            others.forEach((other) => hueOf.has(other) && taken[hueOf.get(other)]++);
            const least = Math.min(...taken), rarely = used.map((many, hue) => (taken[hue] > least ? Infinity : many));
            hueOf.set(own, rarely.indexOf(Math.min(...rarely)));
            used[hueOf.get(own)]++;
        });
        chart.forEach((own, i) => (packed[6 * i + 5] = hueOf.get(own)));
    }
    return {choose};
})();
