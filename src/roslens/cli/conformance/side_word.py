"""What a word of ``roslens compare`` means, as far as it can be determined without opening a workspace."""

from __future__ import annotations

import re
from enum import Enum
from pathlib import Path

from roslens.intake.bounded_file import read_bounded
from roslens.model.errors import UsageError

LIVE = "live"
_ADDRESS = re.compile(r"(https?://\S+|(?:[A-Za-z0-9.-]+|\[[0-9A-Fa-f:]+\]):[0-9]{1,5}/?)\Z")
_STORED = re.compile(r"[0-9]+:.+\Z")
_PACKED = ("", ".zstd", ".zst", ".lz4", ".gz", ".bz2")
_RECORDING = (".bag.active", *(f"{kind}{packed}" for kind in (".bag", ".mcap", ".db3") for packed in _PACKED))
_LAUNCH = (".launch", ".launch.py", ".launch.xml", ".launch.yaml", ".launch.yml", "_launch.py", ".test")
_KIND = re.compile(rb"^kind:\s*[\"']?(\w+)", re.MULTILINE)
_NODES = re.compile(rb"^nodes:", re.MULTILINE)


class WordKind(str, Enum):
    """What a word stands for.

    - live: what runs here now
    - address: a monitor that serves its page: ``roslens watch --serve``
    - workspace: a folder with packages
    - launch: a launch file, or a configuration of ``roslens.toml``
    - stored: a graph that a run keeps: ``3:drive.launch.xml``
    - document: a file that ``graph --format json`` wrote
    - written: a file that ``watch --graph-out`` wrote
    - recording: a bag
    - reference: what is expected
    - run: a kept run or a revision
    """

    LIVE = "live"
    ADDRESS = "address"
    WORKSPACE = "workspace"
    LAUNCH = "launch"
    STORED = "stored"
    DOCUMENT = "document"
    WRITTEN = "written"
    RECORDING = "recording"
    REFERENCE = "reference"
    RUN = "run"


def kind_of(word: str) -> WordKind:
    """Return what a word means; what means nothing else is the name of a run.

    Raises:
        UsageError: it is a file of which the content is nothing that can be compared.
    """
    if word == LIVE:
        return WordKind.LIVE
    path = Path(word)
    if path.is_dir():
        return WordKind.RECORDING if _holds_recording(path) else WordKind.WORKSPACE
    if path.is_file():
        return _of_file(path)
    if _STORED.match(word):
        return WordKind.STORED
    if _ADDRESS.match(word):
        return WordKind.ADDRESS
    if word.endswith(_LAUNCH):
        return WordKind.LAUNCH
    if word.endswith((*_RECORDING, ".yaml", ".yml", ".json")):
        raise UsageError(f'no file "{word}"', expected="a recording, a reference, or a graph that was written")
    return WordKind.RUN


def _holds_recording(folder: Path) -> bool:
    """Return whether a folder is a recording, not a workspace: it contains recordings and no packages."""
    if (folder / "package.xml").exists() or (folder / "src").is_dir():
        return False
    return (folder / "metadata.yaml").is_file() or any(one.name.endswith(_RECORDING) for one in folder.iterdir())


def _of_file(path: Path) -> WordKind:
    name = path.name
    if name.endswith(_RECORDING):
        return WordKind.RECORDING
    if name.endswith(_LAUNCH):
        return WordKind.LAUNCH
    if name.endswith(".json"):
        return WordKind.DOCUMENT
    if name.endswith((".yaml", ".yml")):
        content = read_bounded(path)
        found = _KIND.search(content)
        if found and found[1] == b"reference":
            return WordKind.REFERENCE
        if _NODES.search(content):
            return WordKind.WRITTEN
        if re.search(rb"^launch:", content, re.MULTILINE):
            return WordKind.LAUNCH
    raise UsageError(
        f'"{path}" is nothing that can be compared',
        expected="a recording, a reference (kind: reference), a graph that `watch --graph-out` or "
        "`graph --format json` wrote, or a launch file",
    )
