// Tells the monitor what can be seen of the page, so that it need not make anything else four times a second.

const LOOK_MS = 200;
const MOST = 400;

export class Sees {
  constructor(tree, picture, detail) {
    Object.assign(this, { tree, picture, detail, sent: "", open: false, asking: false });
    this.reader = crypto.getRandomValues(new Uint32Array(3)).reduce((text, one) => text + one.toString(16).padStart(8, "0"), "");
    setInterval(() => this.look(), LOOK_MS);
  }

  /** A stream was opened: of this reader nothing is known there yet. */
  opened() {
    this.open = true;
    this.sent = "";
    this.look();
  }

  async look() {
    if (!this.open || this.asking || document.hidden) return;
    const words = this.picture.wordsSeen(MOST);
    const seen = { reader: this.reader, rows: this.tree.keysSeen().slice(0, MOST).join("."), select: this.detail.entity, picture: this.picture.seen ? "1" : "" };
    if (words.length) seen.links = `${this.picture.version}:${words.join(".")}`;
    const now = new URLSearchParams(seen).toString();
    if (now === this.sent) return;
    this.asking = true;
    try {
      const answer = await fetch(`sees?${now}`);
      // Who is not known yet says it again.
      if (answer.status !== 200) this.sent = now;
    } catch {
      // The page says by itself that nothing is heard of the monitor.
    }
    this.asking = false;
  }
}
