"""Where packages were before they were moved, by their manifests, which git finds again under another folder."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from roslens.source.history.commit_log import Commit

MANIFESTS = frozenset({"package.xml", "manifest.xml"})
"""Names of the files that make a folder a package; the second is that of rosbuild."""


class MovedPackages:
    """Tells which packages a commit moved from one folder to another."""

    def __init__(self, paths: Sequence[str]) -> None:
        """Take the paths of a log.

        Args:
            paths: of files, as :attr:`roslens.source.history.commit_log.CommitLog.paths` has them.
        """
        self._paths = paths
        self._folders = {
            place: folder
            for place, (folder, _, name) in enumerate(path.rpartition("/") for path in paths)
            if name in MANIFESTS
        }

    def moved_by(self, commit: Commit) -> Mapping[str, str]:
        """Return the earlier folder by the later one of each package that a commit moved.

        Manifests of different packages are much alike. So a manifest that git takes for a renamed one counts only where
        the folder kept its own name, or other files came with it, most of those that came to the folder by renaming.
        """
        found = {}
        for rename in commit.renames:
            old, new = self._folders.get(rename.old), self._folders.get(rename.new)
            if old is not None and new is not None and old != new and self._came_along(commit, old, new):
                found[new] = old
        return found

    def _came_along(self, commit: Commit, old: str, new: str) -> bool:
        if old and new and old.rpartition("/")[2] == new.rpartition("/")[2]:
            return True
        came = with_it = 0
        for rename in commit.renames:
            inside = _below(self._paths[rename.new], new)
            if inside and rename.new not in self._folders:
                came += 1
                with_it += _below(self._paths[rename.old], old) == inside
        return with_it > 0 and 2 * with_it >= came


def before_moves(folders: Mapping[str, str], moves: Mapping[str, str]) -> dict[str, str]:
    """Return the package of each folder as it was before a commit moved some of them.

    Who has a folder now that another came from got it later, and is not there yet.

    Args:
        folders: package by folder after the commit.
        moves: earlier folder by later one.
    """
    staying = {folder: package for folder, package in folders.items() if folder not in moves}
    return {**staying, **{old: folders[new] for new, old in moves.items() if new in folders}}


def _below(path: str, folder: str) -> str:
    """Return a path as seen from a folder above it; empty where it is not below."""
    if not folder:
        return path
    return path[len(folder) + 1 :] if path.startswith(f"{folder}/") else ""
