"""What source says of the nodes of a robot: from its packages and launch files to the graph that would run.

Rooms, from where commands begin down to what all need; an import goes only to a room below, and rooms between the same
semicolons do not know each other:

``workspace``; ``configuration``, ``units``; ``launch``, ``builds``; ``launch_python``, ``overlays``, ``catalogue``;
``interpreter``; ``transfer``; ``domain``; ``symbols``; ``parameters``, ``interfaces``, ``lowering``; ``facts``, ``ir``;
``symbolic``. The docstring of each says what comes in, what goes out, and where to begin.
"""
