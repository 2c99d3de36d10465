"""Descriptions of plug-ins."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.source.extract.builds.plugin_xml import PluginClass, exported_descriptions, library_name, read_plugins
from roslens.source.extract.facts.node_facts import Evidence


def test_one_library_or_several():
    one = b'<library path="lib/liba"><class name="p/A" type="n::A" base_class_type="nodelet::Nodelet"/></library>'
    assert read_plugins(one, "p.xml") == (
        (PluginClass("p/A", "n::A", "nodelet::Nodelet", "a", Evidence("p.xml", 1, 26)),),
        (),
    )
    several = b'<class_libraries>\n<library path="a">\n<class type="n::A"/>\n</library>'
    several += b'<library path="b"><class type="n::B"/></library></class_libraries>'
    classes, _ = read_plugins(several, "p.xml")
    assert [(found.name, found.library, found.evidence.line) for found in classes] == [
        ("n::A", "a", 3),
        ("n::B", "b", 4),
    ]


def test_libraries_without_an_element_around_them():
    text = b'<?xml version="1.0"?>\n<library path="a"><class type="n::A"/></library>\n'
    text += b'<library path="b"><class type="n::B"/></library>'
    classes, unresolved = read_plugins(text, "p.xml")
    told = [(found.name, found.library, found.evidence.line) for found in classes]
    assert told == [("n::A", "a", 2), ("n::B", "b", 3)]
    assert not unresolved


def test_a_base_class_may_have_parameters():
    text = b"""<library path="lib/libscan">
  <class name="scan/Filter" type="scan::Filter"
         base_class_type="filters::FilterBase<sensor_msgs::LaserScan>"/>
</library>"""
    (one,), failed = read_plugins(text, "plugins.xml")
    assert (one.type, one.parent, one.evidence.line) == (
        "scan::Filter",
        "filters::FilterBase<sensor_msgs::LaserScan>",
        2,
    )
    assert not failed


def test_what_is_broken_is_said():
    classes, unresolved = read_plugins(b'<library path="a"><class type="n::A"/><class/><class', "p.xml")
    assert [found.name for found in classes] == ["n::A"]
    assert len(unresolved) == 2
    assert read_plugins(b"", "p.xml")[1]
    assert read_plugins(b"<other/>", "p.xml") == ((), ())


def test_what_a_manifest_exports():
    manifest = b"""<package><export><nodelet plugin="${prefix}/a.xml"/><build_type>x</build_type>
<nav plugin="sub/../b.xml" condition="$ROS_VERSION == 1"/></export></package>"""
    found = exported_descriptions(manifest, "pkg/package.xml")
    assert [(one.path, one.evidence.line, one.condition) for one in found] == [
        ("pkg/a.xml", 1, ""),
        ("pkg/b.xml", 2, "$ROS_VERSION == 1"),
    ]


@pytest.mark.parametrize(
    ("path", "name"), [("lib/libx", "x"), ("x", "x"), ("libx.so", "x"), ("lib", "lib"), ("", ""), ("src/", "src")]
)
def test_names_of_libraries(path, name):
    assert library_name(path) == name


PIECES = st.sampled_from([b"<library path='a'>", b"</library>", b"<class type='x'/>", b"<", b"&e;", b"<export>"])


@given(st.binary(max_size=100) | st.lists(PIECES).map(b"".join))
def test_any_bytes_are_read(content):
    read_plugins(content, "p.xml")
    exported_descriptions(content, "package.xml")
