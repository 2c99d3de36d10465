"""Ranges, amounts with units, and where a value stands to them; and QoS that is offered against QoS that is requested.

In come a value and a range; out comes a rating. Begin with ``range.py``.
"""
