"""Where what is declared, extracted or observed meets: compared through the model only."""
