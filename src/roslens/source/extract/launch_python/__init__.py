"""Launch files in Python: programs of the one interpreter, over what launch and launch_ros mean.

In comes a file; out come actions and substitutions (``launch_action.py``, ``deferred.py``). Begin with
``launch_python.py``; ``launch_program.py`` says what the interpreter does otherwise here, ``launch_words.py`` what
calls mean.
"""
