"""How much findings matter: consequence, certainty, and the severity that follows from them."""
