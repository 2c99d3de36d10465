"""The launch context that ``OpaqueFunction`` gives its function: launch configurations may be read and set in it."""

from __future__ import annotations

from roslens.source.extract.domain.abstract_value import Obj, Table
from roslens.source.extract.domain.kinds import table_of
from roslens.source.extract.launch_python.deferred import Scope
from roslens.source.extract.symbolic.text import Text

_TABLE = "launch_configurations"


def context_of(scope: Scope) -> Obj:
    """Return the context where an action is visited."""
    held: Table = {Text.of(name): value for name, value in scope.configurations.items()}
    return Obj("launch.LaunchContext", None, {_TABLE: held})


def keep_configurations(context: Obj, scope: Scope) -> None:
    """Let launch configurations be what a function made them."""
    for name, value in table_of(context.fields.get(_TABLE)).items():
        match name, value:
            case Text(known=str(known)), Text():
                scope.configurations[known] = value
