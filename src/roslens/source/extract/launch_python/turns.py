"""The turns of the loops of launch: ``ForEach`` over sets of values in YAML, ``ForLoop`` over numbers.

The sets are parted by semicolons (``launch/actions/for_loop.py``); each is a table of what the turn gets by name.
"""

from __future__ import annotations

from roslens.intake.safe_yaml import UnsafeYamlError, load_yaml
from roslens.source.extract.launch_python.launch_values import Plain
from roslens.source.extract.symbolic.text import Text

MOST_TURNS = 200


def turns_over(values: Text) -> list[dict[str, Plain]] | None:
    """Return what each turn over sets of values gets; None where that is not known."""
    known = values.known
    if known is None:
        return None
    pieces = [piece for piece in known.strip().split(";") if piece]
    try:
        found = [load_yaml(piece.strip().encode()) for piece in pieces[:MOST_TURNS]]
    except (UnsafeYamlError, RecursionError):
        return None
    turns = []
    for one in found:
        match one:
            case dict():
                turns.append({str(name): value for name, value in one.items()})
            case None:
                pass
            case _:
                return None
    return turns


def turns_up_to(length: Text, name: str) -> list[dict[str, Plain]] | None:
    """Return what each of so many turns gets; None where it is not known how many there are."""
    known = length.known
    try:
        count = int(known) if known is not None else None
    except ValueError:
        return None
    return None if count is None or count > MOST_TURNS else [{name: number} for number in range(count)]
