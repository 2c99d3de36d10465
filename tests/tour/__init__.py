"""The pictures of docs/tour.md: what is opened and done for each."""
