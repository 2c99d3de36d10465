"""How messages say what they say."""
