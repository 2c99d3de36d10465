"""What calls of the libraries of C++ and Python mean: texts, lists, numbers, times, command lines.

In come calls with evaluated arguments; out come values. Begin with ``vocabulary_texts.py``; ``command_words.py`` is
about the words of a command line.
"""
