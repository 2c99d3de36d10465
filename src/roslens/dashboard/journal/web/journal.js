// Follows the journal and the questions: asks once a second whether there is anything new, and takes the same page again.
// The server makes every row, so that what is shown is what was escaped there.

import { startKeys } from "../keys.js";
import { duration } from "../live/states.js";
import { showPlace, startTheme } from "../shell.js";

const LOOK_MS = 1000;
const main = document.getElementById("main");
const lost = document.getElementById("lost");

startTheme();
showPlace();
startKeys();

async function look() {
  try {
    const answer = await fetch("journal/state.json", { cache: "no-store" });
    if (!answer.ok) throw new Error(answer.status);
    const { version } = await answer.json();
    if (version !== main.dataset.version) await renew();
    lost.hidden = true;
  } catch (failed) {
    lost.hidden = false;
  }
  setTimeout(look, LOOK_MS);
}

async function renew() {
  const answer = await fetch(location.pathname + location.search, { cache: "no-store" });
  if (!answer.ok) throw new Error(answer.status);
  const fresh = new DOMParser().parseFromString(await answer.text(), "text/html");
  const known = new Set([...document.querySelectorAll("#entries tbody tr")].map((row) => row.id));
  const held = document.activeElement && document.activeElement.closest(".question");
  for (const id of ["verified", "shown"]) {
    const [before, after] = [document.getElementById(id), fresh.getElementById(id)];
    if (!before || !after) continue;
    if (known.size) for (const row of after.querySelectorAll("#entries tbody tr")) if (!known.has(row.id)) row.className = "new";
    before.replaceWith(document.adoptNode(after));
  }
  const nav = fresh.querySelector(".top nav");
  if (nav) document.querySelector(".top nav").replaceWith(document.adoptNode(nav));
  showPlace();
  main.dataset.version = fresh.getElementById("main").dataset.version;
  if (held) refocus(held);
}

// A question that was in hand is in hand again, as long as it is asked.
function refocus(held) {
  const decision = held.querySelector("[name=decision]").value;
  for (const one of document.querySelectorAll(".question")) {
    if (one.querySelector("[name=decision]").value === decision) one.querySelector("button").focus();
  }
}

function count() {
  for (const one of document.querySelectorAll("[data-left]")) {
    // By seconds that passed here: the clock of who looks may be another than the monitor's.
    one.dataset.end ??= performance.now() / 1000 + Number(one.dataset.left);
    const left = Math.round(Number(one.dataset.end) - performance.now() / 1000);
    one.textContent = left > 0 ? `${duration(left)} left` : "its time is over";
  }
}

setTimeout(look, LOOK_MS);
setInterval(count, LOOK_MS);
