"""The table of all metrics.

A metric is a module with a ``QUANTITY`` and at least one of these functions; what it returns may be None
where there is nothing to measure, but for the first three:

================================  ===========================================================================
``of_function(facts, counting)``  of a function's facts (``of_python_function`` where Python needs another)
``of_lines(lines)``               of the lines of a function and of a file alike
``of_halstead(counts)``           of Halstead's counts of a function and of a file alike
``of_file(facts, counting)``      of a file's facts
``of_class(subject, counting)``   of a class as the whole package shows it
``of_values(values)``             of other values of the same entity; the metrics it needs stand above it
``of_files(files, …)``            of all files of a package together
``of_graph(graph)``               of the packages of a workspace together
``of_findings(findings)``         of the findings in a package
================================  ===========================================================================
"""

from __future__ import annotations

from types import ModuleType

from roslens.model.quantity import Quantity
from roslens.source.metrics.complexity import (
    calls,
    cognitive_complexity,
    cyclomatic_complexity,
    nesting,
    parameters,
    returns,
    statements,
    static_paths,
)
from roslens.source.metrics.halstead import (
    halstead_bugs,
    halstead_difficulty,
    halstead_effort,
    halstead_length,
    halstead_time,
    halstead_vocabulary,
    halstead_volume,
    maintainability_index,
    maintainability_index_with_comments,
)
from roslens.source.metrics.object_oriented import cbo, dit, fan_in, fan_out, lcom, mac, methods, noc, wmc
from roslens.source.metrics.packages import cycle, dependencies, dependents, rcv, rqv, tier
from roslens.source.metrics.size import (
    blank_lines,
    classes,
    comment_lines,
    comment_ratio,
    duplicated_lines,
    duplication_ratio,
    eloc,
    files,
    functions,
    loc,
    physical_lines,
)

METRICS: tuple[ModuleType, ...] = (
    files,
    classes,
    functions,
    physical_lines,
    loc,
    comment_lines,
    blank_lines,
    comment_ratio,
    eloc,
    statements,
    cyclomatic_complexity,
    cognitive_complexity,
    nesting,
    static_paths,
    parameters,
    calls,
    returns,
    cbo,
    fan_in,
    fan_out,
    dit,
    noc,
    methods,
    mac,
    wmc,
    lcom,
    halstead_length,
    halstead_vocabulary,
    halstead_volume,
    halstead_difficulty,
    halstead_effort,
    halstead_time,
    halstead_bugs,
    maintainability_index,
    maintainability_index_with_comments,
    duplicated_lines,
    duplication_ratio,
    dependencies,
    dependents,
    tier,
    cycle,
    rqv,
    rcv,
)

QUANTITIES: dict[str, Quantity] = {metric.QUANTITY.key: metric.QUANTITY for metric in METRICS}


def metrics_with(function: str) -> tuple[ModuleType, ...]:
    """Return the metrics that have ``function`` (see above), in the order of the table."""
    return tuple(metric for metric in METRICS if hasattr(metric, function))
