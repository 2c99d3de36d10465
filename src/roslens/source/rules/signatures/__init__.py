"""Signatures of launch, launch_ros, launch_xml and launch_yaml by distribution, as tables, and their readers.

In come tables; out come classes and the names of modules. Begin with ``read_signatures.py``.
"""
