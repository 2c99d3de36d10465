"""One page per module: a pure function from a site and a request to what the page shows."""
