// What only some pages need improves them too, by scripts of their own that come after the one of every page.

const improvements = [];
let newest = null;

/** Have `improve` called with each part of the page that is new, and with what its fields for tags have become. */
export function alsoImprove(improve) {
  improvements.push(improve);
  if (newest) improve(newest.root, newest.chips);
}

/** Improve a part of the page by whatever was asked for, now and as it comes. */
export function improveFurther(root, chips) {
  newest = { root, chips };
  for (const improve of improvements) improve(root, chips);
}
