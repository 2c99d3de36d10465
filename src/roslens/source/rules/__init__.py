"""Rules that come with roslens: a folder for each family, one rule a file."""
