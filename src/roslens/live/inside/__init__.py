"""What runs in the user's node, and how it is read from outside.

In come calls of rclpy and rospy; out come counters in shared memory. Begin with ``slots.py``, their layout.

``slots``, ``counter_file``, ``sequence``, ``when_imported``, ``rclpy_hook`` and ``rclpy_state`` are loaded in the
node's own Python, where neither roslens nor msgspec may be installed: they import the standard library and each other
only, and run from Python 3.8 on.
"""
