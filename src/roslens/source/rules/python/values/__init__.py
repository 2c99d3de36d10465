"""Values of Python that a name or a pattern does not get."""
