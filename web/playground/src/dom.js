// Small helpers for the page.

import icons from "./icons.js";

export const $ = (selector, within = document) => within.querySelector(selector);

/** An element: `h("button.primary", { title: "…", onclick }, child, …)`. */
export function h(what, properties = {}, ...children) {
  const [tag, ...classes] = what.split(".");
  const element = document.createElement(tag || "div");
  if (classes.length) element.className = classes.join(" ");
  for (const [name, value] of Object.entries(properties)) {
    if (value === undefined || value === false) continue;
    if (name.startsWith("on") || name in element) element[name] = value;
    else element.setAttribute(name, value === true ? "" : value);
  }
  element.append(...children.flat().filter((child) => child !== undefined && child !== null));
  return element;
}

export function icon(name) {
  const span = h("span.icon");
  span.innerHTML = icons[name] ?? "";
  span.setAttribute("aria-hidden", "true");
  return span;
}

export function button(name, title, onclick, more = {}) {
  return h("button.tool", { title, "aria-label": title, onclick, ...more }, icon(name));
}

export function toast(text, kind = "") {
  const note = h(`div.toast${kind ? `.${kind}` : ""}`, {}, text);
  $("#toasts").append(note);
  setTimeout(() => note.classList.add("gone"), 3600);
  setTimeout(() => note.remove(), 4200);
}

/** A list of choices beside a button: [icon, label, action, checked?]. */
export function menu(anchor, entries) {
  const box = $("#menu");
  const open = !box.hidden && box.anchor === anchor;
  box.hidden = true;
  if (open) return;
  box.anchor = anchor;
  box.replaceChildren(
    ...entries.map(([name, label, action, checked]) =>
      h(
        "button.entry",
        {
          role: checked === undefined ? "menuitem" : "menuitemcheckbox",
          "aria-checked": checked === undefined ? undefined : String(checked),
          onclick: () => {
            if (checked === undefined) box.hidden = true;
            action();
            if (checked !== undefined) {
              box.hidden = true;
              menu(anchor, anchor.entries());
            }
          },
        },
        icon(checked === undefined ? name : checked ? "check" : name),
        label,
      ),
    ),
  );
  box.hidden = false;
  const at = anchor.getBoundingClientRect();
  const size = box.getBoundingClientRect();
  box.style.left = `${Math.max(8, Math.min(innerWidth - size.width - 8, at.left + at.width / 2 - size.width / 2))}px`;
  box.style.top = at.top > innerHeight / 2 ? `${at.top - size.height - 8}px` : `${at.bottom + 8}px`;
}

addEventListener("pointerdown", (event) => {
  const box = $("#menu");
  if (!box.hidden && !box.contains(event.target) && !box.anchor?.contains(event.target)) box.hidden = true;
});

export function download(name, blob) {
  const link = h("a", { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

/** A number as people read it. */
export function short(value, digits = 3) {
  if (!Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-3 || size >= 1e6)) return value.toExponential(2);
  return String(Number(value.toPrecision(Math.max(digits, Math.ceil(Math.log10(size + 1))))));
}
