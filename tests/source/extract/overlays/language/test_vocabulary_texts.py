import pytest


@pytest.mark.parametrize(
    ("body", "name"),
    [
        ('char t[20]; sprintf(t, "camera%d", 3);', "camera3"),
        ('char t[20]; snprintf(t, sizeof(t), "%s/%d", "a", 1);', "a/1"),
        ('char t[20]; std::strcpy(t, "a"); strcat(t, "b");', "ab"),
        ('char t[20]; strncpy(t, "abc", 2);', "{the output of strncpy()}"),
        ('std::string t = "In"; boost::algorithm::to_lower(t);', "in"),
        ('std::string t = "in"; boost::replace_all(t, "i", "o");', "on"),
        ('std::string t = "in"; boost::replace_last(t, "i", "o");', "{in, which boost.replace_last() changed}"),
        ('std::string t = boost::to_upper_copy(std::string("in"));', "IN"),
        ('std::string t = " in "; boost::trim(t);', "in"),
        ('std::string t = "in"; std::transform(t.begin(), t.end(), t.begin(), ::toupper);', "IN"),
        ('std::string t = "in"; std::transform(t.begin(), t.end(), t.begin(), f);',
         "{in, which std.transform() changed}"),
        ('std::string t = "in"; std::reverse(t.begin(), t.end());', "{in, which std.reverse() changed}"),
    ],
)  # fmt: skip
def test_texts_are_changed_by_functions(main_of, body, name):
    assert [str(one.name) for one in main_of(f"{body}\nnh.advertise<std_msgs::String>(t, 1);").endpoints] == [name]
