/* What draws the surface and the lines over it, as the graphics unit is told. */
function makeShaders(view) {
    "use strict";
    const {gl, about, chartHues, WIDE} = view;

    const TILE = 4096; /* pixels of a texture: larger pages are several */
    const surfaceShaders = [`#version 300 es
        in vec3 place; in vec2 spot; in float hue;
        uniform mat4 view; uniform vec3 low, extent; uniform float edge;
        out vec3 at, corner; out vec2 pixel; flat out int chart;
        void main() {
            at = low + place * extent;
            pixel = spot * edge;
            chart = int(hue);
            corner = vec3(equal(ivec3(gl_VertexID % 3), ivec3(0, 1, 2)));
            gl_Position = view * vec4(at, 1.);
        }`,
    `#version 300 es
        precision highp float; precision highp int; precision highp usampler2DArray;
        in vec3 at, corner; in vec2 pixel; flat in int chart;
        uniform usampler2DArray patches; uniform sampler2D colours;
        uniform int page, tiles; uniform bool charts, wires; uniform float edge; uniform vec4 cut;
        uniform vec3 eye, hues[${chartHues.hues.length}];
        out vec4 colour;
        void main() {
            if (dot(cut.xyz, at) > cut.w) discard;
            vec3 normal = normalize(cross(dFdx(at), dFdy(at)));
            float light = .62 + .38 * abs(dot(normal, normalize(eye - at)));
            vec3 paint = vec3(${about.grey.map((x) => (x / 255).toFixed(4)).join()});
            ivec2 spot = clamp(ivec2(pixel), ivec2(0), ivec2(int(edge) - 1));
            ivec2 tile = spot / ${TILE};
            int sheet = (page * tiles + tile.y) * tiles + tile.x;
            uint patchNumber = page < 0 ? 0u : texelFetch(patches, ivec3(spot - tile * ${TILE}, sheet), 0).r;
            if (patchNumber > 0u) {
                int i = int(patchNumber - 1u);
                vec4 found = texelFetch(colours, ivec2(i % ${WIDE}, i / ${WIDE}), 0);
                bool stripe = mod(gl_FragCoord.x + gl_FragCoord.y, 9.) < 2.6;
                paint = found.rgb;
                if (found.a < .25) paint = stripe ? vec3(.769, .149, .212) : vec3(.98, .973, .961);
                else if (found.a < .75) paint = stripe ? vec3(.06, .06, .1) : vec3(1., .84, .1);
            }
            if (charts && page >= 0) paint = hues[chart];
            vec3 pixels = fwidth(corner), away = corner / pixels; /* fainter where triangles are small */
            float wire = wires ? 1. - smoothstep(.4, 1.2, min(away.x, min(away.y, away.z))) : 0.;
            wire *= clamp(1. - 2. * max(pixels.x, max(pixels.y, pixels.z)), .15, .8);
            colour = vec4(mix(paint * light, vec3(.05), wire), 1.);
        }`];
    const lineShaders = [`#version 300 es
        in vec3 place; uniform mat4 view; out vec3 at;
        void main() { at = place; gl_Position = view * vec4(place, 1.); }`,
    `#version 300 es
        precision highp float; in vec3 at; uniform vec4 tint, cut; out vec4 colour;
        void main() {
            if (dot(cut.xyz, at) > cut.w) discard;
            colour = tint;
        }`];

    function program(sources) {
        const made = gl.createProgram();
        [gl.VERTEX_SHADER, gl.FRAGMENT_SHADER].forEach((kind, i) => {
            const shader = gl.createShader(kind);
            gl.shaderSource(shader, sources[i]);
            gl.compileShader(shader);
            gl.attachShader(made, shader);
        });
        gl.linkProgram(made);
        if (!gl.getProgramParameter(made, gl.LINK_STATUS))
            throw new Error(gl.getProgramInfoLog(made) || "shaders do not link");
        return new Proxy({made}, {get: (known, name) =>
            (name in known ? known[name] : (known[name] = gl.getUniformLocation(made, name)))});
    }
    const surfaceProgram = program(surfaceShaders), lineProgram = program(lineShaders);
    return {TILE, surfaceProgram, lineProgram};
}
