"""Answers of ``roslens why``.

In comes an answer; out comes text or JSON. Begin with ``answer_text.py``.
"""
