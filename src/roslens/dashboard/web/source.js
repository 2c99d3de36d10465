// The source of a file: the line that the address names is brought into view below the fixed top.

export function startSource(root) {
  if (!root.querySelector("[data-source]")) return;
  const show = () => {
    const line = /^#L\d+$/.test(location.hash) && document.getElementById(location.hash.slice(1));
    if (line) line.scrollIntoView({ block: "center" });
  };
  show();
  addEventListener("hashchange", show);
}
