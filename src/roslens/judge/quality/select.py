"""Selectors: which entities a constraint is about."""

from __future__ import annotations

import fnmatch
import re
from collections.abc import Callable
from functools import lru_cache

from roslens.model.entity import Entity, EntityKind

EVERY = "*"


def matcher(pattern: str) -> Callable[[str], bool] | None:
    """Return a matcher of names for a glob, None if every name matches.

    ``*`` stands for any text, ``?`` for one character, ``[abc]`` for one of these. Case counts.
    """
    if pattern == EVERY:
        return None
    return _compiled(pattern)


@lru_cache(maxsize=1024)
def _compiled(pattern: str) -> Callable[[str], bool]:
    match = re.compile(fnmatch.translate(pattern)).match
    return lambda name: match(name) is not None


def name_of(entity: Entity) -> str:
    """Return the text that a pattern is held against: a file's path, the name of everything else."""
    return entity.path if entity.kind is EntityKind.FILE else entity.name
