// The page of the package graph loads this beside the script of every page.

import { startGraph } from "./graph/graph.js";
import { alsoImprove } from "./improvements.js";

alsoImprove((root, chips) => {
  if (root.querySelector("[data-graph]")?.dataset.graph === "packages") startGraph(root, chips);
});
