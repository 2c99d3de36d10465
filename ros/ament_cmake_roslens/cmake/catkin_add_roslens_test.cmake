#
# Add a test that checks the package with roslens to `catkin_make run_tests`; catkin_test_results reads what it finds.
#
# :param FAIL_ON: severity from which a finding fails the test (note, warning, error), default: that of roslens.toml
# :type FAIL_ON: string
# :param ARGUMENTS: further arguments of `roslens check`, such as `--baseline origin/main`
# :type ARGUMENTS: list of strings
#
# @public
#
function(catkin_add_roslens_test)
  cmake_parse_arguments(ARG "" "FAIL_ON" "ARGUMENTS" ${ARGN})
  if(ARG_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "catkin_add_roslens_test() called with unused arguments: ${ARG_UNPARSED_ARGUMENTS}")
  endif()
  find_program(ROSLENS_EXECUTABLE NAMES roslens)
  if(NOT ROSLENS_EXECUTABLE)
    message(FATAL_ERROR
      "catkin_add_roslens_test() could not find the program 'roslens'; install it with `pip install roslens`")
  endif()

  set(result_file "roslens-${PROJECT_NAME}.xml")
  set(output "${CATKIN_TEST_RESULTS_DIR}/${PROJECT_NAME}/${result_file}")
  # Nothing is written below the source.
  set(command "${ROSLENS_EXECUTABLE} check ${CMAKE_CURRENT_SOURCE_DIR}")
  set(command "${command} --no-store --no-cache --no-color -q --format junit=${output}")
  if(ARG_FAIL_ON)
    set(command "${command} --fail-on ${ARG_FAIL_ON}")
  endif()
  foreach(argument ${ARG_ARGUMENTS})
    set(command "${command} ${argument}")
  endforeach()
  catkin_run_tests_target("roslens" "package" "${result_file}" COMMAND "${command}")
endfunction()
