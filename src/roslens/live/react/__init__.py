"""What is done about faults: conditions over time, gates that hold actions back, and who is asked to act.

In come steps of a session and reactions; out come decisions, journal entries and orders. Begin with ``reactor.py``,
which decides; ``actor.py`` joins gates, hands and journal.
"""
