"""Expected against actual: the graph as source, a running system, a recording and a reference have it."""
