// Follows the system: each snapshot is written into the page that the server sent.

import { enterParameters, onReturn, parameters, setParameters } from "../address.js";
import { make, settled } from "../dom.js";
import { onKey, startKeys } from "../keys.js";
import { startShell } from "../shell.js";
import { Alerts } from "./alerts.js";
import { Causes } from "./causes.js";
import { learn } from "./clock.js";
import { Detail } from "./detail.js";
import { followNames } from "./entity.js";
import { Happened } from "./happened.js";
import { Moments } from "./moments.js";
import { Picture } from "./picture.js";
import { Plots } from "./plots.js";
import { Sparks } from "./sparks.js";
import { sign, word } from "./states.js";
import { Sees } from "./sees.js";
import { listen } from "./stream.js";
import { Tree } from "./tree.js";
import { Way } from "./way.js";

const by = (id) => document.getElementById(id);
const search = by("q");
const worse = by("worse");

const tree = new Tree(by("tree"), { count: by("tree-count"), empty: by("empty") }, (entity) => choose(entity, "tree"));
const picture = new Picture(by("canvas"), { svg: by("picture"), scene: by("scene"), layers: { boxes: by("boxes"), lines: by("lines"), items: by("items") }, leftOut: by("left-out") },
  (entity) => choose(entity, "picture"));
const way = new Way({ input: by("way-to"), said: by("way-said"), names: by("way-names") }, picture);
const alerts = new Alerts(by("alerts"), by("muted"), by("said"), (entity) => choose(entity, "alerts"));
const causes = new Causes(by("causes"));
const happened = new Happened(by("happened"), by("failures"), [by("happened-none"), by("failures-none")]);

const remembers = Boolean(by("time"));
const plots = remembers ? new Plots(by("plots"), () => moments.at ?? moments.now, () => moments.begun) : null;
const detail = new Detail(by("detail"), { close: () => choose("", "keys"), at: () => moments?.at ?? null, plots, grown: () => tree.reveal() });
let latest = null;

/** Show an entity everywhere. */
function choose(entity, from) {
  if (from !== "tree") {
    if (entity && !tree.show(entity) && (search.value || worse.checked)) {
      // It was filtered away.
      search.value = "";
      worse.checked = false;
      filter();
      tree.show(entity);
    } else if (!entity) tree.choose("", false);
  }
  picture.select(entity, from !== "picture");
  way.show();
  detail.show(entity);
  if (from !== "address") enterParameters({ select: entity });
}

/** Another moment is shown; null is now. */
function went(at) {
  setParameters({ at: at === null ? "" : String(Math.round(at * 10) / 10) });
  plots.moved();
  sayPulse();
  if (at === null && latest) show(latest);
}

/** A snapshot of what runs has come: it is shown unless the reader looks at another moment. */
function heardOf(snapshot, read) {
  latest = snapshot;
  moments?.update(snapshot);
  if (!moments || moments.at === null) show(snapshot, read);
}

function filter() {
  tree.filter(search.value, worse.checked);
  setParameters({ q: search.value.trim(), worse: worse.checked ? "1" : "" });
}

function headline(snapshot) {
  const wrong = snapshot.wrong || 0;
  const muted = snapshot.muted?.length || 0;
  const judged = Object.values(snapshot.counts).some(Boolean);
  const unknown = snapshot.counts.unknown || 0;
  const follow = snapshot.follow || 0;
  const aside = muted ? `${muted} muted, ` : "";
  const words = wrong ? aside + `${wrong} wrong${follow ? `, ${follow} more ${follow === 1 ? "follows" : "follow"} from ${wrong === 1 ? "it" : "them"}` : ""}` : muted ? `${muted} muted, nothing else is known to be wrong` : judged ? (unknown ? "Nothing is known to be wrong" : "Nothing is wrong") : "Nothing is judged: no reference says what is expected";
  by("headline").replaceChildren(sign(judged ? snapshot.state : "unjudged"), make("span", { text: words }));
  by("counts").replaceChildren(...[...Object.entries(snapshot.counts), ["unjudged", snapshot.unjudged || 0]].filter(([, count]) => count)
    .map(([state, count]) => make("li", { class: "mark" }, sign(state), `${count.toLocaleString("en-US")} ${word(state)}`)));
  document.title = `${wrong ? `(${wrong}) ` : ""}${snapshot.title} · roslens watch`;
}

let summed = "";

let waiting = null;

/** Say at once how it stands; draw what is large in the next frame, the newest of several and none while nobody looks. */
function show(snapshot, read = 0) {
  const begun = performance.now();
  const sum = JSON.stringify([snapshot.counts, snapshot.unjudged, snapshot.state, snapshot.wrong, snapshot.follow, snapshot.muted?.length]);
  if (sum !== summed) headline(snapshot);
  summed = sum;
  by("when").textContent = snapshot.when.trim();
  by("cost").textContent = snapshot.cost && snapshot.live ? `costs ${snapshot.cost}` : snapshot.cost;
  alerts.update(snapshot);
  const spent = read + performance.now() - begun;
  if (!waiting) requestAnimationFrame(drawn);
  waiting = { snapshot, spent };
}

function drawn() {
  if (!waiting) return;
  const { snapshot, spent } = waiting;
  waiting = null;
  const begun = performance.now();
  tree.update(snapshot);
  picture.update(snapshot);
  way.show();
  causes.update(snapshot);
  happened.update(snapshot);
  detail.update(snapshot);
  const end = performance.now();
  performance.clearMeasures("snapshot");
  performance.measure("snapshot", { start: Math.max(begun - spent, 0), end });
}

const first = JSON.parse(by("first").textContent);
const { mark } = by("first").dataset;
if (mark) latest = first;
by("first").remove();
const moments = remembers ? new Moments({
  element: by("time"), slider: by("slider"), play: by("play"), speed: by("speed"), reach: by("reach"), marks: by("marks"), back: by("now"), then: by("then"),
  said: by("moment"), count: by("marks-said"), hold: by("hold"), differences: by("differences"), live: first.live,
}, went, (snapshot) => show(snapshot)) : null;
if (moments) new Sparks(tree, () => moments.at ?? moments.now);
const pulse = by("pulse");
const lost = by("lost");

/** What is shown of another moment is not how it is now. */
function sayPulse() {
  const { is } = pulse.dataset;
  const then = is !== "lost" && moments && moments.at !== null;
  by("pulse-word").textContent = then ? "past" : { live: "live", over: "recording", unsure: "connecting", lost: "lost" }[is];
}

function heard(state, seconds) {
  const calm = first.live ? "live" : "over";
  const is = state === "live" ? calm : state === "unsure" ? "unsure" : "lost";
  if (pulse.dataset.is !== is) {
    pulse.dataset.is = is;
    sayPulse();
    document.documentElement.classList.toggle("is-lost", is === "lost");
    lost.hidden = is !== "lost";
  }
  if (is !== "lost") return;
  const silent = state === "stuck" ? `The monitor has reported nothing new for ${Math.floor(seconds)} s.` : `Nothing heard from the monitor for ${Math.floor(seconds)} s.`;
  const text = `${silent} Below is how it was at ${by("when").textContent}.`;
  if (lost.textContent !== text) lost.textContent = text;
}

startShell();
startKeys();
search.value = parameters().get("q") || "";
worse.checked = parameters().get("worse") === "1";
tree.filter(search.value, worse.checked);
show(first);
drawn();
learn(first);
if (moments && !by("then").dataset.at) moments.update(first);

/** Take selection and moment from the address. */
function readAddress() {
  const at = Number.parseFloat(parameters().get("at"));
  if (moments && (moments.at ?? NaN) !== at && !(Number.isNaN(at) && moments.at === null)) moments.go(Number.isNaN(at) ? null : at, true);
  if (moments && moments.at === null && latest) show(latest);
  sayPulse();
  search.value = parameters().get("q") || "";
  worse.checked = parameters().get("worse") === "1";
  tree.filter(search.value, worse.checked);
  choose(parameters().get("select") || "", "address");
}

readAddress();
onReturn(readAddress);
const sees = new Sees(tree, picture, detail);
followNames((entity) => choose(entity, "alerts"));
listen(first, mark, sees.reader, heardOf, heard, () => sees.opened());

search.addEventListener("input", settled(filter, 80));
search.addEventListener("keydown", (event) => event.key === "Escape" && (search.value ? (search.value = "", filter()) : search.blur()));
worse.addEventListener("change", filter);
by("filters").addEventListener("submit", (event) => event.preventDefault());
for (const button of document.querySelectorAll("[data-zoom]")) {
  button.addEventListener("click", () => (button.dataset.zoom === "fit" ? picture.fit() : picture.zoom(Number(button.dataset.zoom))));
}
const inTree = (action) => (event) => (event.target.closest("#tree") ? action(event) : false);
onKey("j", () => tree.step(1));
onKey("k", () => tree.step(-1));
onKey("ArrowDown", inTree(() => tree.step(1)));
onKey("ArrowUp", inTree(() => tree.step(-1)));
onKey("ArrowRight", inTree(() => tree.turn(true)));
onKey("ArrowLeft", inTree(() => tree.turn(false)));
onKey("Enter", inTree((event) => choose(event.target.closest("tr")?.dataset.entity || "", "alerts")));
onKey("/", () => search.focus());
onKey("w", () => { worse.checked = !worse.checked; filter(); });
onKey("+", () => picture.zoom(1.4));
onKey("-", () => picture.zoom(1 / 1.4));
onKey("0", () => picture.fit());
onKey("Escape", () => choose("", "keys"));
if (moments) {
  onKey("[", () => moments.step(-1));
  onKey("]", () => moments.step(1));
  onKey("n", () => moments.go(null));
  onKey("p", () => moments.turn());
  by("happened").addEventListener("click", (event) => {
    const time = event.target.closest("[data-time]")?.dataset.time;
    if (time) moments.go(Number(time));
  });
}
