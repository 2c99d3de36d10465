"""``roslens compare`` of sides: source, what runs, recordings and references."""
