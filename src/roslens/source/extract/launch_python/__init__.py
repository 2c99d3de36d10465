"""Launch files in Python, evaluated from their syntax tree over what launch and launch_ros mean.

In comes the tree of a file; out come actions and substitutions (``launch_action.py``, ``deferred.py``). Begin with
``launch_python.py``; ``python_interpreter.py`` follows statements.
"""
