// Hears from the monitor what changed, and says at once when there is nothing to hear.

import { apply } from "./changes.js";

const SILENT_MS = 3000;
const AGAIN_MS = 2000;

/**
 * Calls `changed(snapshot, read)` for each, which took `read` ms to read, and `heard(state, seconds)` with "live",
 * "unsure", "lost" or "stuck" as it goes. `first` is what the page holds, `mark` what the monitor calls it, `reader`
 * what the monitor calls this page; `opened()` says that it does so from now on.
 */
export function listen(first, mark, reader, changed, heard, opened) {
  let last = performance.now();
  let fresh = last;
  let { live } = first;
  let broken = false;
  let source;
  let state = mark ? first : null;

  function alive() {
    last = performance.now();
    broken = false;
    judge();
  }

  function take(event, make) {
    const begun = performance.now();
    state = make(JSON.parse(event.data));
    mark = event.lastEventId;
    const read = performance.now() - begun;
    live = state.live;
    fresh = performance.now();
    alive();
    changed(state, read);
  }

  /** Whether a change is of what the page holds; where it is not, all of it is asked for. */
  function follows(next) {
    const [begun, number] = mark.split(".");
    return state && next === `${begun}.${Number(number) + 1}`;
  }

  function open() {
    source = new EventSource(`events?reader=${reader}${mark ? `&after=${encodeURIComponent(mark)}` : ""}`);
    source.addEventListener("open", opened);
    source.addEventListener("state", (event) => take(event, (whole) => whole));
    source.addEventListener("change", (event) => {
      if (follows(event.lastEventId)) take(event, (change) => apply(state, change));
      else {
        source.close();
        mark = "";
        open();
      }
    });
    source.addEventListener("beat", alive);
    source.addEventListener("error", () => {
      broken = true;
      judge();
      // A refused stream is not tried again by the browser itself.
      if (source.readyState === EventSource.CLOSED) setTimeout(open, AGAIN_MS);
    });
  }

  function judge() {
    const now = performance.now();
    if (now - last > SILENT_MS) heard("lost", (now - last) / 1000);
    else if (live && now - fresh > 2 * SILENT_MS) heard("stuck", (now - fresh) / 1000);
    else heard(broken ? "unsure" : "live", 0);
  }

  open();
  setInterval(judge, 250);
  addEventListener("pagehide", () => source.close());
  addEventListener("pageshow", (event) => event.persisted && open());
}
