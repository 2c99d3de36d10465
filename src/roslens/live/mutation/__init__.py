"""Known faults put into a healthy recording: which of them a reference sees, and at what price."""
