from accuracy.checksums import Checksums


def test_checksums_are_those_of_definitions_and_of_what_they_hold(tmp_path):
    for name, text in {"p/msg/Outer.msg": "Inner inner\n", "p/msg/Inner.msg": "bool data\n"}.items():
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    ros1 = Checksums(1, (tmp_path,))
    # That of std_msgs/Bool, which has the same field.
    assert ros1.of("p/Inner") == "8b94c1b53db61fb6aed406028ad6332a"
    assert len(ros1.of("p/Outer")) == 32
    assert ros1.of("p/Gone") == ""
    assert Checksums(2, (tmp_path,)).of("p/msg/Inner").startswith("RIHS01_")
