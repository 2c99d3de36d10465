"""What README and SECURITY promise, sentence by sentence, and the test that shows each."""
