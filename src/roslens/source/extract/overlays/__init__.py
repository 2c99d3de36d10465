"""What calls of libraries mean, a file for each library or part of one.

In come calls, with the values of their arguments and the evaluation as a ``Context``; out come values, and endpoints
and parameters that are noted in the node. Values of languages are in ``language``, those of ROS in ``ros``.
"""
