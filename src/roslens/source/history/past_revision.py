"""A past commit whose files were put somewhere to be analysed."""

from __future__ import annotations

import msgspec

from roslens.source.measure.remembered_facts import RememberedFacts


class PastRevision(msgspec.Struct, frozen=True):
    """Which past state of which workspace the folders of a run hold.

    Attributes:
        root: of the workspace.
        commit: git's hash; of a workspace of several repositories a hash of all of theirs.
        remembered: what was learned of the revisions before, in this process.
    """

    root: str
    commit: str
    remembered: RememberedFacts
