"""What follows from which thing leads to which, whatever the things are."""
