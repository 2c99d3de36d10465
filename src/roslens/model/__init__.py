"""The nouns of roslens: frozen, typed values without I/O and without a clock."""
