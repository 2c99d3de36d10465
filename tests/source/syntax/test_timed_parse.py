"""What a parse asks of its source, and what is asked of it later."""

import gc
import sys
import tracemalloc

import tree_sitter_python
from tree_sitter import Language, Parser

from roslens.source.syntax.timed_parse import timed_parse


class _Counted(bytes):
    """Bytes that know how much was cut out of them."""

    taken = 0

    def __getitem__(self, place):
        piece = super().__getitem__(place)
        if isinstance(place, slice):
            self.taken += len(piece)
        return piece


def test_the_text_of_a_word_is_not_cut_out_of_all_that_is_behind_it():
    source = _Counted(b"def first(): pass\n" * 5_000)
    tree = timed_parse(Parser(Language(tree_sitter_python.language())), source)
    name = tree.root_node.children[10].child_by_field_name("name")
    assert name.text == b"first"
    assert source.taken <= 2_000


def test_a_long_text_is_whole():
    source = b"x = 1\ny = '" + bytes(range(48, 58)) * 5_000 + b"'\n"
    tree = timed_parse(Parser(Language(tree_sitter_python.language())), source)
    assert tree.root_node.children[1].text == source[6:-1]
    assert tree.root_node.text == source


def test_a_parse_keeps_nothing_of_its_source():
    parser = Parser(Language(tree_sitter_python.language()))
    tracemalloc.start()
    try:
        before = None
        for number in range(12):
            source = b"".join(b"def f%d(): return %d\n" % (one, number) for one in range(5_000))
            tree = timed_parse(parser, source)
            assert tree.root_node.children[1].text.startswith(b"def f1():")
            del tree
            if number == 1:
                before = tracemalloc.get_traced_memory()[0]
        # Without source and tree: 100 kB each would be 1 MB.
        assert tracemalloc.get_traced_memory()[0] - before < 50_000
    finally:
        tracemalloc.stop()


def test_what_was_given_back_can_be_used_on():
    parser = Parser(Language(tree_sitter_python.language()))
    source = bytes(bytearray(b"x = 1\n" * 2_000))
    before = sys.getrefcount(source)
    trees = [timed_parse(parser, source) for _ in range(50)]
    gc.collect()
    assert {tree.root_node.text == source for tree in trees} == {True}
    del trees
    gc.collect()
    assert sys.getrefcount(source) == before
    assert source == b"x = 1\n" * 2_000
