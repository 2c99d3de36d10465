"""What carries out actions: in a process that has ROS, or on a host; each kind is a file in ``actions``.

In come orders; out come replies with what was done or why not. Begin with ``ros.py``, which says what an action may
ask of a ROS system; ``host.py`` says what it may ask of a host.
"""
