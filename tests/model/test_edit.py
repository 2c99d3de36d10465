from roslens.model.edit import Edit, edit_at


def test_an_edit_knows_its_place():
    content = "é\nint a;\n".encode()
    assert edit_at(content, 3, 6, "long", "a.cpp") == Edit("a.cpp", 3, 6, "long", 2, 1, 2, 4)
    assert edit_at(content, 3, 3, "x") == Edit("", 3, 3, "x", 2, 1, 2, 1)
    assert edit_at(content, 0, 3, "").end_line == 2
