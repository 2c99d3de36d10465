"""The table of a library: its modules, the names of its packages, and its classes, each with its distributions."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from launch_signatures.library import Module, definition
from launch_signatures.signature import Signature, signature

Read = Mapping[str, Mapping[str, Module]]
"""The modules of all libraries by distribution, the oldest first."""
SUPPORTED = ("humble", "jazzy", "kilted")
_NONE = Module("", False)


def table(read: Read, library: str) -> Iterator[str]:
    """Yield the lines of a table."""
    modules = sorted({name for of in read.values() for name in of if name.partition(".")[0] == library})
    yield "[library]"
    for name in modules:
        if not name.rpartition(".")[2].startswith("_"):
            yield f'"{name}" = "{_span(read, (d for d, of in read.items() if name in of))}"'
    yield ""
    public: dict[str, str] = {}
    for name in modules:
        if any(of[name].is_package for of in read.values() if name in of):
            names = dict(_names(read, name, library))
            public |= {f"{name}.{one}": full for one, full in names.items()}
            yield from _module(read, name, names)
    for name in sorted(public):
        found = {d: signature(of, name) for d, of in read.items()}
        taken = {d: one for d, one in found.items() if one is not None}
        if taken:
            yield from _class(read, name, public[name], taken)


def _names(read: Read, module: str, library: str) -> Iterator[tuple[str, str]]:
    """Yield the public names of a package that are its library's, each with the full name that it leads to."""
    newest_first = [of.get(module, _NONE).names for of in reversed(read.values())]
    for name in sorted({one for names in newest_first for one in names}):
        full = next(names[name] for names in newest_first if name in names)
        if not name.startswith("_") and full.partition(".")[0] == library:
            yield name, full


def _module(read: Read, module: str, names: Iterable[str]) -> Iterator[str]:
    yield f'[modules."{module}"]'
    for name in names:
        there = (d for d, of in read.items() if name in of.get(module, _NONE).names)
        yield f'{name} = "{_span(read, there)}"'
    yield ""


def _class(read: Read, name: str, full: str, found: Mapping[str, Signature]) -> Iterator[str]:
    newest = next(reversed(found.values()))
    defined = definition(next(reversed(read.values())), full)
    supported = [one for d, one in found.items() if d in SUPPORTED] or [newest]
    yield f'[classes."{name}"]'
    yield f'defined = "{f"{defined[0].name}.{defined[1].name}" if defined else full}"'
    yield f'kind = "{newest.kind}"'
    yield f"positional = {_list(max((one.positional for one in found.values()), key=len))}"
    yield f"required = {_list(one for one in newest.required if all(one in each.required for each in supported))}"
    if any(one.is_open for one in found.values()):
        yield "open = true"
    keywords = dict.fromkeys(key for one in found.values() for key in one.keywords)
    spans = {key: _span(found, (d for d, one in found.items() if key in one.keywords)) for key in keywords}
    yield f"keywords = {_list(key for key, span in spans.items() if not span)}"
    yield from (f'at.{key} = "{span}"' for key, span in spans.items() if span)
    yield ""


def _list(words: Iterable[str]) -> str:
    return "[" + ", ".join(f'"{one}"' for one in words) + "]"


def _span(every: Iterable[str], there: Iterable[str]) -> str:
    """Return the first and last distribution, each left out where it is the first or last of all."""
    whole, some = list(every), list(there)
    first = "" if some[0] == whole[0] else some[0]
    last = "" if some[-1] == whole[-1] else some[-1]
    return f"{first}-{last}" if first or last else ""
