"""Quality models: documents of constraints for source code, built in or a user's own."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping
from pathlib import Path

import msgspec

from roslens.intake.is_there import is_file
from roslens.judge.documents.document import Section, read_document
from roslens.judge.quality.constraint import CONSEQUENCE, MAX, Constraint, spoken, verb
from roslens.judge.quality.fold_limits import SUFFIX
from roslens.judge.quality.read_constraints import read_constraints
from roslens.model.entity import EntityKind
from roslens.model.errors import DocumentError
from roslens.model.finding import RuleInfo, Severity
from roslens.model.quantity import Quantity
from roslens.plugins.nearest import did_you_mean

TOOL = "judge"
DOCUMENT_KIND = "quality model"
MODELS = Path(__file__).with_name("models")

MODEL_KEYS = {
    "kind": f"what the document is: `{DOCUMENT_KIND}`",
    "name": "what the model is called on the command line and in rule ids: small letters, digits, `-`, `_`",
    "title": "its name for readers",
    "text": "what it is for",
    "source": "where its thresholds are from",
    "version": "its version, for readers",
    "extends": "models to start from: names of built-in ones, or paths that start from this file",
    "without": "ids of inherited constraints to leave out",
    "severity": "of findings whose constraint has none: note, warning (the default) or error",
    "tags": "of all its findings, besides `metrics` and the name of the model",
    "constraints": "the list of constraints",
}

_SEVERITIES = frozenset(one.value for one in Severity)
_NAME = re.compile(r"[a-z][a-z0-9_-]*\Z")


class QualityModel(msgspec.Struct, frozen=True, omit_defaults=True):
    """A quality model; ``constraints`` has inherited ones first."""

    name: str
    title: str = ""
    source: str = ""
    text: str = ""
    version: str = ""
    constraints: tuple[Constraint, ...] = ()


def builtin_models() -> tuple[str, ...]:
    """Return the names of the models that come with roslens."""
    return tuple(sorted(path.stem for path in MODELS.glob("*.yaml")))


def model_name(chosen: str) -> str:
    """Return the name or path of a model as it is chosen, without the severity that may be given to it."""
    return _split(chosen)[0]


def _split(chosen: str) -> tuple[str, Severity | None]:
    name, colon, word = chosen.rpartition(":")
    if colon and word in _SEVERITIES:
        return name, Severity(word)
    return chosen, None


def load_model(name_or_path: str, known: Mapping[str, Quantity], *, base: Path | None = None) -> QualityModel:
    """Read a quality model.

    Args:
        name_or_path: name of a built-in model, or path of a document; `:note`, `:warning` or `:error` behind it gives
            all its limits that severity.
        known: everything that can be measured, by key.
        base: where a relative path starts from; by default the working directory.

    Raises:
        DocumentError: there is no such model or its document is wrong, with the place of the fault.
    """
    name, severity = _split(name_or_path)
    model = _read(find_model(name, base or Path()), known, ())
    if severity is None:
        return model
    constraints = [msgspec.structs.replace(one, severity=severity) for one in model.constraints]
    return msgspec.structs.replace(model, constraints=tuple(constraints))


def find_model(name_or_path: str, base: Path) -> Path:
    """Return the document that a name or path means.

    Raises:
        DocumentError: it is neither the name of a built-in model nor the path of a file.
    """
    if name_or_path in builtin_models():
        return MODELS / f"{name_or_path}.yaml"
    path = base / name_or_path
    if is_file(path):
        return path
    names = builtin_models()
    raise DocumentError(
        f"there is no quality model {name_or_path!r}",
        expected=f"one of {', '.join(names)}, or the path of a YAML document",
        advice=did_you_mean(name_or_path, names),
    )


def rule_id(model: QualityModel, constraint: Constraint, side: str) -> str:
    """Return ``<model>.<constraint>.max`` or ``….min``."""
    return f"{model.name}.{constraint.id}.{side}"


def tags_of(model: QualityModel, constraint: Constraint) -> tuple[str, ...]:
    """Return the tags of a constraint's findings, each once."""
    return tuple(dict.fromkeys(("metrics", model.name, *constraint.tags)))


def rules_of(model: QualityModel) -> tuple[RuleInfo, ...]:
    """Return one rule for each constraint and side, in the order of the document, then those of several limits."""
    single = [_rule(model, constraint, side) for constraint in model.constraints for side in constraint.sides]
    by_kind = Counter(constraint.kind for constraint in model.constraints for _side in constraint.sides)
    return (*single, *(_several(model, kind) for kind, count in by_kind.items() if count > 1))


def _rule(model: QualityModel, constraint: Constraint, side: str) -> RuleInfo:
    subject = constraint.subject or constraint.quantity
    above = "above" if side == MAX else "below"
    limit = constraint.limit_text(side)
    number = limit.removeprefix("at most ").removeprefix("at least ")
    where = "" if constraint.name == "*" else f" named `{constraint.name}`"
    description = [
        f"The {spoken(subject)} of a {constraint.kind.value}{where} {verb(subject)} {limit}.",
        constraint.meaning,
    ]
    if source := "; ".join(text for text in (model.source, constraint.source) if text):
        description.append(f"Source: {source}.")
    return RuleInfo(
        id=rule_id(model, constraint, side),
        title=constraint.title or f"{subject} {above} {number}",
        description=" ".join(text for text in description if text),
        severity=constraint.severity,
        tags=tags_of(model, constraint),
        rationale=constraint.rationale,
        tool=TOOL,
        scope=constraint.kind.value,
        consequence=CONSEQUENCE,
        certainty=constraint.certainty,
    )


def _several(model: QualityModel, kind: EntityKind) -> RuleInfo:
    constraints = [one for one in model.constraints if one.kind is kind]
    subjects = ", ".join(dict.fromkeys(spoken(one.subject or one.quantity) for one in constraints))
    plural = f"{kind.value}es" if kind is EntityKind.CLASS else f"{kind.value}s"
    return RuleInfo(
        id=f"{model.name}.{kind.value}{SUFFIX}",
        title=f"Several limits on {plural} broken",
        description=f"A {kind.value} that breaks more than one limit of the model at once, of: {subjects}. Each is "
        f"a reason of one finding; a limit alone is reported as a rule of its own.",
        severity=max((one.severity for one in constraints), key=lambda severity: severity.rank),
        tags=tuple(dict.fromkeys(tag for one in constraints for tag in tags_of(model, one))),
        rationale="Code that exceeds one limit usually exceeds others, and one change corrects all of them.",
        tool=TOOL,
        scope=kind.value,
        consequence=CONSEQUENCE,
        certainty=max((one.certainty for one in constraints), key=lambda certainty: certainty.rank),
    )


def _read(path: Path, known: Mapping[str, Quantity], heirs: tuple[Path, ...]) -> QualityModel:
    shown = f"models/{path.name}" if path.parent == MODELS else str(path)
    document = read_document(path, DOCUMENT_KIND, MODEL_KEYS, shown=shown)
    if document.text("kind") != DOCUMENT_KIND:
        raise document.fault("kind", f"kind is {document.text('kind')!r}", expected=repr(DOCUMENT_KIND))
    name = document.text("name")
    if not _NAME.match(name):
        raise document.fault("name", f"name is {name!r}", expected="small letters, digits, `-` and `_`, a letter first")
    if path.parent != MODELS and name in builtin_models():
        raise document.fault("name", f"{name!r} is the name of a built-in model", expected="another name")
    inherited = _inherited(document, path, known, heirs)
    own = read_constraints(document, name, known)
    replaced = {constraint.id for constraint in own}
    kept = [constraint for constraint in inherited if constraint.id not in replaced]
    constraints = (*kept, *own)
    if not constraints:
        raise document.fault("constraints", "a model without constraints", expected="at least one")
    return QualityModel(
        name=name,
        title=document.text("title", name),
        source=document.text("source", ""),
        text=document.text("text", ""),
        version=document.text("version", ""),
        constraints=constraints,
    )


def _inherited(
    document: Section, path: Path, known: Mapping[str, Quantity], heirs: tuple[Path, ...]
) -> list[Constraint]:
    found: dict[str, list[Constraint]] = {}
    for name in document.texts("extends"):
        try:
            parent = find_model(name, path.parent)
        except DocumentError as error:
            raise document.fault("extends", error.what, expected=error.expected, advice=error.advice) from None
        line = (*heirs, path.resolve())
        if parent.resolve() in line:
            raise document.fault("extends", f"{name!r} extends itself", expected="models that do not build on this one")
        of_parent: dict[str, list[Constraint]] = {}
        for constraint in _read(parent, known, line).constraints:
            of_parent.setdefault(constraint.id, []).append(constraint)
        found.update(of_parent)
    for unwanted in document.texts("without"):
        if unwanted not in found:
            raise document.fault(
                "without",
                f"no inherited constraint {unwanted!r}",
                expected=f"one of {', '.join(found)}" if found else "`extends` with a model to inherit from",
                advice=did_you_mean(unwanted, found),
            )
        del found[unwanted]
    return [constraint for same in found.values() for constraint in same]
