"""``snapshot``: how things stand, kept for the post-mortem."""

from __future__ import annotations

import json
import os
import re
import time
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import msgspec

from roslens.live.act.ros import ActionError
from roslens.model.acting.reaction import Decision
from roslens.model.entity import EntityId
from roslens.model.graph import Graph
from roslens.model.verdict import Verdict

_NAME = re.compile(r"[^A-Za-z0-9._-]+")


class Standing(msgspec.Struct, frozen=True):
    """How things stand at one moment.

    Attributes:
        graph: who is there.
        verdicts: that stand.
        values: latest ones of each entity.
        log: what happened before, one line each, oldest first.
    """

    graph: Graph
    verdicts: tuple[Verdict, ...]
    values: tuple[tuple[EntityId, dict[str, float]], ...]
    log: tuple[str, ...]


def act(decision: Decision, standing: Standing, folder: Path) -> str:
    """Write it into a folder of its own below ``folder``.

    Raises:
        ActionError: it cannot be written.
    """
    name = f"{time.strftime('%Y%m%dT%H%M%S', time.gmtime(decision.at_s))}-{_NAME.sub('_', decision.id)[:80]}"
    place = folder / name
    try:
        place.mkdir(parents=True, mode=0o700)
        for file, content in _files(decision, standing):
            target = os.open(place / file, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
            with os.fdopen(target, "w", encoding="utf-8", errors="replace") as stream:
                stream.write(content)
    except OSError as error:
        raise ActionError(f"{place} cannot be written: {error.strerror or error}") from None
    return f"kept in {place}"


def _files(decision: Decision, standing: Standing) -> Iterable[tuple[str, str]]:
    yield "decision.json", _json(decision)
    yield "graph.json", _json(standing.graph)
    yield "verdicts.json", _json([{**msgspec.to_builtins(one), "entity": str(one.entity)} for one in standing.verdicts])
    yield "values.json", _json({str(entity): values for entity, values in standing.values})
    yield "processes.json", _json(standing.graph.processes)
    yield "log.txt", "".join(f"{line}\n" for line in standing.log)


def _json(value: Any) -> str:
    return json.dumps(msgspec.to_builtins(value), indent=1, ensure_ascii=False, sort_keys=True) + "\n"
