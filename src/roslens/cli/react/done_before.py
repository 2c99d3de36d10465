"""What a monitor did before it was started again, by its journal."""

from __future__ import annotations

import time
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from roslens.model.acting.reaction import Decision


def done_before(path: Path, within_s: float) -> Iterator[tuple[Decision, float]]:
    """Yield what was done before this process began, and how many seconds ago: a monitor that crashes counts on."""
    import msgspec

    from roslens.model.acting.reaction import ActionCall, Decision
    from roslens.store.journals.read_journal import JournalReader

    now = time.time()
    reader = JournalReader(path)
    try:
        for entry in reader.entries():
            if entry.what != "announced" or not 0 <= now - entry.time < within_s:
                continue
            fields = entry.fields
            try:
                action = msgspec.convert(fields["action"], ActionCall)
                reported = [str(fields[name]) for name in ("decision", "reaction", "entity")]
            except (KeyError, msgspec.ValidationError):
                continue
            yield Decision(reported[0], reported[1], reported[2], 0, action, entry.time), now - entry.time
    finally:
        reader.close()
