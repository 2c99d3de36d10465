"""What calls of ROS and of its libraries mean.

In come calls with evaluated arguments; out come handles, qualities of service and messages, and facts that are noted.
Begin with ``vocabulary_ros2.py`` or ``vocabulary_ros1.py``; ``emit.py`` notes what is made.
"""
