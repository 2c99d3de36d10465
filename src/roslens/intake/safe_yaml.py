"""YAML of strangers as plain values: no objects are made, and neither depth nor aliases can exhaust the machine.

Nine lines of aliases of aliases stand for a thousand million values, and a hundred thousand brackets end the process:
libyaml composes nested nodes by calling itself. So the events of a document are counted before anything is made of it.
"""

from __future__ import annotations

import re
from typing import Any

MOST_BYTES = 5_000_000
MOST_VALUES = 200_000
"""Values with those that aliases stand for."""

MOST_DEPTH = 100
MOST_DIGITS = 1_000
"""Of a number: what ``1:59:59:59`` stands for, base 60, takes the square of its length."""

_NUMBER = re.compile("[-+]?[0-9][0-9_:.]*")


class UnsafeYamlError(ValueError):
    """The text is no YAML, or is more than is taken in."""


def load_yaml(text: str | bytes) -> Any:
    """Return the values of a document as lists, mappings and scalars.

    Raises:
        UnsafeYamlError: the text is no YAML of one document, has a tag that asks for an object, is too long, too deep,
            or stands for too many values or for a number of too many digits.
    """
    import yaml

    if len(text) > MOST_BYTES:
        raise UnsafeYamlError(f"{len(text):,} bytes of YAML; at most {MOST_BYTES:,} are read")
    loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
    try:
        _count(yaml.parse(text, loader))
        return yaml.load(text, loader)  # noqa: S506 - both loaders are safe
    except UnsafeYamlError:
        raise
    except (yaml.YAMLError, ValueError, RecursionError, OverflowError) as error:
        raise UnsafeYamlError(" ".join(str(error).split())) from error


def _count(events: Any) -> None:
    import yaml

    # What has no anchor is kept under None, which no alias names.
    weights: dict[str | None, int] = {}
    open_ones: list[tuple[str | None, int]] = []
    total = 0
    for event in events:
        if isinstance(event, yaml.CollectionStartEvent):
            open_ones.append((event.anchor, total))
            total += 1
            if len(open_ones) > MOST_DEPTH:
                raise UnsafeYamlError(f"lists and tables more than {MOST_DEPTH} deep")
        elif isinstance(event, yaml.CollectionEndEvent):
            anchor, before = open_ones.pop()
            weights[anchor] = total - before
        elif isinstance(event, yaml.AliasEvent):
            # An alias of what it stands in is one value: it stands for no more than what is there already.
            total += weights.get(event.anchor, 1)
        elif isinstance(event, yaml.ScalarEvent):
            total += 1
            weights[event.anchor] = 1
            if event.implicit[0]:
                _refuse_long_number(event)
        if total > MOST_VALUES:
            raise UnsafeYamlError(f"more than {MOST_VALUES:,} values, with those that aliases stand for")


def _refuse_long_number(event: Any) -> None:
    text: str = event.value
    if len(text) > MOST_DIGITS and _NUMBER.fullmatch(text):
        what = f"the number {text[:20]}… in line {event.start_mark.line + 1} has {len(text):,} characters"
        raise UnsafeYamlError(f"{what}; at most {MOST_DIGITS:,} are read")
