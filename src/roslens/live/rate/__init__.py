"""Rating: what has news or is due is judged against the reference, and nothing else.

In come tallies, samples, events and the time; out come changed verdicts. Begin with ``monitor.py``; ``evaluator.py``
decides what is looked at.
"""
