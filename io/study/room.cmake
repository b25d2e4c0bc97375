# The published schema as part of the program, as io/project has its own.
set(study_schema_file ${PROJECT_SOURCE_DIR}/io/schema/study.schema.json)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${study_schema_file})
file(READ ${study_schema_file} study_schema_json)
configure_file(${PROJECT_SOURCE_DIR}/io/study/schemas.cpp.in ${PROJECT_BINARY_DIR}/generated/io/study/schemas.cpp @ONLY)
target_sources(focalstage_io_study PRIVATE ${PROJECT_BINARY_DIR}/generated/io/study/schemas.cpp)
