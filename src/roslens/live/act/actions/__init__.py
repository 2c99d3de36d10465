"""Kinds of action, one file each: how it is prepared and how it is done.

In come a ROS system or a host and what is asked; out comes what was done, in words, or an error. Begin with
``call.py``.
"""
