// A stretch drawn over a curve leads to what is different between its ends; the form below does the same by keyboard.

const WIDTH = 860;

function place(svg, event) {
  const matrix = svg.getScreenCTM();
  const count = svg.dataset.commits.split(" ").length;
  const x = new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix.inverse()).x;
  return Math.min(count - 1, Math.max(0, Math.round((x / WIDTH) * (count - 1))));
}

function draw(svg, first, last) {
  const commits = svg.dataset.commits.split(" ");
  const step = WIDTH / Math.max(1, commits.length - 1);
  const stretch = svg.querySelector(".stretch");
  stretch.setAttribute("x", Math.min(first, last) * step);
  stretch.setAttribute("width", Math.abs(last - first) * step);
}

export function startTrend(root) {
  for (const svg of root.querySelectorAll("svg[data-commits]")) {
    let first = -1;
    svg.addEventListener("pointerdown", (event) => {
      if (event.button === 0) {
        first = place(svg, event);
        svg.setPointerCapture(event.pointerId);
        event.preventDefault();
      }
    });
    svg.addEventListener("pointermove", (event) => {
      if (first >= 0) draw(svg, first, place(svg, event));
    });
    svg.addEventListener("pointercancel", () => {
      first = -1;
      draw(svg, 0, 0);
    });
    svg.addEventListener("pointerup", (event) => {
      const last = place(svg, event);
      if (first >= 0 && last !== first) {
        const commits = svg.dataset.commits.split(" ");
        const ends = new URLSearchParams({
          before: commits[Math.min(first, last)],
          after: commits[Math.max(first, last)],
        });
        location.href = `/difference?${ends}`;
      }
      first = -1;
    });
  }
}
