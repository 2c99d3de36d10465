"""Which entities a constraint is about."""

from __future__ import annotations

from roslens.judge.quality.select import matcher, name_of
from roslens.model.entity import Entity, EntityKind


def test_a_star_alone_needs_no_look():
    assert matcher("*") is None


def test_globs_match_the_whole_name_with_its_case():
    match = matcher("ns::*Node::?et[xy]")
    assert match is not None
    assert match("ns::MyNode::getx")
    assert match("ns::sub::Node::sety")
    assert not match("ns::MyNode::getz")
    assert not match("NS::MyNode::getx")
    assert not match("ns::MyNode::getx2")


def test_brackets_of_a_glob_may_stay_open():
    match = matcher("operator[*")
    assert match is not None
    assert match("operator[]")


def test_files_go_by_path_and_others_by_name():
    assert name_of(Entity("file:a/b.cpp", EntityKind.FILE, "b.cpp", "a/b.cpp")) == "a/b.cpp"
    assert name_of(Entity("class:a/b.cpp#n::C", EntityKind.CLASS, "n::C", "a/b.cpp")) == "n::C"
