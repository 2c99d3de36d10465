"""The journal of what was decided and done, and the questions that wait for an answer, as pages."""
