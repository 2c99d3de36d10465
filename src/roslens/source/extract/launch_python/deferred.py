"""Values of ROS 2 launch files that are known only when an action is visited: substitutions, in one form.

Names are those of the substitutions of ``launch`` and ``launch_ros``; what they come to depends on the launch
configurations that hold at that moment.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

import msgspec

from roslens.source.extract.domain.abstract_value import Foreign
from roslens.source.extract.facts.files import Files, joined
from roslens.source.extract.facts.launched import Fault
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.symbolic.python_expression import FailsError, UnknownError, evaluate
from roslens.source.extract.symbolic.reason import (
    InstalledAt,
    NotSet,
    OfEnvironment,
    OfPackage,
    RandomEnd,
    RewrittenFile,
)
from roslens.source.extract.symbolic.text import Hole, Text, unknown

_MOST_DEPTH = 40


class Deferred(Foreign, frozen=True):
    """A substitution.

    Attributes:
        kind: ``text`` (parts one after the other), ``configuration``, ``optional`` (a configuration that need not be
            set), ``environment``, ``share``, ``prefix``, ``path`` (parts joined by ``/``), ``join`` (a delimiter, and
            the parts that it joins), ``content`` (of a file), ``turn`` (what a loop gives its actions, by name),
            ``python``, ``not``, ``and``, ``or``, ``equals``, ``unequal``, ``if`` (condition, then, else), ``folder``,
            ``file``, ``anonymous``, ``command``, ``rewritten`` (a file of parameters, and what
            ``file_changes.written_changes`` makes of its changes) ``refused`` (what is
            written, and why launch refuses it) or ``unknown`` (with the reason).
        parts: what it is made of; of ``configuration`` and ``environment`` the name, and the default if there is one.
    """

    kind: str
    parts: tuple[Deferred | Text | str, ...] = ()


class Scope(msgspec.Struct):
    """What holds where an action is visited.

    Attributes:
        files: of the workspace.
        configurations: launch configurations by name.
        environment: variables that are known.
        path: of the launch file.
        assigned: variables of the environment that an action before may have changed; ``*`` for all.
        turns: what the loops around give their actions, by name.
        rewritten: paths of files of which a copy is made, with the changes that are made to it, as texts.
        report: is told what ends the launch with an error: the fault, what is written, why, and :attr:`at`.
        at: where that stands; None for the action that is visited.
    """

    files: Files
    configurations: dict[str, Text]
    environment: Mapping[str, str]
    path: str
    assigned: set[str] = set()
    turns: Mapping[str, Text] = MappingProxyType({})
    rewritten: list[tuple[Text, ...]] = []
    report: Callable[[Fault, str, str, Evidence | None], object] | None = None
    at: Evidence | None = None

    def silent(self) -> Scope:
        """Return the scope where nothing is reported, as it is not certain that what is resolved is needed."""
        return msgspec.structs.replace(self, report=None) if self.report is not None else self


Value = Deferred | Text | str


def resolve(value: Value, scope: Scope, depth: int = 0) -> Text:
    """Return what a value comes to in a scope; what is unknown is a hole with its reason."""
    match value:
        case str():
            return Text.of(value)
        case Text():
            return value
    if depth > _MOST_DEPTH:
        return unknown("too deeply nested substitutions")
    method = _KINDS.get(value.kind)
    if method is None:
        return unknown(str(value.parts[0]) if value.parts else value.kind)
    first = _NEEDED.get(value.kind)
    if first is None or scope.report is None:
        return method([resolve(part, scope, depth + 1) for part in value.parts], scope)
    silent = scope.silent()
    parts = [resolve(part, scope if place < first else silent, depth + 1) for place, part in enumerate(value.parts)]
    return method(parts, scope)


def truth(text: Text) -> bool | None:
    """Return the value of a condition; None if it is unknown.

    Raises:
        ValueError: it is neither true nor false.
    """
    known = text.known
    if known is None:
        return None
    value = known.strip().lower()
    if value in ("true", "1", "yes", "on"):
        return True
    if value in ("false", "0", "no", "off", ""):
        return False
    raise ValueError(f"{known!r} is not a condition; expected `true` or `false`")


def condition_holds(text: Text) -> bool | None:
    """Return whether a condition of an action holds; None if it is unknown.

    launch takes fewer words for it than for the values of its substitutions (evaluate_condition_expression_impl.py).

    Raises:
        ValueError: launch takes it for neither.
    """
    known = text.known
    if known is not None and known.strip().lower() not in ("true", "1", "false", "0"):
        raise ValueError(f"{known!r} is not a condition; expected `true`, `1`, `false` or `0`")
    return truth(text)


def _said(parts: list[Text], decide: Callable[[list[bool]], bool]) -> Text:
    try:
        found = [truth(part) for part in parts]
    except ValueError as error:
        return unknown(str(error))
    if None in found:
        return _first_hole(parts)
    return Text.of("true" if decide([one for one in found if one is not None]) else "false")


def _first_hole(parts: list[Text]) -> Text:
    return Text((next(part.holes[0] for part in parts if part.holes),))


def _compared(parts: list[Text], *, equal: bool) -> Text:
    if len(parts) == 2 and None not in (parts[0].known, parts[1].known):
        return Text.of("true" if (parts[0].known == parts[1].known) is equal else "false")
    return _first_hole(parts) if any(part.holes for part in parts) else unknown("a comparison of other than two values")


def _configuration(parts: list[Text], scope: Scope) -> Text:
    name = parts[0].known
    if name is None:
        return _first_hole(parts)
    if name in scope.configurations:
        return scope.configurations[name]
    if len(parts) > 1:
        return parts[1]
    if scope.report is not None:
        scope.report(Fault.NOT_SET, name, "nothing declares or sets it", scope.at)
    return unknown(NotSet(f"launch configuration {name}"))


def _optional(parts: list[Text], scope: Scope) -> Text:
    return _configuration(parts, scope.silent())


def _environment(parts: list[Text], scope: Scope) -> Text:
    name = str(parts[0])
    if scope.assigned and (name in scope.assigned or "*" in scope.assigned):
        return unknown(f"environment {name}, which is set by the launch file")
    if name in scope.environment:
        return Text.of(scope.environment[name])
    return Text((Hole(OfEnvironment(name), default=parts[1].known if len(parts) > 1 else None),))


def _share(parts: list[Text], scope: Scope) -> Text:
    name = parts[0].known
    if name is None:
        return _first_hole(parts)
    folder = scope.files.package(name)
    return unknown(OfPackage(name)) if folder is None else Text.of(folder or ".")


def _installed(path: Text, scope: Scope) -> Text:
    """Return a path below the folder into which a package is installed: what is shared keeps its place in it."""
    match path.parts:
        case (Hole(reason=InstalledAt(package=package)), str(below)) if below.startswith(f"/share/{package}/"):
            folder = scope.files.package(package)
            return path if folder is None else Text.of(joined(folder, below.removeprefix(f"/share/{package}/")))
    return path


def _path(parts: list[Text], scope: Scope) -> Text:
    # What begins with a separator leaves out what stands before it.
    first = max((place for place, part in enumerate(parts) if part.is_global), default=0)
    pieces: list[Text | str] = []
    for part in parts[first:]:
        if part.parts:
            pieces += ["/", part] if pieces and not str(pieces[-1]).endswith("/") else [part]
    whole = Text.of(*pieces)
    if whole.known is None:
        return _installed(whole, scope)
    return Text.of("/" * whole.known.startswith("/") + joined("", whole.known))


def _joined(parts: list[Text], _scope: Scope) -> Text:
    delimiter, *components = parts
    if not components:
        return unknown("components that are joined, of which there are none")
    return Text.of(*[piece for one in components for piece in (delimiter, one)][1:])


def _content(parts: list[Text], scope: Scope) -> Text:
    path = parts[0].known
    if path is None:
        return _first_hole(parts)
    content = scope.files.content(path)
    if content is None:
        return unknown(f"content of {path}, which is not in the workspace")
    try:
        return Text.of(content.decode())
    except UnicodeDecodeError:
        return unknown(f"content of {path}, which is no text")


def _turn(parts: list[Text], scope: Scope) -> Text:
    name = parts[0].known
    if name is None:
        return _first_hole(parts)
    if name in scope.turns:
        return scope.turns[name]
    return parts[1] if len(parts) > 1 else unknown(NotSet(f"loop variable {name}"))


def _rewritten(parts: list[Text], scope: Scope) -> Text:
    """Return the path of a copy of a file, which is known by the changes that are made to it."""
    of = parts[0]
    match of.parts:
        case (str(),) | (Hole(reason=RewrittenFile()),) if len(parts) > 1:
            pass
        case _:
            return of
    found = tuple(parts)
    if found not in scope.rewritten:
        scope.rewritten.append(found)
    return unknown(RewrittenFile(of.known or str(of), scope.rewritten.index(found)))


def _refused(parts: list[Text], scope: Scope) -> Text:
    written, reason = (str(part) for part in parts)
    if scope.report is not None:
        scope.report(Fault.EXPRESSION, written, reason, scope.at)
    return unknown(f"{written}: {reason}")


def _python(parts: list[Text], scope: Scope) -> Text:
    whole = Text.of(*parts)
    if whole.known is None:
        return unknown(f"expression {whole}")
    try:
        return Text.of(str(evaluate(whole.known, truths=False)))
    except FailsError as error:
        if scope.report is not None:
            scope.report(Fault.EXPRESSION, whole.known, str(error), scope.at)
        return unknown(f"expression {whole}: {error}")
    except UnknownError as error:
        return unknown(f"expression {whole}: {error}")


def _chosen(parts: list[Text], _scope: Scope) -> Text:
    try:
        holds = truth(parts[0])
    except ValueError as error:
        return unknown(str(error))
    if holds is None:
        return _first_hole(parts[:1])
    return parts[1 if holds else 2] if len(parts) > (1 if holds else 2) else Text.of("")


def _folder(_parts: list[Text], scope: Scope) -> Text:
    return Text.of(scope.path.rpartition("/")[0])


_NEEDED = {"configuration": 1, "environment": 1, "if": 1, "or": 1, "and": 1}
"""How many parts of a substitution are resolved in any case: a default, or the other way, may not be."""
_KINDS: dict[str, Callable[[list[Text], Scope], Text]] = {
    "text": lambda parts, scope: _installed(Text.of(*parts), scope),
    "configuration": _configuration,
    "optional": _optional,
    "refused": _refused,
    "environment": _environment,
    "share": _share,
    "prefix": lambda parts, _scope: unknown(InstalledAt(str(parts[0]))),
    "path": _path,
    "python": _python,
    "not": lambda parts, _scope: _said(parts, lambda found: not found[0]),
    "and": lambda parts, _scope: _said(parts, all),
    "or": lambda parts, _scope: _said(parts, any),
    "equals": lambda parts, _scope: _compared(parts, equal=True),
    "unequal": lambda parts, _scope: _compared(parts, equal=False),
    "if": _chosen,
    "folder": _folder,
    "file": lambda _parts, scope: Text.of(scope.path),
    "anonymous": lambda parts, _scope: Text.of(*parts, "_", Hole(RandomEnd())),
    "command": lambda parts, _scope: unknown(f"output of `{Text.of(*parts)}`"),
    "rewritten": _rewritten,
    "join": _joined,
    "content": _content,
    "turn": _turn,
}
