from roslens.source.workspace.copied_heads import _HEADS


def test_each_head_has_its_word():
    for word, heads in _HEADS.items():
        assert all(word in head.split() for head in heads), word
