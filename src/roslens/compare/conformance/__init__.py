"""Expected against actual: what source, a running system, a recording and a reference say of the same graph."""
