"""How many call sites of real code the evaluation of source understands, by tables labelled by reading it."""
