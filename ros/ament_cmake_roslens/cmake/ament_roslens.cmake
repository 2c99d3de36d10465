#
# Add a test that checks the package with roslens; colcon test-result reads what it finds.
#
# :param TESTNAME: name of the test, default: "roslens"
# :type TESTNAME: string
# :param FAIL_ON: severity from which a finding fails the test (note, warning, error), default: that of roslens.toml
# :type FAIL_ON: string
# :param TIMEOUT: seconds, default: 120
# :type TIMEOUT: integer
# :param ARGUMENTS: further arguments of `roslens check`, such as `--baseline origin/main`
# :type ARGUMENTS: list of strings
#
# @public
#
function(ament_roslens)
  cmake_parse_arguments(ARG "" "TESTNAME;FAIL_ON;TIMEOUT" "ARGUMENTS" ${ARGN})
  if(ARG_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "ament_roslens() called with unused arguments: ${ARG_UNPARSED_ARGUMENTS}")
  endif()
  if(NOT ARG_TESTNAME)
    set(ARG_TESTNAME "roslens")
  endif()
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 120)
  endif()

  find_program(ROSLENS_EXECUTABLE NAMES roslens)
  if(NOT ROSLENS_EXECUTABLE)
    message(FATAL_ERROR "ament_roslens() could not find the program 'roslens'; install it with `pip install roslens`")
  endif()

  set(result_file "${AMENT_TEST_RESULTS_DIR}/${PROJECT_NAME}/${ARG_TESTNAME}.xunit.xml")
  # Nothing is written below the source.
  set(command "${ROSLENS_EXECUTABLE}" check "${CMAKE_CURRENT_SOURCE_DIR}"
    --no-store --no-cache --no-color -q --format "junit=${result_file}")
  if(ARG_FAIL_ON)
    list(APPEND command --fail-on "${ARG_FAIL_ON}")
  endif()
  list(APPEND command ${ARG_ARGUMENTS})

  file(MAKE_DIRECTORY "${CMAKE_BINARY_DIR}/ament_roslens")
  ament_add_test("${ARG_TESTNAME}"
    COMMAND ${command}
    TIMEOUT ${ARG_TIMEOUT}
    OUTPUT_FILE "${CMAKE_BINARY_DIR}/ament_roslens/${ARG_TESTNAME}.txt"
    RESULT_FILE "${result_file}"
    WORKING_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}"
  )
  set_tests_properties("${ARG_TESTNAME}" PROPERTIES LABELS "roslens;linter")
endfunction()
