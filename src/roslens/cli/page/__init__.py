"""What the live page is given: the past of a watch, its references, what somebody noted of its alerts."""
