"""The files of the repositories of a workspace, as they stood together, in a folder of our own."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import ExitStack
from pathlib import Path
from types import TracebackType

from roslens.source.history.past_states import PastState, RepositoryPast
from roslens.source.history.past_tree import PastTree


class PastTrees:
    """A folder that holds one state at a time; a context manager.

    Attributes:
        folder: where it is.
        lacking: files of the state that git does not have, below the folder.
    """

    def __init__(self, repositories: Sequence[RepositoryPast], folder: Path) -> None:
        """Take the repositories and an empty folder of our own."""
        self.folder = folder
        self.lacking: tuple[str, ...] = ()
        self._opened = ExitStack()
        self._trees = {one.place: PastTree(one.top, one.below, folder / one.place) for one in repositories}
        self._shown: dict[str, str] = {}

    def __enter__(self) -> PastTrees:
        """Return the trees themselves."""
        for place, tree in self._trees.items():
            (self.folder / place).mkdir(parents=True, exist_ok=True)
            self._opened.enter_context(tree)
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """End git."""
        self._opened.close()

    def show(self, state: PastState) -> list[str]:
        """Make the folder hold the files of a state; return the paths that were written or removed.

        Raises:
            HistoryError: git does not have the list of files.
        """
        changed = []
        for place, commit in state.commits:
            if self._shown.get(place, "") != commit:
                # Half shown, should git fail.
                self._shown[place] = "?"
                changed += [_below(place, path) for path in self._trees[place].show(commit)]
                self._shown[place] = commit
        self.lacking = tuple(_below(place, path) for place, tree in self._trees.items() for path in tree.lacking)
        return changed


def _below(place: str, path: str) -> str:
    return path if place == "." else f"{place}/{path}"
