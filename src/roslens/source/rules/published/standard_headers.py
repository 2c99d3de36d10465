"""Which header of the standard library declares a name: what ``cpp.missing_include`` looks up.

Only names that one header is meant for, and that are written with ``std::``: ``std::swap`` or ``std::begin`` come with
many.
"""

from __future__ import annotations

_HEADERS = {
    "algorithm": "sort stable_sort partial_sort nth_element find_if find_if_not any_of all_of none_of count_if copy_if "
    "transform for_each remove_if replace replace_if reverse rotate unique lower_bound upper_bound binary_search "
    "equal_range max_element min_element minmax_element clamp fill fill_n generate set_difference set_intersection "
    "shuffle partition",
    "any": "any any_cast make_any",
    "array": "array to_array",
    "atomic": "atomic atomic_bool atomic_int atomic_flag memory_order",
    "bitset": "bitset",
    "chrono": "chrono",
    "cmath": "sin cos tan asin acos atan atan2 sqrt pow exp log log10 floor ceil round fabs hypot isnan isinf isfinite "
    "fmod cbrt trunc lround",
    "condition_variable": "condition_variable condition_variable_any",
    "cstdint": "int8_t int16_t int32_t int64_t uint8_t uint16_t uint32_t uint64_t uintptr_t",
    "cstdio": "printf snprintf fprintf fopen fclose",
    "cstdlib": "getenv strtol strtod strtoul exit abort",
    "cstring": "memcpy memset memcmp memmove strlen strcmp strncmp strncpy strerror",
    "deque": "deque",
    "exception": "exception_ptr current_exception rethrow_exception",
    "filesystem": "filesystem",
    "forward_list": "forward_list",
    "fstream": "ifstream ofstream fstream",
    "functional": "function bind placeholders reference_wrapper ref cref greater less hash not_fn invoke mem_fn",
    "future": "future promise async shared_future packaged_task future_status",
    "iomanip": "setprecision setw setfill put_time get_time quoted",
    "iostream": "cout cerr cin clog",
    "iterator": "back_inserter inserter istream_iterator ostream_iterator istreambuf_iterator",
    "limits": "numeric_limits",
    "list": "list",
    "map": "map multimap",
    "memory": "unique_ptr shared_ptr weak_ptr make_unique make_shared static_pointer_cast dynamic_pointer_cast "
    "enable_shared_from_this addressof",
    "mutex": "mutex recursive_mutex timed_mutex lock_guard unique_lock scoped_lock call_once once_flag",
    "numeric": "accumulate iota inner_product partial_sum reduce gcd lcm",
    "optional": "optional nullopt make_optional",
    "queue": "queue priority_queue",
    "random": "mt19937 mt19937_64 random_device normal_distribution uniform_real_distribution uniform_int_distribution "
    "default_random_engine bernoulli_distribution",
    "ratio": "ratio milli",
    "regex": "regex smatch cmatch regex_match regex_search regex_replace",
    "set": "set multiset",
    "shared_mutex": "shared_mutex shared_lock shared_timed_mutex",
    "sstream": "stringstream ostringstream istringstream",
    "stack": "stack",
    "stdexcept": "runtime_error logic_error invalid_argument out_of_range domain_error length_error overflow_error "
    "range_error",
    "string": "string to_string stoi stol stod stof stoul getline wstring u16string",
    "string_view": "string_view",
    "system_error": "error_code error_category system_error",
    "thread": "thread this_thread",
    "tuple": "tuple make_tuple tie tuple_size tuple_element",
    "type_traits": "enable_if enable_if_t is_same is_same_v is_base_of is_integral is_floating_point decay decay_t "
    "remove_reference conditional true_type false_type void_t underlying_type is_convertible",
    "typeindex": "type_index",
    "unordered_map": "unordered_map unordered_multimap",
    "unordered_set": "unordered_set unordered_multiset",
    "utility": "pair make_pair move forward exchange declval index_sequence make_index_sequence",
    "variant": "variant visit holds_alternative monostate get_if",
    "vector": "vector",
}

HEADER_OF = {name: header for header, names in _HEADERS.items() for name in names.split()}
"""Header of each name."""

BROUGHT_ALONG = {
    "iostream": ("string", "iosfwd"),
    "sstream": ("string",),
    "fstream": ("string",),
    "map": ("utility",),
    "unordered_map": ("utility",),
    "condition_variable": ("mutex", "chrono"),
    "future": ("thread", "chrono", "mutex"),
    "thread": ("chrono",),
    "mutex": ("chrono",),
    "stdexcept": ("string", "exception"),
    "functional": ("type_traits",),
    "memory": ("type_traits", "utility"),
    "regex": ("string",),
    "filesystem": ("string", "chrono"),
    "queue": ("vector", "deque"),
    "stack": ("deque",),
    "random": ("limits",),
    "tuple": ("utility",),
    "optional": ("utility",),
    "variant": ("utility",),
    "vector": ("utility",),
    "list": ("utility",),
    "string": ("utility",),
    "set": ("utility",),
    "algorithm": ("utility",),
}
"""Headers whose names another one declares as well, in every library that there is."""
