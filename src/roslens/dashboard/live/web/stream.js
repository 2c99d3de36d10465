// Hears snapshots from the monitor, and says at once when there is nothing to hear.

const SILENT_MS = 3000;
const AGAIN_MS = 2000;

/** Calls `told(snapshot, read)` for each, which took `read` ms to read, and `heard(state, seconds)` with "live", "unsure", "lost" or "stuck" as it goes. */
export function listen(told, heard) {
  let last = performance.now();
  let fresh = last;
  let live = true;
  let broken = false;
  let source;

  function alive() {
    last = performance.now();
    broken = false;
    judge();
  }

  function open() {
    source = new EventSource("events");
    source.addEventListener("snapshot", (event) => {
      const begun = performance.now();
      const snapshot = JSON.parse(event.data);
      const read = performance.now() - begun;
      live = snapshot.live;
      fresh = performance.now();
      alive();
      told(snapshot, read);
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
