"""``roslens clean``: undo what roslens left in a workspace, or let go of old runs."""

from __future__ import annotations

import argparse

TEXT = "Remove the cache, old runs or everything that roslens keeps for a workspace."
EXAMPLES = """\
  roslens clean                  remove the cache; runs stay
  roslens clean --keep 10        remove all but the ten newest runs
  roslens clean --all            remove the whole .roslens folder"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what to remove."""
    from roslens.cli.workplace.workplace import add_workspace_argument

    add_workspace_argument(parser)
    what = parser.add_mutually_exclusive_group()
    what.add_argument("--keep", type=int, metavar="N", help="keep the N newest runs, remove the others")
    what.add_argument("--all", action="store_true", help="remove runs, cache and logs")


def run(options: argparse.Namespace) -> int:
    """Remove, and report what was removed.

    Raises:
        UsageError: nothing is kept there, or N is less than one.
    """
    import shutil
    from pathlib import Path

    from roslens.cli.workplace.own_store import open_own
    from roslens.cli.workplace.workplace import CACHE, FOLDER, STORE, aside_of, find_folder
    from roslens.model.errors import UsageError

    if options.all:
        path = Path(options.path).resolve()
        kept = ((above / FOLDER, aside_of(above)) for above in (path, *path.parents))
        folders = next((one for one in kept if any((each / STORE).is_file() for each in one)), (path / FOLDER,))
        # Also what was made by others, which no other command touches; of a link only the link.
        there = [one for one in folders if one.is_symlink() or one.exists()]
        if not there:
            find_folder(options.path)
        for folder in there:
            if folder.is_symlink() or folder.is_file():
                folder.unlink()
            else:
                shutil.rmtree(folder)
            print(f"removed {folder}")
        return 0
    folder = find_folder(options.path)
    if options.keep is not None:
        if options.keep < 1:
            raise UsageError(f"--keep {options.keep}", expected="at least 1", advice="Use --all to remove everything")
        with open_own(folder / STORE) as store:
            removed = store.prune(options.keep)
        print(f"removed {removed} runs, kept the newest {options.keep}")
        return 0
    for name in (CACHE, f"{CACHE}-wal", f"{CACHE}-shm"):
        (folder / name).unlink(missing_ok=True)
    print(f"removed the cache in {folder}; the runs are still there")
    return 0
