# The published schema as part of the program, as io/project has its own.
set(rig_schema_file ${PROJECT_SOURCE_DIR}/io/schema/rig.schema.json)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${rig_schema_file})
file(READ ${rig_schema_file} rig_schema_json)
configure_file(${PROJECT_SOURCE_DIR}/io/rig_config/schemas.cpp.in ${PROJECT_BINARY_DIR}/generated/io/rig_config/schemas.cpp @ONLY)
target_sources(focalstage_io_rig_config PRIVATE ${PROJECT_BINARY_DIR}/generated/io/rig_config/schemas.cpp)
