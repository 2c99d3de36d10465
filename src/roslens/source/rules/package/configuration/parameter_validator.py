"""Rule ``package.parameter_validator``: a description of parameters with a validator for another type."""

from __future__ import annotations

import re
from collections.abc import Iterator

from roslens.model.errors import DocumentError
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.extract.parameters.parameter_library import Declaration, declarations_of
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule

_OF_ARRAYS = frozenset({"unique", "subset_of", "element_bounds", "lower_element_bounds", "upper_element_bounds"})
_OF_SIZES = frozenset({"fixed_size", "size_gt", "size_lt", "not_empty"})
_OF_VALUES = frozenset({"bounds", "lower_bounds", "upper_bounds", "lt", "gt", "lt_eq", "gt_eq", "one_of"})
"""Validators of ``rsl/parameter_validators.hpp`` by the precondition that each states."""

_IN_SETUP = re.compile(rb"""generate_parameter_module\(\s*['"][^'"]*['"]\s*,\s*['"]([^'"]+)['"]""")


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each validator that cannot check a value of the type of its parameter."""
    for path in sorted(_described(view)):
        try:
            declared = declarations_of(view.read(path), path)[1]
        except DocumentError:
            continue
        for one in declared:
            for name, place in one.validators.items():
                if wanted := _wanted(name, one):
                    message = (
                        f"{name}<> checks {wanted}, and {one.name!r} is of type {one.type}: the generated code raises "
                        "when the node starts; expected a validator for that type, or no validator"
                    )
                    yield Hit("package.parameter_validator", message, place.line, place.column, context=name, path=path)


def _described(view: PackageView) -> Iterator[str]:
    """Yield the paths of the files from which the build generates code."""
    for command in view.cmake.named("generate_parameter_library", "generate_parameter_module"):
        if len(command.words) > 1 and "$" not in command.words[1]:
            yield f"{command.folder}/{command.words[1]}".lstrip("/")
    if "setup.py" in view.listing:
        for written in _IN_SETUP.findall(view.read(view.path("setup.py"))):
            yield view.path(written.decode("utf-8", "replace"))


def _wanted(name: str, declaration: Declaration) -> str:
    """Return what a validator checks, where that is not what the parameter is; empty where it fits or is unknown."""
    is_array = declaration.type.endswith("_array")
    if name in _OF_ARRAYS and not is_array:
        return "arrays"
    if name in _OF_SIZES and not is_array and declaration.type != "string":
        return "texts and arrays"
    return "single values" if name in _OF_VALUES and is_array else ""


RULE = PackageRule(
    id="package.parameter_validator",
    title="Validator for another type",
    finds="A YAML file for generate_parameter_library in which a validator stands at a parameter of a type that it "
    "cannot check: `unique`, `subset_of` and `element_bounds` check arrays, `not_empty`, `fixed_size`, `size_gt` and "
    "`size_lt` texts and arrays, `bounds`, `gt`, `lt_eq`, `one_of` and the like single values.",
    why="The generated code reads the value as another type, which raises: the node ends at start. The build says "
    "nothing.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.PROVEN,
    profiles=("ros2",),
    tags=("parameters", "configuration"),
    bad="nearest:\n  type: double\n  validation:\n    not_empty<>: []",
    good="nearest:\n  type: double\n  validation:\n    gt<>: [0.0]",
    found=found,
)
