"""What a launch file in Python reads of other files: YAML of the workspace, by ``open`` and ``yaml.safe_load``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from roslens.intake.safe_yaml import UnsafeYamlError, load_yaml
from roslens.source.extract.domain.abstract_value import Foreign, Unknown
from roslens.source.extract.launch_python.deferred import Deferred, Scope, resolve
from roslens.source.extract.launch_python.launch_values import as_value
from roslens.source.extract.symbolic.text import Text

if TYPE_CHECKING:
    from roslens.source.extract.facts.files import Files

_LOADS = frozenset({"yaml.safe_load", "yaml.load", "yaml.full_load", "yaml.unsafe_load"})
_OPENS = frozenset({"open", "io.open"})
READS = _LOADS | _OPENS
_MOST_BYTES = 1_000_000


class Opened(Foreign, frozen=True):
    """A file that is read, by its path in the workspace."""

    path: str


def read(function: str, positional: list[Any], path: str, files: Files | None, scope: Scope | None) -> Any:
    """Return what opening or loading a file gives.

    Args:
        function: one of ``READS``.
        positional: its arguments.
        path: of the launch file.
        files: of the workspace.
        scope: of the action that is visited; None while the file is read.
    """
    reason = Unknown(f"result of {function}()")
    first = positional[0] if positional else None
    if files is None or first is None:
        return reason
    if function in _OPENS:
        if not isinstance(first, str | Text | Deferred):
            return reason
        found = resolve(as_value(first), scope or Scope(files, {}, {}, path)).known
        return reason if found is None or files.content(found) is None else Opened(found)
    content = _content(first, files)
    return reason if content is None or len(content) > _MOST_BYTES else _loaded(content, reason)


def _content(first: Any, files: Files) -> bytes | None:
    if isinstance(first, Opened):
        return files.content(first.path)
    return first.encode() if isinstance(first, str) else None


def _loaded(content: bytes, reason: Unknown) -> Any:
    try:
        return _plain(load_yaml(content))
    except (UnsafeYamlError, RecursionError):
        return reason


def _plain(value: Any) -> Any:
    match value:
        case dict():
            return {
                key if isinstance(key, str | int | float | bool) else str(key): _plain(one)
                for key, one in value.items()
            }
        case list():
            return [_plain(one) for one in value]
    return value if isinstance(value, str | int | float | bool | None) else str(value)
