/* Tables that are wider than their place scroll in it: by keyboard too, where they do. */
const scrolling = (() => {
    "use strict";
    const observer = new ResizeObserver((entries) => entries.forEach(({target}) => {
        const holder = target.closest(".wide");
        if (holder && holder.scrollWidth > holder.clientWidth)
            holder.tabIndex = 0;
        else if (holder)
            holder.removeAttribute("tabindex");
    }));
    function watch(holder) {
        observer.observe(holder);
        [...holder.children].forEach((table) => observer.observe(table));
        return holder;
    }
    document.querySelectorAll(".wide").forEach(watch);
    return {watch};
})();
