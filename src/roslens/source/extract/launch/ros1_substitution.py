"""Substitution arguments of ROS 1 launch files: ``$(arg x)``, ``$(find pkg)``, ``$(env X)``, ``$(eval …)`` and so on.

As roslaunch does it (wiki.ros.org/roslaunch/XML, section 6), except that what cannot be known without the machine it
runs on is a hole.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping

import msgspec

from roslens.source.extract.facts.files import Files
from roslens.source.extract.facts.launched import Fault
from roslens.source.extract.parameters.ros1_values import converted
from roslens.source.extract.symbolic.python_expression import FailsError, Plain, UnknownError, evaluate
from roslens.source.extract.symbolic.reason import OfEnvironment, RandomEnd
from roslens.source.extract.symbolic.text import Hole, Text
from roslens.source.workspace.elements import Element

_WHOLE = re.compile(r"\s*\$\(eval\s+(.*)\)\s*", re.DOTALL)
_COMMANDS = frozenset({"arg", "find", "env", "optenv", "anon", "dirname"})


class SubstitutionError(ValueError):
    """A substitution that roslaunch rejects; the text states the reason."""


class Scope(msgspec.Struct, frozen=True):
    """What substitutions may refer to.

    Attributes:
        files: of the workspace.
        folder: of the launch file.
        arguments: values of the arguments that were declared so far.
        environment: that is known; other variables are holes.
    """

    files: Files
    folder: str
    arguments: dict[str, Text]
    environment: Mapping[str, str] = {}


def substitute(text: str, scope: Scope) -> Text:
    """Return the text with its substitutions made.

    Raises:
        SubstitutionError: one of them is wrong.
    """
    whole = _WHOLE.fullmatch(text)
    if whole:
        return _evaluated(whole[1], scope)
    parts: list[str | Text] = []
    at = 0
    while (begin := text.find("$(", at)) >= 0:
        parts.append(text[at:begin])
        end = _closing(text, begin + 2)
        parts.append(_command(text[begin + 2 : end].strip(), scope))
        at = end + 1
    return Text.of(*parts, text[at:])


def truth(text: Text) -> bool | None:
    """Return the value of a condition; None if it is unknown.

    Raises:
        SubstitutionError: it is neither true nor false.
    """
    known = text.known
    if known is None:
        return None
    value = known.strip().lower()
    if value in ("true", "1"):
        return True
    if value in ("false", "0"):
        return False
    raise SubstitutionError(f"{known!r} is not a condition; expected `true`, `1`, `false` or `0`")


def needed(element: Element, attribute: str) -> str:
    """Return an attribute that an element must have.

    Raises:
        SubstitutionError: it has none of that name.
    """
    if attribute not in element.attributes:
        raise SubstitutionError(f"<{element.tag}> has no {attribute!r}; expected <{element.tag} {attribute}=…>")
    return element.attributes[attribute]


def _closing(text: str, at: int) -> int:
    depth = 1
    for place in range(at, len(text)):
        depth += (text[place] == "(") - (text[place] == ")")
        if not depth:
            return place
    raise SubstitutionError(f"the bracket of {text[at - 2 : at + 80]!r} is never closed")


def _command(inside: str, scope: Scope) -> Text:
    if "$" in inside or "(" in inside:
        raise SubstitutionError(f"$({inside[:80]}) has another one inside, which roslaunch rejects")
    command, _, rest = inside.partition(" ")
    rest = rest.strip()
    if command not in _COMMANDS:
        raise SubstitutionError(
            f"{command!r} is not a substitution; expected one of {', '.join(sorted(_COMMANDS))}, eval"
        )
    if command == "dirname":
        return Text.of(scope.folder)
    if not rest:
        raise SubstitutionError(f"$({command}) has no argument; expected $({command} NAME)")
    return _NAMED[command](rest, scope)


class UnknownInsideError(SubstitutionError):
    """A substitution whose own text has a hole."""

    def __init__(self, hole: Hole) -> None:
        super().__init__(f"it depends on {hole.reason}")


class UndeclaredError(SubstitutionError):
    """An argument that is not declared; whoever starts or includes the file may give it."""


def fault_of(error: SubstitutionError) -> Fault | None:
    """Return why roslaunch ends with an error; None where that is not certain."""
    match error:
        case UnknownInsideError() | UndeclaredError():
            return None
        case FailingError():
            return Fault.EXPRESSION
    return Fault.REFUSED


class FailingError(SubstitutionError):
    """An expression that Python ends with an error."""


def _argument(name: str, scope: Scope) -> Text:
    if name not in scope.arguments:
        raise UndeclaredError(f"$(arg {name}): there is no argument {name!r}; expected <arg name={name!r}/> before it")
    return scope.arguments[name]


def _found(package: str, scope: Scope) -> Text:
    folder = scope.files.package(package)
    if folder is None:
        return Text((Hole(f"folder of package {package}, which is not in the workspace"),))
    return Text.of(folder or ".")


def _environment(name: str, scope: Scope) -> Text:
    if name in scope.environment:
        return Text.of(scope.environment[name])
    return Text((Hole(OfEnvironment(name)),))


def _optional_environment(rest: str, scope: Scope) -> Text:
    name, _, default = rest.partition(" ")
    if name in scope.environment:
        return Text.of(scope.environment[name])
    return Text((Hole(OfEnvironment(name), default=default.strip()),))


def _anonymous(name: str, _scope: Scope) -> Text:
    return Text.of(name + "_", Hole(RandomEnd()))


_NAMED: dict[str, Callable[[str, Scope], Text]] = {
    "arg": _argument,
    "find": _found,
    "env": _environment,
    "optenv": _optional_environment,
    "anon": _anonymous,
}


def _evaluated(expression: str, scope: Scope) -> Text:
    if "__" in expression:
        raise SubstitutionError(f"$(eval {expression}) has double underscores, which roslaunch rejects")

    def known(text: Text) -> str:
        if text.known is None:
            raise UnknownError(text.holes[0].reason)
        return text.known

    names = {name: converted(value.known) for name, value in scope.arguments.items() if value.known is not None}
    functions: dict[str, Callable[..., Plain]] = {
        "arg": lambda name: converted(known(_argument(str(name), scope))),
        "find": lambda name: known(_found(str(name), scope)),
        "env": lambda name: known(_environment(str(name), scope)),
        "optenv": lambda name, default="": known(_optional_environment(f"{name} {default}", scope)),
        "anon": lambda name: known(_anonymous(str(name), scope)),
        "dirname": lambda: scope.folder,
        **{name: lambda *_, name=name: known(scope.arguments[name]) for name in scope.arguments if name not in names},
    }
    try:
        return Text.of(str(evaluate(expression, names, functions)))
    except FailsError as error:
        raise FailingError(f"$(eval {expression}): {error}") from None
    except UnknownError as error:
        return Text((Hole(f"$(eval {expression}): {error}"),))
