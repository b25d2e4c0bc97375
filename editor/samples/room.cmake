# Builds every folder of projects/ into the program: samples.cpp with the bytes of each file but the pictures and the
# README, which are for people.
set(samples_cpp ${PROJECT_BINARY_DIR}/generated/samples.cpp)
file(GLOB sample_folders CONFIGURE_DEPENDS LIST_DIRECTORIES true ${PROJECT_SOURCE_DIR}/projects/*)
set(sample_files)
foreach(folder ${sample_folders})
  if(IS_DIRECTORY ${folder})
    file(GLOB_RECURSE found CONFIGURE_DEPENDS ${folder}/*)
    list(FILTER found EXCLUDE REGEX "/README[.]md$|[.]h5$|[.]part/|${folder}/[^/]*[.]png$")
    list(APPEND sample_files ${found})
  endif()
endforeach()
add_custom_command(
  OUTPUT ${samples_cpp}
  COMMAND ${CMAKE_COMMAND} -D ROOT=${PROJECT_SOURCE_DIR}/projects "-DFILES=${sample_files}" -D OUTPUT=${samples_cpp}
          -P ${PROJECT_SOURCE_DIR}/cmake/EmbedSamples.cmake
  DEPENDS ${sample_files} ${PROJECT_SOURCE_DIR}/cmake/EmbedSamples.cmake
  VERBATIM)
target_sources(${target} PRIVATE ${samples_cpp})
