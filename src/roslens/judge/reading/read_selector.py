"""Which entities a constraint of a reference is about."""

from __future__ import annotations

from roslens.judge.documents.document import Section
from roslens.judge.patterns.pattern import Pattern
from roslens.judge.reading.read_common_keys import reading, visible
from roslens.judge.reference.expectation import Selector
from roslens.judge.reference.name_scope import put_under
from roslens.judge.reference.reference_document import Scope
from roslens.judge.reference.reference_keys import KINDS, NARROWING
from roslens.model.entity import EntityKind
from roslens.plugins.nearest import did_you_mean

_UNSCOPED = (EntityKind.HOST, EntityKind.PROCESS)
_KIND_WORDS = {kind.value: kind for kind in KINDS}


def read_selector(section: Section, scope: Scope, what: str = "constraint") -> Selector:
    """Return which entities a constraint, or ``what`` else, selects.

    Raises:
        DocumentError: no kind or several are selected, a pattern is wrong, or a kind cannot be narrowed like that.
    """
    given = [kind for kind in KINDS if kind.value in section]
    words = ", ".join(_KIND_WORDS)
    if not given:
        raise section.fault("", f"a {what} that selects nothing", expected=f"one of the keys {words}")
    if len(given) > 1:
        expected = f"one of them; split the {what}"
        found = " and ".join(f"`{kind.value}`" for kind in given)
        raise section.fault(given[1].value, f"a {what} on {found}", expected=expected)
    kind = given[0]
    narrowing = {key: _narrowing(section, scope, key, kind) for key in NARROWING}
    return Selector(
        kind=kind,
        name=read_pattern(section, scope, kind.value, section.text(kind.value), scoped=kind not in _UNSCOPED),
        host=narrowing["on"],
        type=narrowing["type"],
        publisher=narrowing["publisher"],
        subscriber=narrowing["subscriber"],
        without=tuple(
            read_pattern(section, scope, "without", text, scoped=kind not in _UNSCOPED)
            for text in section.texts("without")
        ),
    )


def read_condition(section: Section, scope: Scope, key: str, text: str) -> Selector:
    """Return the other entity of ``while KIND NAME``.

    Raises:
        DocumentError: the text does not have that form.
    """
    word, _, name = text.partition(" ")
    if word not in _KIND_WORDS or not name.strip():
        expected = f"while KIND NAME, with one of {', '.join(_KIND_WORDS)}"
        raise section.fault(key, f"{key} is 'while {text}'", expected=expected, advice=did_you_mean(word, _KIND_WORDS))
    kind = _KIND_WORDS[word]
    return Selector(kind, read_pattern(section, scope, key, name.strip(), scoped=kind not in _UNSCOPED))


def read_name(section: Section, scope: Scope, key: str, text: str) -> str:
    """Return the resolved name of a topic.

    Raises:
        DocumentError: it has wildcards or is no pattern.
    """
    pattern = read_pattern(section, scope, key, text, scoped=True)
    name = Pattern.parse(pattern).literal
    if name is None:
        raise section.fault(key, f"{key} {pattern!r} has wildcards", expected="the name of one topic")
    return name


def _narrowing(section: Section, scope: Scope, key: str, kind: EntityKind) -> str:
    if key not in section:
        return ""
    if kind not in NARROWING[key]:
        right = " or ".join(one.value for one in NARROWING[key])
        raise section.fault(key, f"{key!r} of a {kind.value}", expected=f"it with a {right} only")
    return read_pattern(section, scope, key, section.text(key), scoped=key in {"publisher", "subscriber"})


def read_pattern(section: Section, scope: Scope, key: str, text: str, *, scoped: bool = True) -> str:
    """Return a pattern, put into the namespace of the document where it is ``scoped``.

    Raises:
        DocumentError: it is none.
    """

    def read() -> str:
        Pattern.parse(visible(section, key, text))
        pattern = put_under(scope.namespace, text) if scoped else text
        return Pattern.parse(pattern).text

    return reading(section, key, read)
