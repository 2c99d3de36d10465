"""How a live system stood at any instant of its history: moments, stretches of series, marks."""
