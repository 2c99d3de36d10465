"""The commits of files under the names that they have today, back through the names that they had before."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from roslens.source.history.commit_log import Change, Commit, CommitLog


def followed_files(log: CommitLog, files: Mapping[str, str]) -> Iterator[tuple[Commit, dict[str, Change]]]:
    """Yield each commit that is no merge, the newest first, with what it changed of files.

    A commit that renames a file changes of it only the lines that are other; what is older counts under the earlier
    path. As in git, the path of a file does not end where the file was made: what was there before counts, too.

    Args:
        log: children before their parents.
        files: what each file is called, by its path at the head.
    """
    known = {place: {files[name]} for place, name in enumerate(log.paths) if name in files}
    for commit in log.commits:
        if commit.is_merge:
            continue
        renamed = {one.new: one for one in commit.renames}
        found = {}
        for change in commit.changes:
            for name in known.get(change.path, ()):
                rename = renamed.get(change.path)
                found[name] = Change(change.path, rename.added, rename.deleted) if rename else change
        yield commit, found
        # All at once: two files may have changed places.
        moved = [(one.old, known.pop(one.new, set())) for one in commit.renames]
        for old, names in moved:
            known[old] = known.get(old, set()) | names
