"""Values as pictures and numbers: where bars, lines and marks stand, and how many digits are shown."""
