"""ROS 1 observed by its own protocols, XML-RPC and TCPROS; nothing of ROS is imported.

In come answers of the master and of nodes; out come frames on standard output. Begin with ``observation.py``.
"""
