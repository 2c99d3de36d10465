"""Rule ``cpp.unjoined_thread``: a member that is a running thread when its object ends."""

from __future__ import annotations

import re
from collections.abc import Iterator

from roslens.model.source import Language, Role
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.syntax.comments import blank_comments

_THREAD = b"std::thread"
_STARTED = rb"(?<![\w.>])(?:this\s*->\s*)?%s\s*=\s*std::thread\s*[({]|(?<![\w.>])%s\s*[({]\s*(?:&|\[|std::bind)"
"""A thread that is given to a member, or with which one is initialised."""
_ENDED = (
    rb"(?<!\w)%s\s*(?:\.|->)\s*(?:join|detach|swap|joinable|native_handle)\b"
    rb"|std::(?:move|swap|ref)\s*\([^()]*\b%s\b|&\s*%s\b"
)
_DECLARED = rb"^[ \t]*(?:mutable[ \t]+)?std::thread[ \t]+(?:\w+[ \t]*,[ \t]*)*%s\b"


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each class with members of type ``std::thread`` that the package starts and neither joins nor detaches."""
    files = view.of_language(Language.CPP, Language.C, roles=(Role.OWN,))
    texts = {file.path: view.read(file.path) for file in files}
    texts = {path: blank_comments(text, "cpp") for path, text in texts.items() if b"thread" in text or b"join" in text}
    every = b"\n".join(texts.values())
    for path, text in texts.items():
        facts = view.facts.get(path)
        for one in facts.classes if facts is not None and _THREAD in text else ():
            names = [field.name for field in one.fields if not field.static and _is_kept(field.name, text, every)]
            places = {name: place for name in names if (place := _start(name, texts)) is not None}
            if places:
                yield _hit(one.name, places)


def _is_kept(name: str, text: bytes, every: bytes) -> bool:
    """Return whether a member is a thread that nothing in a package joins, detaches or hands on."""
    word = re.escape(name.encode())
    declared = re.search(_DECLARED % word, text, re.MULTILINE)
    return declared is not None and re.search(_ENDED % (word, word, word), every) is None


def _start(name: str, texts: dict[str, bytes]) -> tuple[str, int] | None:
    """Return the file and line in which a thread is started; None where none is."""
    word = re.escape(name.encode())
    for path, text in texts.items():
        started = re.search(_STARTED % (word, word), text)
        if started is not None:
            return path, text.count(b"\n", 0, started.start()) + 1
    return None


def _hit(of: str, places: dict[str, tuple[str, int]]) -> Hit:
    names = sorted(places, key=lambda name: places[name])
    path, line = places[names[0]]
    shown = ", ".join(f"`{one}`" for one in names)
    these = ("thread", "is", "it") if len(names) == 1 else ("threads", "are", "them")
    message = (
        f"{these[0]} {shown} of `{of}` {these[1]} started, and nothing in the package joins or detaches {these[2]}: "
        f"the destructor of `{of}` ends the program; expected `join()` there"
    )
    return Hit("cpp.unjoined_thread", message, line, context=f"{of} {' '.join(names)}", path=path)


RULE = PackageRule(
    id="cpp.unjoined_thread",
    title="Thread that nothing joins",
    finds="A member of type `std::thread` that is started, and that no code of the package joins, detaches or hands "
    "on; those of a class are one finding. Stop its loop in the destructor, and join it.",
    why="The destructor of a thread that still runs calls `std::terminate`: the node ends with a core dump at each "
    "shutdown, before what its other members should do then, such as to stop the motors.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("lifetime",),
    bad="Driver::Driver() { reader_ = std::thread(&Driver::read, this); }  // and no join",
    good="Driver::~Driver() { running_ = false; reader_.join(); }",
    found=found,
)
