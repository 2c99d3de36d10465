"""Where the packages stand in the package graph: pure functions, the same output for the same input."""
