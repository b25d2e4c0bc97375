# The published schemas as part of the program: it looks for no file when it runs.
set(schema_dir ${PROJECT_SOURCE_DIR}/io/schema)
set(embedded_dir ${PROJECT_BINARY_DIR}/generated/io/project)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${schema_dir}/project.schema.json
                                                               ${schema_dir}/edit.schema.json)
file(READ ${schema_dir}/project.schema.json project_schema_json)
file(READ ${schema_dir}/edit.schema.json edit_schema_json)
configure_file(${PROJECT_SOURCE_DIR}/io/project/schemas.cpp.in ${embedded_dir}/schemas.cpp @ONLY)
target_sources(focalstage_io_project PRIVATE ${embedded_dir}/schemas.cpp)
