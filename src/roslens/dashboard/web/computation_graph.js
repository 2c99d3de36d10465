// Pages of computation graphs load this beside the script of every page.

import { startComputation } from "./graph/computation.js";
import { alsoImprove } from "./improvements.js";

alsoImprove((root) => {
  if (root.querySelector("[data-graph]")?.dataset.graph === "computation") startComputation(root);
});
