"""Reading quality models: what they say, how they build on each other, what is refused and where."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import pytest

from roslens.judge.quality.quality_model import (
    QualityModel,
    builtin_models,
    find_model,
    load_model,
    model_name,
    rules_of,
    tags_of,
)
from roslens.judge.ranges.range import Range
from roslens.model.entity import EntityKind
from roslens.model.errors import DocumentError
from roslens.model.finding import Severity
from roslens.model.quantity import Fold, Quantity
from roslens.source.metrics.table import QUANTITIES

KNOWN = {
    quantity.key: quantity
    for quantity in (
        Quantity(
            "loc",
            "Lines of code",
            "lines",
            (EntityKind.FUNCTION, EntityKind.FILE),
            "How long it is.",
            (Fold.SUM, Fold.MAX),
        ),
        Quantity("comment_ratio", "Comment ratio", "%", (EntityKind.FILE, EntityKind.PACKAGE), "", decimals=1),
        Quantity("nesting", "Nesting", "levels", (EntityKind.FUNCTION,), "How deep.", (Fold.MEAN, Fold.MAX)),
        Quantity("cbo", "Coupling", "classes", (EntityKind.CLASS,), ""),
        Quantity("mine.todo", "To do", "", (EntityKind.FILE,), ""),
    )
}
HEAD = "kind: quality model\nname: mine\n"
ONE = HEAD + "constraints:\n  - quantity: loc\n    kind: function\n    maximum: 40\n"

Load = Callable[..., QualityModel]


@pytest.fixture
def load(tmp_path: Path) -> Load:
    def load(text: str | bytes, **others: str) -> QualityModel:
        for name, content in others.items():
            (tmp_path / f"{name}.yaml").write_text(content, "utf-8")
        path = tmp_path / "m.yaml"
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return load_model("m.yaml", KNOWN, base=tmp_path)

    return load


def refusal(load: Load, text: str | bytes, **others: str) -> str:
    with pytest.raises(DocumentError) as caught:
        load(text, **others)
    return re.sub(r"/\S*/(?=\w+\.yaml)", "", str(caught.value))


def test_the_least_that_is_a_model(load: Load):
    model = load(ONE)
    assert (model.name, model.title) == ("mine", "mine")
    (constraint,) = model.constraints
    assert (constraint.id, constraint.kind, constraint.quantity) == ("loc", EntityKind.FUNCTION, "loc")
    assert (constraint.range, constraint.name, constraint.severity) == (Range(maximum=40), "*", Severity.WARNING)
    assert (constraint.subject, constraint.unit, constraint.meaning) == ("Lines of code", "lines", "How long it is.")


def test_everything_that_a_model_can_say(load: Load):
    model = load(
        HEAD + "title: Mine\ntext: For us.\nsource: a wiki\nversion: 1.10\nseverity: error\ntags: [team]\n"
        "constraints:\n"
        "  - quantity: comment_ratio\n    kind: file\n    name: 'src/*'\n    minimum: 20\n    maximum: 40.5\n"
        "    id: comments\n    severity: note\n    tags: [comments, team]\n    title: Comments\n"
        "    rationale: So it is.\n    source: page 2\n"
        "  - quantity: nesting.max\n    kind: package\n    maximum: 6\n"
    )
    assert (model.title, model.text, model.source, model.version) == ("Mine", "For us.", "a wiki", "1.10")
    first, second = model.constraints
    assert (first.id, first.name, first.range, first.severity) == ("comments", "src/*", Range(20, 40.5), Severity.NOTE)
    assert (first.title, first.rationale, first.source) == ("Comments", "So it is.", "page 2")
    assert tags_of(model, first) == ("metrics", "mine", "team", "comments")
    assert (second.id, second.severity, second.subject) == ("nesting.max", Severity.ERROR, "Nesting (max)")
    assert tags_of(model, second) == ("metrics", "mine", "team")


def test_a_rule_for_each_side(load: Load):
    model = load(
        HEAD + "source: a wiki\nconstraints:\n  - quantity: comment_ratio\n    kind: file\n    minimum: 20\n"
        "    maximum: 40\n    rationale: So it is.\n    source: page 2\n"
        "  - quantity: nesting\n    kind: function\n    maximum: 4\n    name: 'main'\n"
    )
    above, below, nesting, several = rules_of(model)
    assert (several.id, several.scope) == ("mine.file_limits", "file")
    assert (above.id, above.title) == ("mine.comment_ratio.max", "Comment ratio above 40 %")
    assert (below.id, below.title) == ("mine.comment_ratio.min", "Comment ratio below 20 %")
    assert below.description == "The comment ratio of a file is at least 20 %. Source: a wiki; page 2."
    assert (below.rationale, below.tool, below.scope) == ("So it is.", "judge", "file")
    assert below.tags == ("metrics", "mine")
    assert nesting.description == "The nesting of a function named `main` is at most 4. How deep. Source: a wiki."


def test_the_name_of_the_model_is_not_said_twice_in_a_rule(load: Load):
    model = load(HEAD + "constraints:\n  - quantity: mine.todo\n    kind: file\n    maximum: 0\n")
    assert rules_of(model)[0].id == "mine.todo.max"


BASE = (
    "kind: quality model\nname: base\ntags: [shared]\nconstraints:\n"
    "  - {quantity: loc, kind: function, maximum: 40}\n"
    "  - {quantity: nesting, kind: function, maximum: 4, severity: error}\n"
    "  - {quantity: cbo, kind: class, maximum: 5}\n"
)


def test_a_model_builds_on_others(load: Load):
    model = load(
        HEAD + "extends: base.yaml\nwithout: [cbo]\ntags: [own]\nconstraints:\n"
        "  - {quantity: loc, kind: function, maximum: 80}\n"
        "  - {quantity: loc, kind: file, id: file_loc, maximum: 400}\n",
        base=BASE,
    )
    assert [(one.id, str(one.range)) for one in model.constraints] == [
        ("nesting", "<= 4"),
        ("loc", "<= 80"),
        ("file_loc", "<= 400"),
    ]
    assert model.constraints[0].severity is Severity.ERROR
    assert tags_of(model, model.constraints[0]) == ("metrics", "mine", "shared")
    assert rules_of(model)[0].id == "mine.nesting.max"


def test_the_later_of_two_parents_wins(load: Load):
    other = "kind: quality model\nname: other\nconstraints:\n  - {quantity: loc, kind: function, maximum: 7}\n"
    model = load(HEAD + "extends: [base.yaml, other.yaml]\n", base=BASE, other=other)
    assert {one.id: str(one.range) for one in model.constraints} == {"loc": "<= 7", "nesting": "<= 4", "cbo": "<= 5"}


def test_two_sides_of_one_quantity_may_be_apart(load: Load):
    model = load(
        HEAD + "constraints:\n  - {quantity: comment_ratio, kind: file, minimum: 20}\n"
        "  - {quantity: comment_ratio, kind: file, maximum: 60, severity: note}\n"
    )
    assert [rule.id for rule in rules_of(model)] == [
        "mine.comment_ratio.min",
        "mine.comment_ratio.max",
        "mine.file_limits",
    ]


C = HEAD + "constraints:\n"
WRONG: list[tuple[str, str | bytes, str]] = [
    ("empty", "", "m.yaml: the file is empty; expected a quality model in YAML"),
    ("not UTF-8", HEAD.encode() + b"title: \xe4\n", "m.yaml:3:8: byte 0xe4 is not UTF-8"),
    ("tab", C + "\t- quantity: loc\n", "m.yaml:4:1: a tab in the indentation; expected spaces"),
    ("broken", HEAD + "title: a: b\n", "m.yaml:3:9: cannot be read as YAML at 'title: a: b'"),
    ("no kind", "name: mine\n", "m.yaml:1:1: a quality model without 'kind'; expected the line `kind: …`"),
    ("other kind", "kind: reference\nname: x\n", "m.yaml:1:7: kind is 'reference'; expected 'quality model'"),
    ("no name", "kind: quality model\n", "m.yaml:1:1: a quality model without 'name'"),
    ("bad name", "kind: quality model\nname: My Model\n", "m.yaml:2:7: name is 'My Model'; expected small letters"),
    ("taken name", ONE.replace("name: mine", "name: kth"), "m.yaml:2:7: 'kth' is the name of a built-in model"),
    ("no constraints", HEAD, "m.yaml:1:1: a model without constraints; expected at least one"),
    ("empty list", C.rstrip() + " []\n", "m.yaml:3:14: a model without constraints"),
    (
        "unknown key",
        HEAD + "constraint: []\n",
        "m.yaml:3:1: unknown key 'constraint' of a quality model; expected one of kind, name, title",
    ),
    (
        "unknown constraint key",
        C + "  - quantity: loc\n    kind: file\n    maximun: 4\n",
        "m.yaml:6:5: unknown key 'maximun' of a constraint; expected one of kind, name, quantity, minimum, maximum",
    ),
    (
        "unknown quantity",
        C + "  - quantity: nestings\n    kind: function\n    maximum: 4\n",
        "m.yaml:4:15: unknown quantity 'nestings'; expected a quantity that roslens or one of your plug-ins measures.",
    ),
    (
        "unknown fold",
        C + "  - quantity: nesting.maxi\n    kind: package\n    maximum: 4\n",
        "m.yaml:4:15: unknown quantity 'nesting.maxi'",
    ),
    (
        "nothing like it",
        C + "  - quantity: qqqqqq\n    kind: function\n    maximum: 4\n",
        "`roslens plugins` lists them",
    ),
    (
        "unknown entity kind",
        C + "  - quantity: loc\n    kind: method\n    maximum: 4\n",
        "m.yaml:5:11: kind is 'method'; expected one of repository, package, file, class, function",
    ),
    (
        "kind that has no such value",
        C + "  - quantity: cbo\n    kind: function\n    maximum: 4\n",
        "m.yaml:5:11: 'cbo' is not measured on a function; expected kind: class",
    ),
    (
        "fold where it is measured",
        C + "  - quantity: nesting.max\n    kind: function\n    maximum: 4\n",
        "m.yaml:5:11: 'nesting.max' is not measured on a function; expected kind: package or file",
    ),
    (
        "unknown severity",
        C + "  - quantity: loc\n    kind: file\n    maximum: 4\n    severity: warn\n",
        "m.yaml:7:15: severity is 'warn'; expected one of note, warning, error. Did you mean 'warning'?",
    ),
    (
        "min above max",
        C + "  - quantity: loc\n    kind: file\n    maximum: 4\n    minimum: 5\n",
        "m.yaml:7:14: minimum 5 is above maximum 4; expected finite bounds, the minimum at most the maximum",
    ),
    (
        "endless",
        C + "  - quantity: loc\n    kind: file\n    maximum: 1e999\n",
        "m.yaml:6:14: a bound is inf, expected a finite number",
    ),
    (
        "no threshold",
        C + "  - quantity: loc\n    kind: file\n",
        "m.yaml:4:15: a constraint without a threshold; expected `minimum`, `maximum` or both",
    ),
    (
        "wrong type",
        C + "  - quantity: loc\n    kind: file\n    maximum: many\n",
        "m.yaml:6:14: maximum is 'many'; expected a number",
    ),
    (
        "duplicate",
        C + "  - {quantity: loc, kind: file, maximum: 4}\n  - {quantity: loc, kind: file, maximum: 5, id: other}\n",
        "m.yaml:5:16: a second constraint on the maximum of 'loc' of file '*'; expected one (the first is in line 4).",
    ),
    (
        "duplicate id",
        C + "  - {quantity: loc, kind: file, maximum: 4}\n  - {quantity: loc, kind: function, maximum: 5}\n",
        "m.yaml:5:16: a second constraint with id 'loc' and a maximum; expected one (the first is in line 4).",
    ),
    (
        "bad id",
        C + "  - quantity: loc\n    kind: file\n    maximum: 4\n    id: My Id\n",
        "m.yaml:7:9: id is 'My Id'; expected small letters",
    ),
    (
        "unknown parent",
        HEAD + "extends: nasa\n",
        "m.yaml:3:10: there is no quality model 'nasa'; expected one of akureyri",
    ),
    (
        "nothing to leave out",
        ONE + "without: [cbo]\n",
        "m.yaml:7:10: no inherited constraint 'cbo'; expected `extends` with a model to inherit from",
    ),
    ("its own parent", ONE + "extends: m.yaml\n", "m.yaml:7:10: 'm.yaml' extends itself"),
]


@pytest.mark.parametrize(("text", "message"), [case[1:] for case in WRONG], ids=[case[0] for case in WRONG])
def test_what_is_wrong_is_said_with_its_place(load: Load, text: str | bytes, message: str):
    assert message in refusal(load, text)


def test_a_fault_in_a_parent_is_told_of_the_parent(load: Load, tmp_path: Path):
    with pytest.raises(DocumentError) as caught:
        load(HEAD + "extends: base.yaml\n", base=BASE.replace("nesting", "nestin"))
    assert str(caught.value).startswith(f"{tmp_path / 'base.yaml'}:6:16: unknown quantity 'nestin'")


def test_parents_in_a_circle_are_found(load: Load):
    base = BASE + "extends: m.yaml\n"
    assert "'m.yaml' extends itself" in refusal(load, HEAD + "extends: base.yaml\n", base=base)


def test_an_unknown_constraint_to_leave_out_names_the_nearest(load: Load):
    message = refusal(load, HEAD + "extends: base.yaml\nwithout: [nestin]\n", base=BASE)
    assert "m.yaml:4:10: no inherited constraint 'nestin'; expected one of loc, nesting, cbo" in message
    assert "Did you mean 'nesting'?" in message


def test_an_unknown_model_names_those_there_are():
    with pytest.raises(DocumentError) as caught:
        load_model("ross", KNOWN)
    assert str(caught.value).startswith(
        "there is no quality model 'ross'; expected one of akureyri, extreme, hicpp, his"
    )
    assert str(caught.value).endswith("or the path of a YAML document. Did you mean 'ros'?")


def test_models_are_found_by_name_and_by_path(tmp_path: Path):
    (tmp_path / "mine").write_text(ONE, "utf-8")
    assert find_model("mine", tmp_path) == tmp_path / "mine"
    assert find_model("ros", tmp_path).name == "ros.yaml"
    assert load_model(str(tmp_path / "mine"), KNOWN).name == "mine"
    assert set(builtin_models()) >= {
        "ros",
        "nasa-satc",
        "his",
        "kth",
        "akureyri",
        "verifysoft",
        "microsoft",
        "paper2016",
    }


@pytest.mark.parametrize("severity", Severity)
def test_a_severity_behind_the_name_is_that_of_all_limits(severity):
    model = load_model(f"ros:{severity.value}", QUANTITIES)
    assert model.name == "ros"
    assert {one.severity for one in model.constraints} == {severity}
    assert model_name(f"ros:{severity.value}") == "ros"


def test_what_else_stands_behind_a_colon_is_part_of_the_name():
    assert model_name("ros:fatal") == "ros:fatal"
    with pytest.raises(DocumentError, match="ros:fatal"):
        load_model("ros:fatal", QUANTITIES)
