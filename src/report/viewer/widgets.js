/* Elements of the page, as the viewer and what evaluates layouts make them. */
const widgets = (() => {
    "use strict";

    function element(tag, attributes, ...children) {
        const made = document.createElement(tag);
        Object.entries(attributes).forEach(([key, value]) =>
            (key in made && typeof value !== "string" ? (made[key] = value) : made.setAttribute(key, value)));
        made.append(...children);
        return made;
    }
    function option(text, chosen) {
        return element("option", {value: text, selected: Boolean(chosen)}, text);
    }
    function button(name, act) {
        const made = element("button", {type: "button"}, name);
        made.addEventListener("click", act);
        return made;
    }
    function checkbox(name, checked, act) {
        const box = element("input", {type: "checkbox", checked});
        box.addEventListener("change", () => act(box));
        return [box, element("label", {}, box, ` ${name}`)];
    }
    return {element, option, button, checkbox};
})();
