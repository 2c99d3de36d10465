"""What a native rule found, before it is known whether anybody wants to hear of it."""

from __future__ import annotations

import msgspec

from roslens.model.edit import Edit
from roslens.model.weight.consequence import Certainty, Consequence

HEADER, SOURCE, GUARDED = "header", "source", "guarded"
"""Values of ``only``: for files that are included by others, for those that are compiled, and for headers that must be
guarded: pieces of headers such as ``.ipp`` and ``.inl``, which one header includes at its end, need not be."""


GUARD_NAME = "\0GUARD\0"
"""In the text of an edit: the name of the header guard, which the path of the file tells."""


EITHER = "|"
"""Between the functions of which one has to be a callback, in ``callback`` of a hit."""


class Hit(msgspec.Struct, frozen=True, array_like=True, omit_defaults=True):
    """A place that a rule is about. It is kept by content: of its file it only says the lines, counted from 1.

    Attributes:
        rule: id.
        message: what was found, quoted, and what was expected.
        line: 1-based, as ``column`` (in bytes), ``end_line`` and ``end_column`` are; 0 is unknown.
        context: the flagged text; with its function it tells the finding again when lines move.
        path: below the workspace, of hits of rules on packages; empty for the file itself.
        only: it counts in headers (:data:`HEADER`, :data:`GUARDED`) or in other files (:data:`SOURCE`) only; which of
            them a file is, its name tells.
        callback: it counts where this function, as qualified in the file, is a callback of some file of the package; or
            where some file declares this member (:mod:`~roslens.source.rules.cpp_flow.member_facts`).
        certainty: where it is less certain than the rule; what is heuristic then is a note, for the readings that
            confirm a rule are of what it is certain of.
        entity: text form of the id it is about, where that is not the innermost one around the line.
        edits: what mends it; those without a path are of the file itself. :data:`GUARD_NAME` in their text stands for
            the name that a header guard of the file has.
        consequence: where it is milder than that of the rule.
        change: key of the row of :mod:`~roslens.source.distributions.read_changes` that it is about; what that means
            depends on what the package is built for.
    """

    rule: str
    message: str
    line: int = 0
    column: int = 0
    end_line: int = 0
    end_column: int = 0
    context: str = ""
    path: str = ""
    only: str = ""
    callback: str = ""
    certainty: Certainty | None = None
    entity: str = ""
    edits: tuple[Edit, ...] = ()
    consequence: Consequence | None = None
    change: str = ""
