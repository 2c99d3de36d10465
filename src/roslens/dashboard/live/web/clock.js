// Times as the monitor writes them: its time of day, or the seconds of a recording, whatever zone the viewer is in.

let offset = 0;
let ofDay = true;

/** Learn from a snapshot how its times are written. */
export function learn(snapshot) {
  const day = /(\d+):(\d\d):(\d\d(?:\.\d+)?)/.exec(snapshot.when);
  ofDay = Boolean(day);
  if (day) {
    const gap = Number(day[1]) * 3600 + Number(day[2]) * 60 + Number(day[3]) - (snapshot.time % 86400);
    // What is cut off of the last digit is no zone.
    offset = Math.round(gap / 60) * 60;
  } else offset = Number.parseFloat(snapshot.when) - snapshot.time;
}

/** When that began of which times are seconds; of a day nobody knows. */
export function beginning() {
  return ofDay ? Number.NEGATIVE_INFINITY : -offset;
}

/** A moment in words. */
export function written(time, decimals = 1) {
  // A moment just before the beginning is none of its own.
  if (!ofDay) return `${(time + offset).toFixed(decimals).replace(/^-(?=[0.]*$)/, "")} s`;
  const scale = 10 ** decimals;
  const rest = Math.floor(((((time + offset) % 86400) + 86400) % 86400) * scale + 1e-6) / scale;
  const two = (number) => String(Math.floor(number)).padStart(2, "0");
  const seconds = decimals ? (rest % 60).toFixed(decimals).padStart(3 + decimals, "0") : two(rest % 60);
  return `${two(rest / 3600)}:${two((rest % 3600) / 60)}:${seconds}`;
}
