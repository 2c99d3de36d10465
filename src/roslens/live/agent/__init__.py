"""What runs on each host: samples the machine and its processes and sends packed records, never payloads.

In come counters of the operating system and of nodes; out come samples over an authenticated line, and what was done
of requests. Begin with ``link.py``.
"""
