"""The protocols of ROS 1: messages, handshakes, calls.

In come bytes of connections and definitions of messages; out come messages. Begin with ``tcpros.py``.
"""
