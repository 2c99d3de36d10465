// Pages of computation graphs load this beside the script of every page.

import { startComputation } from "./graph/computation.js";
import { startDifference } from "./graph/difference.js";
import { alsoImprove } from "./improvements.js";

alsoImprove((root) => {
  const graph = root.querySelector("[data-graph]")?.dataset.graph;
  if (graph === "computation") startComputation(root);
  if (graph === "difference") startDifference(root);
});
