# The plugins of ours: C99, without our libraries, as anybody's are.
foreach(plugin null wire null_drive)
  add_library(plugin_${plugin} MODULE ${CMAKE_CURRENT_LIST_DIR}/examples/${plugin}.c)
  set_target_properties(plugin_${plugin} PROPERTIES PREFIX "" OUTPUT_NAME focalstage-${plugin} C_STANDARD 99 C_STANDARD_REQUIRED ON
                        C_EXTENSIONS OFF C_VISIBILITY_PRESET hidden LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/plugins)
  target_compile_options(plugin_${plugin} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wstrict-prototypes -Werror)
  target_link_libraries(plugin_${plugin} PRIVATE Threads::Threads)
endforeach()
