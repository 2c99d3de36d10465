"""Launch files as what they start.

In come the path of a launch file and its arguments; out comes a ``Launch``: nodes, settings and what was not
understood. Begin with ``launch_ros1.py`` or ``launch_ros2.py``; files in Python are evaluated by the room
``launch_python``.
"""
