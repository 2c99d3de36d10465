// A stretch drawn over a curve leads to what is different between its ends; the form below does the same by keyboard.

const placesOf = (svg) => svg.dataset.places.split(" ").map(Number);

/** The revision nearest to where the pointer is. */
function place(svg, event) {
  const matrix = svg.getScreenCTM();
  const x = new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix.inverse()).x;
  const away = placesOf(svg).map((one) => Math.abs(one - x));
  return away.indexOf(Math.min(...away));
}

function draw(svg, first, last) {
  const places = placesOf(svg);
  const stretch = svg.querySelector(".stretch");
  stretch.setAttribute("x", Math.min(places[first], places[last]));
  stretch.setAttribute("width", Math.abs(places[last] - places[first]));
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
