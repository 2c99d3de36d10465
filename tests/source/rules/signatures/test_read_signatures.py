"""The tables of signatures, held against what the sources of launch and launch_ros say."""

from roslens.source.rules.signatures.read_signatures import (
    DISTRIBUTIONS,
    homes_of,
    names_of,
    read_tables,
    signature_of,
    span,
)


def test_a_node_takes_what_its_bases_take():
    node = signature_of("launch_ros.actions.Node")
    assert node.kind == "action"
    assert node.positional == ()
    assert node.required == ("executable",)
    assert {"executable", "package", "output", "respawn", "additional_env", "condition"} <= {*node.known}
    # Node gives `cmd` itself: given twice, Python raises a TypeError.
    assert "cmd" not in node.keywords


def test_what_was_removed_is_known_until_then():
    span_of_old_name = signature_of("launch_ros.actions.Node").keywords["node_executable"]
    assert span_of_old_name.has("foxy")
    assert not span_of_old_name.has("galactic")
    assert span_of_old_name.removed_in == "Galactic"
    assert not span_of_old_name.is_supported


def test_later_rows_are_added_to_classes():
    lifecycle = signature_of("launch_ros.actions.LifecycleNode")
    assert lifecycle.keywords["autostart"] == span("kilted-")
    assert "namespace" in lifecycle.required
    assert names_of("launch.actions")["DeclareBooleanLaunchArgument"] == span("lyrical-")


def test_a_class_is_found_where_it_is_defined_too():
    value = signature_of("launch_ros.parameter_descriptions.ParameterValue")
    assert value is signature_of("launch_ros.descriptions.ParameterValue")


def test_the_homes_of_a_name_are_modules_that_have_it():
    assert homes_of("Node") == ("launch_ros.actions",)
    assert homes_of("Shutdown") == ("launch.actions", "launch.events")
    assert homes_of("on_sigint") == ()


def test_every_row_is_consistent():
    tables = read_tables()
    for name, one in tables.classes.items():
        assert {*one.required} <= {*one.keywords}, name
        assert one.is_open or {*one.positional} - {"*"} <= {*one.keywords}, name
    for spans in tables.modules.values():
        assert all(0 <= one.first <= one.last < len(DISTRIBUTIONS) for one in spans.values())
