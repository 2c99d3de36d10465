"""`roslens watch --prometheus` and `--diagnostics`: where journals of this host end goes along with verdicts."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from roslens.store.journals.journal_head import JournalHead

_OWN = ("journal.jsonl", "agent-journal.jsonl")
"""Of ``roslens react`` and of ``roslens agent``, in the state folder of the user."""


def heads_of(named: Sequence[Path] | None, environment: Mapping[str, str]) -> Callable[[], tuple[JournalHead, ...]]:
    """Return what tells where journals end now: those of this user, or those that were named.

    What is neither there nor was ever signed is left out.
    """
    from roslens.cli.workplace.journal_key import journal_signing
    from roslens.intake.user_folder import state_folder, user_folder
    from roslens.store.journals.journal_head import journal_head

    paths = [path.absolute() for path in named or (state_folder(environment) / name for name in _OWN)]

    def heads() -> tuple[JournalHead, ...]:
        signed = (user_folder(environment) / "journals").is_dir()
        # A user who has no journal needs no secret either.
        there = [path for path in paths if signed or path.exists()]
        found = (journal_head(path, journal_signing(path, environment)) for path in there)
        return tuple(one for one in found if one is not None)

    return heads
