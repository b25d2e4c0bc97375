# The executables: a folder with a main.cpp, and the rooms it starts. tests/house/layers.py reads this too.
#
#   focalstage_program(editor/program NAME focalstage USES editor/cli)
function(focalstage_program folder)
  cmake_parse_arguments(PROGRAM "" "NAME" "USES;LIBS" ${ARGN})
  add_executable(${PROGRAM_NAME} ${PROJECT_SOURCE_DIR}/${folder}/main.cpp)
  target_link_libraries(${PROGRAM_NAME} PRIVATE ${PROGRAM_LIBS})
  foreach(used ${PROGRAM_USES})
    string(REPLACE "/" "_" used_name ${used})
    target_link_libraries(${PROGRAM_NAME} PRIVATE focalstage_${used_name})
  endforeach()
endfunction()

focalstage_program(editor/program NAME focalstage USES editor/cli)
focalstage_program(devices/program NAME focalstage-runtime USES devices/service LIBS CLI11::CLI11 spdlog::spdlog)
focalstage_program(editor/window/program NAME focalstage-editor USES editor/window/app)
