/* The other way round of vertex_code.c, operation by operation. */
function readPlaces(coder, walk, about) {
    "use strict";
    const {triangles, gates} = walk, {vertices, base, digits, parts, unit} = about;
    const MOST_DIGITS = 60, zeros = coder.numbers(3), off = coder.numbers(3 * 17), missed = coder.numbers();
    const numbers = new Float64Array(3 * vertices), places = new Float64Array(3 * vertices), expected = [0, 0, 0];
    const steps = Array.from({length: 2 * MOST_DIGITS}, () => 1);
    for (let i = 1; i < steps.length; i++)
        steps[i] = steps[i - 1] * base;
    function zerosOf(number) {
        let found = 0;
        for (let limit = steps[digits]; Math.abs(number) >= limit && found < MOST_DIGITS; limit *= base)
            found++;
        return found;
    }
    function tell(vertex) {
        for (let k = 0, before = 0; k < 3; k++) {
            const step = steps[zerosOf(expected[k]) + coder.number(zeros + k * coder.NUMBER)];
            const apart = coder.number(off + (17 * k + before) * coder.NUMBER);
            before = (coder.length + 3) >> 2;
            const at = 3 * vertex + k;
            numbers[at] = (Math.floor(expected[k] / step + 0.5) + apart) * step;
            places[at] = exact.moved(numbers[at] / parts * unit, coder.number(missed));
        }
    }
    function expectBefore(vertex) {
        for (let k = 0; k < 3; k++)
            expected[k] = vertex ? numbers[3 * (vertex - 1) + k] : 0;
    }
    function expectOver(gate) {
        const i = gate % 3, start = gate - i, a = triangles[gate], b = triangles[start + ((i + 1) % 3)];
        const other = triangles[start + ((i + 2) % 3)];
        for (let k = 0; k < 3; k++)
            expected[k] = numbers[3 * a + k] + numbers[3 * b + k] - numbers[3 * other + k];
    }
    let fresh = 0;
    for (let corner = 0; corner < triangles.length; corner++) {
        if (triangles[corner] !== fresh)
            continue;
        const gate = gates[Math.floor(corner / 3)];
        gate < 0 ? expectBefore(fresh) : expectOver(gate);
        tell(fresh++);
    }
    for (; fresh < vertices; fresh++) {
        expectBefore(fresh);
        tell(fresh);
    }
    return places;
}
