"""Answers to the question why something does not arrive: steps in order, each with its evidence."""
