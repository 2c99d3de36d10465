"""``roslens compare`` of sides: source, what runs, recordings and references.

In come words that name sides; out come sides and what they say differently. Begin with ``compare_sides.py``.
"""
