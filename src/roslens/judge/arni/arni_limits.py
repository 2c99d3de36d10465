"""The limits in a specification of ARNI: ``[low, high]``, ``[centre, part, relative]``, or a list of such."""

from __future__ import annotations

import math
from decimal import Decimal

from roslens.judge.arni.arni_fields import ArniField
from roslens.judge.documents.document import described
from roslens.judge.documents.yaml_tree import Items, Node, Scalar
from roslens.judge.ranges.range import Range, plain
from roslens.model.quantity import Quantity


def number_of(node: Node) -> Decimal | None:
    """Return a number, None where a node is none or is not finite."""
    if not isinstance(node, Scalar) or len(node.text) > 40:
        return None
    try:
        return Decimal(node.text) if math.isfinite(float(node.text)) else None
    except (ValueError, ArithmeticError):
        return None


def read_limits(node: Node, meaning: ArniField, quantity: Quantity) -> tuple[Range, list[str]]:
    """Return limits in the unit of a signal, and what has changed about them.

    Bounds that every value keeps are left out.

    Args:
        node: what stands behind the field.
        meaning: of the field.
        quantity: the signal.

    Raises:
        ValueError: they are none, or cannot be said of the signal.
    """
    if not isinstance(node, Items) or not node.nodes:
        raise ValueError(f"it is {described(node)}, expected [low, high]")
    notes: list[str] = []
    if isinstance(node.nodes[0], Items):
        ranges = [_pair(one, notes) for one in node.nodes]
        if len(set(ranges)) > 1:
            raise ValueError("its ranges are different, and roslens has one for all")
        if not meaning.array:
            notes.append("the first of several ranges, as in ARNI")
    else:
        ranges = [_pair(node, notes)]
    low, high = (float(bound * Decimal(meaning.factor)) for bound in ranges[0])
    words = f"{plain(low)}..{plain(high)}"
    sensible = Range(quantity.minimum, quantity.maximum)
    if not Range(low, high).overlaps(sensible):
        raise ValueError(f"no value can be in {words}, expected a part of {sensible}")
    least = None if quantity.minimum is not None and low <= quantity.minimum else low
    most = None if quantity.maximum is not None and high >= quantity.maximum else high
    if least is None and most is None:
        raise ValueError(f"every value is in {words}")
    return Range(least, most), notes


def _pair(node: Node, notes: list[str]) -> tuple[Decimal, Decimal]:
    """Return the lower and the upper limit.

    Raises:
        ValueError: there are not two numbers.
    """
    if not isinstance(node, Items) or len(node.nodes) < 2:
        raise ValueError(f"a range is {described(node)}, expected [low, high]")
    first, second = (number_of(one) for one in node.nodes[:2])
    if first is None or second is None:
        texts = ", ".join(described(one) for one in node.nodes[:2])
        raise ValueError(f"[{texts}] are not two numbers, which ARNI rated unknown")
    third = node.nodes[2] if len(node.nodes) > 2 else None
    if isinstance(third, Scalar) and third.text.lower().startswith("r"):
        part = second - 1 if second > 1 else second
        if second > 1:
            notes.append(f"its part {second} is above 1, so ARNI took 1 off it")
        first, second = first - first * part, first + first * part
    low, high = sorted((first, second))
    return low, high
