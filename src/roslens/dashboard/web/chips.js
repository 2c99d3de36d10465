// A field for several tags: chips that can be taken away, completion with counts.

import { figure, make } from "./dom.js";

let number = 0;

class Chips {
  constructor(field) {
    this.hidden = field.querySelector("input");
    this.label = field.querySelector("label").textContent;
    this.counts = countsOf(this.hidden.list);
    this.tags = this.hidden.value.split(",").map((tag) => tag.trim()).filter(Boolean);
    this.id = `tags-${++number}`;
    this.box = make("div", { class: "chips" });
    this.input = make("input", {
      id: `${this.hidden.id}-chips`,
      placeholder: this.hidden.placeholder,
      autocomplete: "off",
      role: "combobox",
      "aria-expanded": "false",
      "aria-autocomplete": "list",
      "aria-controls": this.id,
      "aria-label": this.label,
    });
    // Browsers let the keyboard scroll what has too much in it, and the list is gone when it would get there.
    this.list = make("ul", { class: "options", role: "listbox", id: this.id, hidden: true, "aria-label": this.label, tabindex: "-1" });
    this.hidden.type = "hidden";
    field.querySelector("label").setAttribute("for", this.input.id);
    this.hidden.after(this.box);
    this.input.addEventListener("input", () => this.complete());
    this.input.addEventListener("focus", () => this.complete());
    this.input.addEventListener("blur", () => this.close());
    this.input.addEventListener("keydown", (event) => this.pressed(event));
    this.list.addEventListener("pointerdown", (event) => {
      event.preventDefault();
      const option = event.target.closest("li");
      if (option) this.add(option.dataset.tag);
    });
    this.show();
  }

  show() {
    const chips = this.tags.map((tag) =>
      make(
        "span",
        { class: this.hidden.name === "exclude" ? "chip out" : "chip" },
        tag,
        make("button", { type: "button", "aria-label": `take ${tag} away`, text: "×", onclick: () => this.remove(tag) }),
      ),
    );
    this.box.replaceChildren(...chips, this.input, this.list);
  }

  set(tags) {
    this.tags = tags;
    this.hidden.value = tags.join(",");
    this.show();
  }

  changed(tags) {
    this.set(tags);
    this.hidden.dispatchEvent(new Event("change", { bubbles: true }));
  }

  add(tag) {
    this.input.value = "";
    this.close();
    if (tag && !this.tags.includes(tag)) this.changed([...this.tags, tag]);
    this.input.focus();
    this.close();
  }

  remove(tag) {
    this.changed(this.tags.filter((other) => other !== tag));
    this.input.focus();
    this.close();
  }

  complete() {
    const needle = this.input.value.trim().toLocaleLowerCase();
    const found = [...this.counts].filter(([tag]) => !this.tags.includes(tag) && tag.toLocaleLowerCase().includes(needle));
    found.sort((a, b) => b[0].toLocaleLowerCase().startsWith(needle) - a[0].toLocaleLowerCase().startsWith(needle) || b[1] - a[1]);
    this.list.replaceChildren(
      ...found.slice(0, 60).map(([tag, count], place) =>
        make("li", { role: "option", id: `${this.id}-${place}`, "data-tag": tag, "aria-selected": "false" }, tag, make("small", { text: figure(count) })),
      ),
    );
    this.list.hidden = !found.length;
    this.input.setAttribute("aria-expanded", String(Boolean(found.length)));
    if (needle && found.length) this.choose(this.list.firstElementChild);
    else this.input.removeAttribute("aria-activedescendant");
  }

  choose(option) {
    for (const other of this.list.children) other.setAttribute("aria-selected", String(other === option));
    option.scrollIntoView({ block: "nearest" });
    this.input.setAttribute("aria-activedescendant", option.id);
  }

  close() {
    this.list.hidden = true;
    this.input.setAttribute("aria-expanded", "false");
    this.input.removeAttribute("aria-activedescendant");
  }

  pressed(event) {
    const chosen = this.list.querySelector('[aria-selected="true"]');
    if (event.key === "ArrowDown" || event.key === "ArrowUp") {
      if (this.list.hidden) this.complete();
      const down = event.key === "ArrowDown";
      const next = chosen ? (down ? chosen.nextElementSibling : chosen.previousElementSibling) : this.list.firstElementChild;
      if (next) this.choose(next);
    } else if (event.key === "Enter") {
      if (!this.list.hidden && chosen) this.add(chosen.dataset.tag);
    } else if (event.key === "Escape") {
      if (this.list.hidden) return;
      this.close();
    } else if (event.key === "Backspace" && !this.input.value && this.tags.length) {
      this.remove(this.tags.at(-1));
    } else return;
    event.preventDefault();
    event.stopPropagation();
  }
}

function countsOf(list) {
  const options = list ? [...list.options] : [];
  return new Map(options.map((option) => [option.value, Number(option.textContent.replaceAll(",", "")) || 0]));
}

/** Turn the tag fields below `root` into chips; returns them by name. */
export function startChips(root) {
  const made = new Map();
  for (const field of root.querySelectorAll("[data-tags].field")) {
    const chips = new Chips(field);
    made.set(chips.hidden.name, chips);
  }
  return made;
}
