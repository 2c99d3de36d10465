// Each rule returns the elements that break it, as rules of the same names of axe-core 4.10 do.
(() => {
  const FOCUSABLE = "a[href], button, input:not([type=hidden]), select, textarea, summary, [tabindex]:not([tabindex='-1'])";
  const NO_TEXT = "a, button, .sr, svg, select, input, table, ul, ol, dl, p, div, h1, h2, pre";
  const plain = (text) => text.toLowerCase().replace(/[^\p{L}\p{N}]+/gu, "");
  const block = (one) => (getComputedStyle(one).display.startsWith("inline") ? block(one.parentElement) : one);

  /** Whether an element has words of its own besides its links. */
  const hasWords = (one) => {
    const copy = one.cloneNode(true);
    for (const part of copy.querySelectorAll(NO_TEXT)) part.remove();
    return /[\p{L}\p{N}/·]/u.test(copy.textContent);
  };

  /** The words of an element that can be seen: titles of drawings show only under the pointer. */
  const seen = (one) => {
    const copy = one.cloneNode(true);
    for (const part of copy.querySelectorAll("title")) part.remove();
    return copy.textContent;
  };

  const rules = {
    "nested-interactive": () => [...document.querySelectorAll("summary, button, a[href], [role=button], [role=link]")].filter((one) => one.querySelector(FOCUSABLE)),

    "link-in-text-block": () =>
      [...document.querySelectorAll("main a[href], .colophon a[href]")].filter((link) => {
        if (!link.checkVisibility() || link.closest("svg, .skip, h1, h2, h3, td, th, .figures, .tabs")) return false;
        const own = getComputedStyle(link);
        if (own.display !== "inline") return false;
        const around = block(link.parentElement);
        return ["P", "DD", "LI"].includes(around.tagName) && hasWords(around) && !own.textDecorationLine.includes("underline");
      }),

    "label-content-name-mismatch": () =>
      [...document.querySelectorAll("a, button, summary, [role=button]")]
        .filter((one) => one.hasAttribute("aria-label") && one.checkVisibility())
        .filter((one) => plain(seen(one)).length > 1 && !plain(one.getAttribute("aria-label")).includes(plain(seen(one)))),

    "scrollable-region-focusable": () =>
      [...document.querySelectorAll("body *")].filter((one) => {
        if (!one.checkVisibility() || one.closest("svg")) return false;
        const style = getComputedStyle(one);
        const scrolls = (how, long, room) => ["auto", "scroll"].includes(how) && long > room + 12;
        const down = scrolls(style.overflowY, one.scrollHeight, one.clientHeight);
        const across = scrolls(style.overflowX, one.scrollWidth, one.clientWidth);
        return (down || across) && !one.matches(FOCUSABLE) && !one.querySelector(FOCUSABLE);
      }),
  };
  return Object.fromEntries(Object.entries(rules).map(([name, found]) => [name, found().map((one) => one.outerHTML.slice(0, 200))]));
})()
